#include "reader.h"
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace starbow {
using nlohmann::json;

namespace {

constexpr std::size_t most_bytes = std::size_t(16) << 20;
constexpr std::size_t most_depth = 64;

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
    const auto letters = std::count_if(
        before.begin() + std::ptrdiff_t(line_start), before.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; });
    return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ", column "
        + std::to_string(1 + letters);
}

/// Builds the document as the parser goes, because only here are a repeated member, the depth and the place of a number
/// that overflows still known. The parser does not recurse, so depth costs no stack.
struct Builder : json::json_sax_t {
    const std::string& file;
    const std::string& content;
    json root;
    std::vector<json*> open; // containers from the root inwards; an outer one does not grow while an inner is open
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

} // namespace

Document read_document(const std::filesystem::path& path)
{
    Document document{one_line(path.string()), nullptr};
    const std::string content = contents(path, document.file);
    Builder builder(document.file, content);
    json::sax_parse(content, &builder, json::input_format_t::json, true, true);
    document.root = std::move(builder.root);
    return document;
}

} // namespace starbow
