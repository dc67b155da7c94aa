#include "file_name.h"
#include "composed_letters.h"
#include "error.h"
#include "reader.h"
#include <algorithm>
#include <vector>

namespace starbow {
namespace {

/// The characters of UTF-8; a byte that is none stands for itself.
std::u32string characters(const std::string& text)
{
    std::u32string all;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(at < text.size() ? text[at] : 0); };
        const unsigned char first = byte(i);
        const std::size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
        char32_t c = more == 3 ? first & 7u : more == 2 ? first & 15u : more == 1 ? first & 31u : first;
        bool whole = true;
        for (std::size_t k = 1; k <= more; ++k) {
            whole = whole && (byte(i + k) & 0xc0) == 0x80;
            c = c << 6 | (byte(i + k) & 63u);
        }
        all.push_back(whole ? c : first);
        i += whole ? 1 + more : 1;
    }
    return all;
}

/// Adds a character in parts.
void decompose(char32_t c, std::u32string& to)
{
    constexpr char32_t hangul = 0xac00, hangul_end = 0xd7a4, vowels = 21, finals = 28; // the Unicode Standard, section 3.12
    if (c >= hangul && c < hangul_end) {
        const char32_t at = c - hangul;
        to.push_back(0x1100 + at / (vowels * finals));
        to.push_back(0x1161 + at % (vowels * finals) / finals);
        if (at % finals != 0)
            to.push_back(0x11a7 + at % finals);
        return;
    }
    const auto* found
        = std::ranges::lower_bound(composed_letters, c, {}, [](const ComposedLetter& l) { return char32_t(l.whole); });
    if (found == std::end(composed_letters) || found->whole != c)
        return to.push_back(c);
    decompose(found->letter, to);
    to.push_back(found->mark);
}

std::u32string in_parts(const std::string& name)
{
    std::u32string parts;
    for (const char32_t c : characters(name))
        decompose(c, parts);
    return parts;
}

/// The number of characters that differ, are missing or are too many, between two names.
std::size_t distance(const std::u32string& a, const std::u32string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j < row.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t before = row[0]++;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = before + (a[i - 1] != b[j - 1]);
            before = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
        }
    }
    return row[b.size()];
}

std::vector<std::string> names_in(const std::filesystem::path& folder)
{
    constexpr std::size_t most = 10000;
    std::error_code error;
    std::vector<std::string> names;
    for (std::filesystem::directory_iterator at(folder.empty() ? "." : folder, error), end;
         !error && at != end && names.size() < most; at.increment(error))
        names.push_back(at->path().filename().string());
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
        if (const std::size_t apart = distance(wanted, lower(other)); apart <= most)
            near.emplace_back(apart, other);
    std::ranges::sort(near);
    std::string list;
    for (std::size_t i = 0; i < near.size() && i < 3; ++i)
        list += std::string(i > 0 ? ", \"" : "\"") + one_line(near[i].second, 80) + "\"";
    return list.empty()
        ? ""
        : (near.size() > 1 ? ", and the nearest names there are " : ", and the nearest name there is ") + list;
}

} // namespace starbow
