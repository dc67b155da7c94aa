#include "file.h"
#include "config/json/file_name.h"
#include "config/json/whole_file.h"
#include <algorithm>
#include <array>
#include <cstring>

namespace fs = std::filesystem;

namespace starbow {
namespace {

/// Reads a file; returns "" or the problem.
std::string read_bytes(const fs::path& path, std::size_t limit, Bytes& bytes)
{
    RegularFile file(path);
    const std::string read = file.read_all(limit);
    bytes.assign(read.begin(), read.end());
    return file.has_fault() ? file.fault() + "; should be a file of at most " + std::to_string(limit) + " bytes" : "";
}

std::uint32_t little32(const Bytes& bytes, std::size_t at)
{
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | std::uint32_t(bytes[at + 3]) << 24;
}

std::string wrong_glb_version(const Bytes& bytes)
{
    return "GLB version " + std::to_string(little32(bytes, 4)) + "; should be 2, as today's programs export it";
}

/// The JSON and BIN chunks of a GLB (glTF 2.0, section 4.4).
std::string split_glb(const Bytes& bytes, GltfFile& file)
{
    auto fail = [&](std::size_t at, const std::string& problem) {
        throw InputError(file.name, "byte " + std::to_string(at), problem);
    };
    if (bytes.size() < 20)
        fail(0, "a GLB of " + std::to_string(bytes.size()) + " bytes; its headers alone take 20");
    if (little32(bytes, 4) != 2)
        fail(4, wrong_glb_version(bytes));
    if (little32(bytes, 8) != bytes.size())
        fail(8,
            "the header says " + std::to_string(little32(bytes, 8)) + " bytes; the file has "
                + std::to_string(bytes.size()));
    std::string json;
    std::size_t at = 12;
    for (int chunk = 0; at < bytes.size(); ++chunk) {
        if (bytes.size() - at < 8)
            fail(at, "ends inside a chunk's header");
        std::size_t length = little32(bytes, at);
        std::uint32_t type = little32(bytes, at + 4);
        if (length > bytes.size() - at - 8)
            fail(at,
                "a chunk of " + std::to_string(length) + " bytes; the file has " + std::to_string(bytes.size() - at - 8)
                    + " more");
        auto begin = bytes.begin() + std::ptrdiff_t(at + 8);
        if (chunk == 0) {
            if (type != 0x4E4F534A)
                fail(at + 4, "the first chunk is not JSON; GLB requires it");
            json.assign(begin, begin + std::ptrdiff_t(length));
        } else if (chunk == 1 && type == 0x004E4942) {
            file.bin.assign(begin, begin + std::ptrdiff_t(length));
            file.has_bin = true;
        }
        // The specification's padding: chunks start at multiples of 4.
        at += 8 + (length + 3) / 4 * 4;
    }
    return json;
}

/// Checks the text before any parser reads it: deep nesting would overflow a recursive parser's stack, and each value
/// takes far more memory than its text.
void check_json_bounds(const GltfFile& file, const std::string& json)
{
    auto fail = [&](std::size_t at, const std::string& problem) {
        auto line = 1 + std::count(json.begin(), json.begin() + std::ptrdiff_t(at), '\n');
        throw InputError(file.name, "line " + std::to_string(line), problem);
    };
    if (json.size() > GltfLimits::json_bytes)
        fail(0,
            "has " + std::to_string(json.size()) + " bytes of JSON; at most " + std::to_string(GltfLimits::json_bytes)
                + " are allowed; buffers belong in a .bin or .glb");
    std::size_t depth = 0, values = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        char c = json[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            ++values;
            if (++depth > GltfLimits::json_depth)
                fail(
                    i, "JSON nested deeper than " + std::to_string(GltfLimits::json_depth) + " levels; glTF needs about 10");
        } else if (c == ']' || c == '}') {
            depth -= depth > 0;
        } else if (c == ',') {
            ++values;
        }
        if (values > GltfLimits::json_values)
            fail(i, "more than " + std::to_string(GltfLimits::json_values) + " JSON values; a world needs far fewer");
    }
}

/// Throws for a world in glTF 1.0, whose lists are objects: 2.0 can't read anything of it.
void refuse_first_version(const GltfFile& file, const Json& json)
{
    const auto asset = json.is_object() ? json.find("asset") : json.end();
    if (asset == json.end() || !asset->is_object())
        return;
    const auto version = asset->find("version");
    if (version == asset->end())
        return;
    const bool first = version->is_number() ? *version < 2 : version->dump().starts_with("\"1.");
    if (first)
        throw InputError(
            file.name, "/asset/version", "is glTF " + version->dump() + "; 2.0 is right, as today's programs export it");
}

Json parse_json(const GltfFile& file, const std::string& json)
{
    check_json_bounds(file, json);
    try {
        Json parsed = Json::parse(json);
        refuse_first_version(file, parsed);
        return parsed;
    } catch (const Json::parse_error& error) {
        std::size_t at = std::min(error.byte ? error.byte - 1 : 0, json.size());
        auto end = json.begin() + std::ptrdiff_t(at);
        auto line = 1 + std::count(json.begin(), end, '\n');
        const std::size_t begins = json.find_first_not_of(" \t\r\n");
        const bool looks_like_json = begins != json.npos && (json[begins] == '{' || json[begins] == '[');
        auto start = std::find(std::make_reverse_iterator(end), json.rend(), '\n').base();
        throw InputError(file.name, "line " + std::to_string(line) + ", column " + std::to_string(end - start + 1),
            file.is_glb           ? "is broken JSON, counted in the GLB's first chunk; glTF's JSON is right there"
                : looks_like_json ? "is broken JSON; glTF's JSON is right"
                                  : "is neither glTF's JSON nor GLB; should be a .gltf or .glb file");
    } catch (const Json::exception&) {
        // Such an error is a number that no double can hold.
        throw InputError(file.name, "/", "holds a number out of range");
    }
}

Bytes decode_base64(const std::string& text, std::size_t begin, const JsonSpot& spot)
{
    std::size_t end = text.size();
    while (end > begin && text[end - 1] == '=')
        --end;
    if (text.size() - end > 2)
        spot.fail("ends in more than two '='; should be base64");
    Bytes bytes;
    bytes.reserve((end - begin) / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int held = 0;
    for (std::size_t i = begin; i < end; ++i) {
        char c = text[i];
        int value = c >= 'A' && c <= 'Z' ? c - 'A'
            : c >= 'a' && c <= 'z'       ? c - 'a' + 26
            : c >= '0' && c <= '9'       ? c - '0' + 52
            : c == '+' || c == '-'       ? 62
            : c == '/' || c == '_'       ? 63
                                         : -1;
        if (value < 0)
            spot.fail("has a character that is not base64, " + std::to_string(i - begin) + " after the comma");
        bits = bits << 6 | std::uint32_t(value);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(std::uint8_t(bits >> held));
        }
    }
    return bytes;
}

std::string decode_percent(const std::string& uri, const JsonSpot& spot)
{
    auto digit = [&](std::size_t i) {
        char c = i < uri.size() ? uri[i] : ' ';
        if (!std::isxdigit(static_cast<unsigned char>(c)))
            spot.fail("is " + in_quotes(uri) + "; a % should be followed by two hexadecimal digits");
        return c <= '9' ? c - '0' : (c | 32) - 'a' + 10;
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%') {
            path += char(digit(i + 1) * 16 + digit(i + 2));
            i += 2;
        } else
            path += uri[i];
    }
    return path;
}

/// The place on disk that a relative URI names, or a complaint.
fs::path resolve_inside(const fs::path& folder, const std::string& uri, const JsonSpot& spot)
{
    const char* right = "; should be a data: URI or a relative path inside the file's own folder";
    std::string path = decode_percent(uri, spot);
    if (path.empty() || path.size() > 1000 || path[0] == '/'
        || path.find_first_of(std::string("\\:\0", 3)) != std::string::npos)
        spot.fail("is " + in_quotes(uri) + right);
    std::error_code error;
    const fs::path file = as_stored(folder / path);
    fs::path place = fs::canonical(file, error);
    if (error)
        spot.fail("names " + in_quotes(uri) + ", which cannot be found: " + error.message() + nearest_names(file));
    auto [rest, _] = std::mismatch(folder.begin(), folder.end(), place.begin(), place.end());
    if (rest != folder.end())
        spot.fail("is " + in_quotes(uri) + ", which leads out of the file's folder" + right);
    return place;
}

/// The file's name and folder, without any content.
GltfFile named(const fs::path& file)
{
    GltfFile out;
    out.name = file.string();
    std::replace_if(
        out.name.begin(), out.name.end(), [](unsigned char c) { return c < ' '; }, '?');
    std::error_code error;
    const fs::path real = fs::canonical(as_stored(file), error);
    if (!error)
        out.folder = real.parent_path();
    return out;
}

} // namespace

GltfFile read_gltf_file(const fs::path& file)
{
    GltfFile out = named(file);
    Bytes bytes;
    if (std::string problem = read_bytes(file, out.bytes_left, bytes); !problem.empty())
        throw InputError(out.name, "", problem);
    out.bytes_left -= bytes.size();
    if (out.folder.empty())
        throw InputError(out.name, "", "cannot be found; it was there a moment ago");
    out.is_glb = begins_glb({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    std::string json = out.is_glb ? split_glb(bytes, out) : std::string(bytes.begin(), bytes.end());
    Bytes().swap(bytes);
    out.json = parse_json(out, json);
    return out;
}

GltfFile read_gltf_json(const fs::path& path)
{
    GltfFile out = named(path);
    RegularFile file(path);
    constexpr std::size_t header = 20; // the file's and the first chunk's
    std::string json(header, '\0');
    json.resize(file.read({json.data(), header}));
    out.is_glb = begins_glb(json);
    if (out.is_glb && json.size() == header) {
        const Bytes bytes(json.begin(), json.end());
        if (little32(bytes, 4) != 2)
            throw InputError(out.name, "byte 4", wrong_glb_version(bytes));
        if (little32(bytes, 16) != 0x4E4F534A)
            throw InputError(out.name, "byte 16", "the first chunk is not JSON; GLB requires it");
        const std::size_t length = little32(bytes, 12);
        if (length > GltfLimits::json_bytes || length > file.size() - header)
            throw InputError(out.name, "byte 12",
                "a chunk of " + std::to_string(length) + " bytes; the file has " + std::to_string(file.size() - header)
                    + " more");
        json.resize(length);
        json.resize(file.read({json.data(), length}));
    } else
        json += file.read_all(GltfLimits::json_bytes);
    if (file.has_fault())
        throw InputError(out.name, "", file.fault() + "; a .gltf or .glb file is right");
    out.json = parse_json(out, json);
    return out;
}

Bytes read_uri(GltfFile& file, const JsonSpot& spot)
{
    if (!spot.json.is_string())
        spot.fail("should be a text");
    const std::string& uri = spot.json.get_ref<const std::string&>();
    if (uri.starts_with("data:")) {
        std::size_t comma = uri.find(',');
        if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
            spot.fail("is " + in_quotes(uri) + "; a data: URI should read data:TYPE;base64,BYTES");
        return decode_base64(uri, comma + 1, spot);
    }
    fs::path place = resolve_inside(file.folder, uri, spot);
    Bytes bytes;
    if (std::string problem = read_bytes(place, file.bytes_left, bytes); !problem.empty())
        spot.fail("names " + in_quotes(uri) + ", which " + problem);
    file.bytes_left -= bytes.size();
    return bytes;
}

} // namespace starbow
