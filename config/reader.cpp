#include "reader.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numeric>

namespace starbow {
using nlohmann::json;

namespace {

constexpr std::size_t most_bytes = std::size_t(16) << 20;
constexpr std::size_t most_depth = 64;

std::string escaped(const std::string& key)
{
    std::string out;
    for (char c : key)
        out += c == '~' ? std::string("~0") : c == '/' ? std::string("~1") : std::string(1, c);
    return out;
}

std::string contents(const std::filesystem::path& path, const std::string& file)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(file, "", "is a folder; a JSON file is right");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!stream && errno == ENOENT)
        throw InputError(file, "", "does not exist; the name of a JSON file is right");
    if (!stream)
        throw InputError(file, "", std::string("can't be opened (") + std::strerror(errno) + "); a readable file is right");

    // Read in pieces rather than asked for its size: a pipe has none.
    std::string text;
    std::size_t got = 1;
    while (got > 0 && text.size() <= most_bytes) {
        const std::size_t before = text.size();
        text.resize(before + 65536);
        got = std::fread(text.data() + before, 1, 65536, stream.get());
        text.resize(before + got);
    }
    if (std::ferror(stream.get()))
        throw InputError(file, "", std::string("can't be read (") + std::strerror(errno) + "); a readable file is right");
    if (text.size() > most_bytes)
        throw InputError(file, "", "is larger than 16 MiB; a smaller file is right");
    if (text.empty())
        throw InputError(file, "", "is empty; a JSON object in { } is right");
    return text;
}

/// Of the last of the first `read` bytes, counted from 1 in letters.
std::string line_and_column(const std::string& content, std::size_t read)
{
    const std::string_view before = std::string_view(content).substr(0, read > 0 ? read - 1 : 0);
    const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
    const auto letters = std::count_if(before.begin() + std::ptrdiff_t(line_start), before.end(),
        [](unsigned char c) { return (c & 0xc0) != 0x80; });
    return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ", column "
        + std::to_string(1 + letters);
}

/// Builds the document as the parser goes, because only here are a repeated member, the depth and the place of a number
/// that overflows still known. The parser does not recurse, so depth costs no stack.
struct Builder : json::json_sax_t {
    const std::string& file;
    const std::string& content;
    json root;
    std::vector<json*> open;       // containers from the root inwards; an outer one does not grow while an inner is open
    std::vector<std::string> keys; // beside each open container: the member being read, where it is an object

    Builder(const std::string& name, const std::string& text)
        : file(name)
        , content(text)
    {
    }

    std::string pointer() const // of the value that comes next
    {
        std::string path;
        for (std::size_t i = 0; i < open.size(); ++i) {
            const std::size_t index = open[i]->size() - (i + 1 < open.size() ? 1 : 0);
            path += "/" + (open[i]->is_array() ? std::to_string(index) : escaped(keys[i]));
        }
        return one_line(path);
    }
    json* add(json value)
    {
        if (open.empty())
            return &(root = std::move(value));
        json& parent = *open.back();
        if (!parent.is_array())
            return &(parent[keys.back()] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }
    bool start(json container)
    {
        if (open.size() == most_depth)
            throw InputError(file, pointer(), "is nested too deeply; at most 64 levels are right");
        open.push_back(add(std::move(container)));
        keys.emplace_back();
        return true;
    }
    bool end()
    {
        open.pop_back();
        keys.pop_back();
        return true;
    }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(json::number_integer_t value) override { return add(value); }
    bool number_unsigned(json::number_unsigned_t value) override { return add(value); }
    bool number_float(json::number_float_t value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(value); }
    bool binary(json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return start(json::object()); }
    bool end_object() override { return end(); }
    bool start_array(std::size_t) override { return start(json::array()); }
    bool end_array() override { return end(); }
    bool key(std::string& name) override
    {
        keys.back() = name;
        if (open.back()->contains(name))
            throw InputError(file, pointer(), "\"" + one_line(name, 60) + "\" is given twice; one of the two is right");
        return true;
    }
    bool parse_error(std::size_t read, const std::string& token, const nlohmann::detail::exception& error) override
    {
        if (error.id == 406)
            throw InputError(file, pointer(), one_line(token, 60) + " is too large for a number; up to 1.79e308 is right");
        // "[...] parse error at line L, column C: ..." with a column in bytes, and 0 for the end of the line before.
        const std::string what = error.what();
        const std::size_t column = what.find(", column "), start = what.find(": ", column);
        throw InputError(file, line_and_column(content, read), one_line(what.substr(start == what.npos ? 0 : start + 2)));
    }
};

std::string value_text(const json& value)
{
    return one_line(value.dump(-1, ' ', false, json::error_handler_t::replace), 60);
}

std::string phrase(Range range)
{
    const std::string low = shown(range.low), high = shown(range.high);
    return "a number " + (range.low_open ? "above " + low + " up to " + high : "from " + low + " to " + high) + " is right";
}

std::string choice(const std::vector<std::string_view>& names)
{
    std::string out;
    for (std::size_t i = 0; i < names.size(); ++i)
        out += (i == 0 ? "\"" : i + 1 == names.size() ? " or \"" : ", \"") + std::string(names[i]) + "\"";
    return out;
}

/// Letters to add, drop or change on the way from one word to the other.
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({ changed, row[j] + 1, row[j - 1] + 1 });
        }
    }
    return row.back();
}

} // namespace

Document read_document(const std::filesystem::path& path)
{
    Document document { one_line(path.string()), nullptr };
    const std::string content = contents(path, document.file);
    Builder builder(document.file, content);
    json::sax_parse(content, &builder, json::input_format_t::json, true, true);
    document.root = std::move(builder.root);
    return document;
}

Place root(const Document& document) { return { &document, &document.root, "" }; }

void complain(const Place& place, const std::string& problem)
{
    throw InputError(place.document->file, one_line(place.pointer), value_text(*place.json) + " " + problem);
}

double number(const Place& place, Range range)
{
    if (!place.json->is_number())
        complain(place, "is not a number; " + phrase(range));
    const double value = place.json->get<double>();
    if (value < range.low || (range.low_open && value == range.low))
        complain(place, "is too small; " + phrase(range));
    if (!(value <= range.high))
        complain(place, "is too large; " + phrase(range));
    return value;
}

int integer(const Place& place, int low, int high)
{
    const double value = number(place, { double(low), double(high) });
    if (value != std::floor(value))
        complain(place, "is not a whole number; one from " + std::to_string(low) + " to " + std::to_string(high) + " is right");
    return int(value);
}

bool boolean(const Place& place)
{
    if (!place.json->is_boolean())
        complain(place, "is neither true nor false; one of these is right");
    return place.json->get<bool>();
}

std::string text(const Place& place)
{
    if (!place.json->is_string())
        complain(place, "is not a text; a text in double quotes is right");
    const std::string value = place.json->get<std::string>();
    if (value.empty())
        complain(place, "is empty; a text with at least one letter is right");
    if (std::any_of(value.begin(), value.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
        complain(place, "holds a control character; a text without them is right");
    return value;
}

std::string one_of(const Place& place, std::initializer_list<std::string_view> choices)
{
    if (place.json->is_string())
        for (std::string_view name : choices)
            if (place.json->get_ref<const std::string&>() == name)
                return std::string(name);
    complain(place, "is not known here; " + choice(choices) + " is right");
}

std::vector<Place> items(const Place& place, std::size_t least, std::size_t most, const std::string& what)
{
    const std::string right = "a list of " + (least == most ? "" : std::to_string(least) + " to ") + std::to_string(most) + " "
        + what + " in [ ] is right";
    if (!place.json->is_array())
        complain(place, "is not a list; " + right);
    const std::size_t count = place.json->size();
    if (count < least || count > most)
        complain(place, "has length " + std::to_string(count) + "; " + right);
    std::vector<Place> places;
    for (std::size_t i = 0; i < count; ++i)
        places.push_back({ place.document, &(*place.json)[i], place.pointer + "/" + std::to_string(i) });
    return places;
}

glm::dvec3 vec3(const Place& place, Range range)
{
    const std::vector<Place> at = items(place, 3, 3, "numbers");
    return { number(at[0], range), number(at[1], range), number(at[2], range) };
}

glm::dvec4 vec4(const Place& place, Range range)
{
    const std::vector<Place> at = items(place, 4, 4, "numbers");
    return { number(at[0], range), number(at[1], range), number(at[2], range), number(at[3], range) };
}

void only(const Place& place, const std::vector<std::string_view>& known)
{
    if (!place.json->is_object())
        complain(place, "is not an object; an object in { } is right");
    for (const auto& [name, value] : place.json->items()) {
        if (std::find(known.begin(), known.end(), name) != known.end())
            continue;
        const std::string word = one_line(name, 60);
        std::vector<std::string_view> nearest = known;
        std::stable_sort(nearest.begin(), nearest.end(),
            [&](std::string_view a, std::string_view b) { return distance(word, a) < distance(word, b); });
        nearest.resize(std::min<std::size_t>(nearest.size(), 3));
        complain({ place.document, &value, place.pointer + "/" + escaped(name) },
            "stands under an unknown name; " + choice(nearest) + " is right");
    }
}

std::optional<Place> find(const Place& place, const std::string& name)
{
    const auto found = place.json->find(name);
    if (found == place.json->end())
        return {};
    return Place { place.document, &*found, place.pointer + "/" + escaped(name) };
}

Place member(const Place& place, const std::string& name)
{
    if (auto found = find(place, name))
        return *found;
    complain(place, "lacks \"" + name + "\"; an object with this member is right");
}

std::string shown(double number)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", number);
    return text;
}

std::string one_line(std::string text, std::size_t most)
{
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = '?';
    if (text.size() > most) {
        std::size_t cut = most;
        while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0) == 0x80) // never inside a UTF-8 letter
            --cut;
        text.resize(cut);
        text += "...";
    }
    return text;
}

} // namespace starbow
