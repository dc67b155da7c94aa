#include "file_name.h"
#include "edit_distance.h"
#include "error.h"
#include "folder.h"
#include "reader.h"
#include <algorithm>
#include <cctype>
#include <utf8proc.h>
#include <vector>

namespace starbow {
namespace {

/// A name's characters, letters with marks in parts (Unicode's form NFD). Of a name that is no UTF-8, its bytes.
std::u32string in_parts(const std::string& name)
{
    const auto options = utf8proc_option_t(UTF8PROC_DECOMPOSE | UTF8PROC_STABLE);
    const auto* bytes = reinterpret_cast<const utf8proc_uint8_t*>(name.data());
    const auto length = utf8proc_ssize_t(name.size());
    std::vector<utf8proc_int32_t> parts(4 * name.size() + 4); // a byte has fewer parts
    const utf8proc_ssize_t count = utf8proc_decompose(bytes, length, parts.data(), utf8proc_ssize_t(parts.size()), options);
    if (count < 0 || count > utf8proc_ssize_t(parts.size()))
        return {bytes, bytes + length};
    return {parts.begin(), parts.begin() + count};
}

std::vector<std::string> names_in(const std::filesystem::path& folder)
{
    constexpr std::size_t most = 10000;
    std::vector<std::string> names;
    each_entry(folder.empty() ? "." : folder, [&](const char* name) {
        if (names.size() < most)
            names.push_back(name);
    });
    std::ranges::sort(names);
    return names;
}

} // namespace

std::filesystem::path as_stored(const std::filesystem::path& file)
{
    std::error_code error;
    const auto exists = [&](const std::filesystem::path& path) { return std::filesystem::exists(path, error) || error; };
    if (file.empty() || exists(file))
        return file;
    std::filesystem::path found;
    for (const std::filesystem::path& part : file) {
        std::filesystem::path next = found / part;
        if (!part.empty() && !exists(next)) {
            if (std::ranges::all_of(part.string(), [](unsigned char c) { return c < 128; }))
                return file; // its letters have no marks
            const std::u32string wanted = in_parts(part.string());
            const std::vector<std::string> names = names_in(found);
            const auto same = std::ranges::find_if(names, [&](const std::string& name) { return in_parts(name) == wanted; });
            if (same == names.end())
                return file;
            next = found / *same;
        }
        found = std::move(next);
    }
    return found;
}

std::string nearest_names(const std::filesystem::path& file)
{
    const auto lower = [](const std::string& name) {
        std::u32string parts = in_parts(name);
        for (char32_t& c : parts)
            c += c >= 'A' && c <= 'Z' ? 32 : 0;
        return parts;
    };
    constexpr std::size_t longest = 255;
    const std::string name = file.filename().string();
    if (name.empty() || name.size() > longest)
        return "";
    const std::u32string wanted = lower(name);
    const std::size_t most = std::max<std::size_t>(2, wanted.size() / 4);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& other : names_in(file.parent_path()))
        if (const std::size_t apart = edit_distance(wanted, lower(other)); apart <= most)
            near.emplace_back(apart, other);
    std::ranges::sort(near);
    std::string list;
    for (std::size_t i = 0; i < near.size() && i < 3; ++i)
        list += std::string(i > 0 ? ", \"" : "\"") + one_line(near[i].second, 80) + "\"";
    return list.empty()
        ? ""
        : (near.size() > 1 ? ", and the nearest names there are " : ", and the nearest name there is ") + list;
}

std::string ending_of(const std::filesystem::path& file)
{
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return ending;
}

} // namespace starbow
