#include "file_name.h"
#include "reader.h"
#include "whole_file.h"
#include <algorithm>
#include <array>
#include <cctype>

namespace starbow {
using nlohmann::json;

namespace {

constexpr std::size_t most_bytes = std::size_t(16) << 20;
constexpr std::size_t most_depth = 64;

/// Endings of other programs' models, with their names.
constexpr std::array<std::pair<std::string_view, const char*>, 10> models{
    {{".obj", "a Wavefront OBJ"}, {".fbx", "an FBX"}, {".dae", "a COLLADA"}, {".stl", "an STL"}, {".ply", "a PLY"},
        {".3ds", "a 3DS"}, {".blend", "a Blender"}, {".usd", "a USD"}, {".usdz", "a USD"}, {".x3d", "an X3D"}}};

std::string contents(const std::filesystem::path& path, const std::string& file)
{
    const std::string ending = ending_of(path);
    std::error_code error;
    for (const auto& [model, name] : models)
        if (ending == model && std::filesystem::is_regular_file(path, error))
            throw InputError(file, "",
                std::string("is ") + name + " model by its name; glTF 2.0 (.glb or .gltf) is right, and Blender exports it");
    std::string text = read_whole(path, most_bytes, "a JSON file");
    if (text.empty())
        throw InputError(file, "", "is empty; a JSON object in { } is right");
    // JSON's first two characters are ASCII: UTF-16 has a zero beside one of them, or its mark before both.
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")
        || (text.size() > 1 && (text[0] == '\0') != (text[1] == '\0')))
        throw InputError(file, "", "is written in UTF-16; UTF-8 is right, which editors offer when a file is saved");
    return text;
}

/// Feeds the text to the parser. `read` counts the bytes that the parser has taken.
struct CountedByte {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const std::string* text;
    std::size_t at;
    std::size_t* read;

    reference operator*() const { return (*text)[at]; }
    CountedByte& operator++()
    {
        *read = ++at;
        return *this;
    }
    CountedByte operator++(int)
    {
        const CountedByte before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountedByte& other) const { return at == other.at; }
};

/// The line of the byte at `at`, counted from 1.
int line_of(const std::string& text, std::size_t at)
{
    return 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(std::min(at, text.size())), '\n'));
}

/// The column of the byte at `at`, counted from 1 in letters.
std::string column_of(const std::string& text, std::size_t at)
{
    const std::string_view before = std::string_view(text).substr(0, at);
    const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
    const auto letters = std::count_if(
        before.begin() + std::ptrdiff_t(line_start), before.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; });
    return "column " + std::to_string(1 + letters);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The first byte of the string whose closing quote is at `end - 1`. Going back, each quote inside the string follows an
/// odd number of backslashes; no backslash is before the opening quote.
std::size_t string_begin(const std::string& text, std::size_t end)
{
    for (std::size_t quote = end - 1; quote > 0;) {
        quote = text.rfind('"', quote - 1);
        std::size_t slash = quote;
        while (slash > 0 && text[slash - 1] == '\\')
            --slash;
        if ((quote - slash) % 2 == 0)
            return quote;
    }
    return 0;
}

/// The first byte of the number that ends before `end`: none of its characters can stand right before it.
std::size_t number_begin(const std::string& text, std::size_t end)
{
    while (end > 0 && (is_digit(text[end - 1]) || std::strchr("+-.eE", text[end - 1])))
        --end;
    return end;
}

/// The fault of a text that is not JSON, and its byte.
struct Fault {
    std::size_t at;
    std::string problem;
};

/// The fault in terms of the file's author. at: the byte where the parser gave up; what: its message, "[...] parse error
/// at line L, column C: syntax error while parsing object - unexpected ...; expected ...".
Fault fault_of(const std::string& text, std::size_t at, const std::string& what)
{
    const auto has = [&](const char* part) { return what.find(part) != what.npos; };
    const std::size_t stopped = at;
    if (has("unexpected end of input"))
        return {stopped, "the file ends too early; a } or ] for each { and [, and a quote for each quote, is right"};
    if (has("missing closing quote") || has("control character"))
        return {stopped, "a text has no end here; a double quote on the same line is right"};
    if (has("comment"))
        return {stopped, "a comment has no end; */ is right"};
    if (has("invalid string"))
        return {stopped, "this text can't be read; \\\\ for a backslash, \\\" for a quote and letters in UTF-8 are right"};
    if (at > 0 && (at >= text.size() || (has("number literal") && !is_digit(text[at])))) // the parser has read the next byte
        --at;
    const auto of_word = [&](char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("+-._", c); };
    std::size_t begin = at, end = at + 1;
    if (has("string literal;"))
        begin = string_begin(text, end);
    else if (of_word(text[at]) || (at > 0 && has("invalid literal") && of_word(text[at - 1]))) {
        end = of_word(text[at]) ? end : at;
        while (begin > 0 && of_word(text[begin - 1]))
            --begin;
        while (end < text.size() && of_word(text[end]))
            ++end;
    }
    const std::string seen = one_line(text.substr(begin, end - begin), 60);
    if (seen.size() > 1 && seen[0] == '0' && is_digit(seen[1]))
        return {begin, seen + " begins with a 0; the number without it is right"};
    if (has("expected end of input"))
        return {begin, seen + " comes after the end; nothing more is right"};
    if (has("parsing object - unexpected") || has("parsing array - unexpected")) {
        const std::size_t before = text.find_last_not_of(" \t\r\n", begin > 0 ? begin - 1 : 0);
        return {before == text.npos ? at : before,
            "is followed by " + seen + "; a comma between them, or a closing " + (has("parsing array") ? "]" : "}")
                + ", is right"};
    }
    if ((has("parsing object key") && seen == "}") || (has("parsing value") && seen == "]"))
        return {begin, seen + " follows a comma; no comma after the last is right"};
    if (has("parsing object key"))
        return {begin, seen + " stands where a name should; a name in double quotes, then a colon, is right"};
    if (has("parsing object separator"))
        return {begin, seen + " follows a name; a colon between the name and its value is right"};
    if (has("invalid literal") || has("parsing value"))
        return {
            begin, seen + " is not a value; a number, a text in double quotes, true, false, null, [...] or {...} is right"};
    const std::size_t column = what.find(", column "), start = what.find(": ", column);
    return {at, one_line(what.substr(start == what.npos ? 0 : start + 2)) + "; JSON is right"};
}

/// Builds the document during the parse. Only then are a repeated member, the depth, the place of an overflowing number
/// and the bytes of a value known. The parser does not recurse, so depth needs no stack. It reports each value after the
/// value's last byte; a number that is not the end of the text, one byte later.
struct Builder : json::json_sax_t {
    const std::string& file;
    const std::string& content;
    int first_line;
    std::size_t read = 0; // bytes that the parser has taken
    json root;
    std::vector<json*> open; // containers from the root inwards; an outer one does not grow while an inner is open
    std::vector<std::string> keys; // beside each open container: the member being read, where it is an object

    const std::string* wanted = nullptr; // pointer of the value whose span is needed
    std::size_t wanted_depth = 0;
    std::optional<Span> found;

    explicit Builder(const Document& document)
        : file(document.file)
        , content(document.text)
        , first_line(document.first_line)
    {
    }
    void parse()
    {
        json::sax_parse(CountedByte{&content, 0, &read}, CountedByte{&content, content.size(), &read}, this,
            json::input_format_t::json, true, true);
    }

    std::string pointer() const // pointer of the next value
    {
        std::string path;
        for (std::size_t i = 0; i < open.size(); ++i) {
            const std::size_t index = open[i]->size() - (i + 1 < open.size() ? 1 : 0);
            path += '/';
            path += open[i]->is_array() ? std::to_string(index) : escaped(keys[i]);
        }
        return path;
    }
    int line(std::size_t at) const { return line_of(content, at) + first_line - 1; }
    [[noreturn]] void refuse(std::size_t at, const std::string& place, const std::string& problem) const
    {
        throw InputError(file + ":" + std::to_string(line(at)), one_line(place), problem);
    }
    json* add(json value, std::size_t begin, std::size_t end)
    {
        if (wanted && !found && open.size() == wanted_depth && pointer() == *wanted)
            found = Span{begin, end, line(begin)};
        if (open.empty())
            return &(root = std::move(value));
        json& parent = *open.back();
        if (!parent.is_array())
            return &(parent[keys.back()] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }
    json* add_number(json value)
    {
        const std::size_t end = is_digit(content[read - 1]) ? read : read - 1;
        return add(std::move(value), number_begin(content, end), end);
    }
    bool start(json container)
    {
        if (open.size() == most_depth)
            refuse(read - 1, pointer(), "is nested too deeply; at most 64 levels are right");
        json* added = add(std::move(container), read - 1, 0);
        open.push_back(added);
        keys.emplace_back();
        return true;
    }
    bool end()
    {
        open.pop_back();
        keys.pop_back();
        if (found && found->end == 0 && open.size() == wanted_depth)
            found->end = read;
        return true;
    }

    bool null() override { return add(nullptr, read - 4, read); }
    bool boolean(bool value) override { return add(value, read - (value ? 4 : 5), read); }
    bool number_integer(json::number_integer_t value) override { return add_number(value); }
    bool number_unsigned(json::number_unsigned_t value) override { return add_number(value); }
    bool number_float(json::number_float_t value, const std::string&) override { return add_number(value); }
    bool string(std::string& value) override { return add(value, string_begin(content, read), read); }
    bool binary(json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return start(json::object()); }
    bool end_object() override { return end(); }
    bool start_array(std::size_t) override { return start(json::array()); }
    bool end_array() override { return end(); }
    bool key(std::string& name) override
    {
        keys.back() = name;
        if (open.back()->contains(name))
            refuse(read - 1, pointer(), one_line(json(name).dump(), 62) + " is given twice; one of the two is right");
        if (found && found->end == 0 && !found->first_key && open.size() == wanted_depth + 1)
            found->first_key = string_begin(content, read);
        return true;
    }
    bool parse_error(std::size_t taken, const std::string& token, const nlohmann::detail::exception& error) override
    {
        const std::size_t at = taken > 0 ? taken - 1 : 0;
        if (error.id == 406)
            refuse(at, pointer(), one_line(token, 60) + " is too large for a number; up to 1.79e308 is right");
        const Fault fault = fault_of(content, at, error.what());
        refuse(fault.at, column_of(content, fault.at), fault.problem);
    }
};

} // namespace

Document parse_document(const std::string& file, std::string text, int first_line)
{
    Document document{file, nullptr, std::move(text), first_line};
    Builder builder(document);
    builder.parse();
    document.root = std::move(builder.root);
    return document;
}

Document read_document(const std::filesystem::path& path)
{
    const std::string file = one_line(path.string());
    return parse_document(file, contents(path, file));
}

std::optional<Span> find_span(const Document& document, const std::string& pointer)
{
    Builder builder(document);
    builder.wanted = &pointer;
    builder.wanted_depth = std::size_t(std::count(pointer.begin(), pointer.end(), '/'));
    builder.parse();
    return builder.found;
}

} // namespace starbow
