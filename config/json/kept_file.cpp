#include "kept_file.h"
#include "hash.h"
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace starbow {
namespace {

KeptHeader header_of(std::string_view kind, std::uint64_t key)
{
    KeptHeader header;
    if (kind.size() > header.kind.size())
        throw std::logic_error("the kind of a kept file has too many letters: " + std::string(kind));
    std::ranges::copy(kind, header.kind.begin());
    header.key = key;
    return header;
}

void add_header(ContentHash& hash, const KeptHeader& header) { hash.add(&header, offsetof(KeptHeader, sum)); }

} // namespace

std::string cache_key(std::uint64_t key, const char* ending)
{
    char name[32];
    std::snprintf(name, sizeof name, "%016llx%s", static_cast<unsigned long long>(key), ending);
    return name;
}

void write_kept(const std::filesystem::path& file, std::string_view kind, std::uint64_t key,
    std::initializer_list<std::span<const unsigned char>> parts, unsigned rights)
{
    KeptHeader header = header_of(kind, key);
    if (parts.size() > header.sizes.size())
        throw std::logic_error("a kept file has too many parts: " + std::to_string(parts.size()));
    std::ranges::transform(parts, header.sizes.begin(), [](const auto& part) { return part.size(); });
    ContentHash hash;
    add_header(hash, header);
    for (const std::span<const unsigned char> part : parts)
        hash.add(part.data(), part.size());
    header.sum = hash.value();
    std::vector<std::span<const unsigned char>> all{bytes_of(std::as_const(header))};
    all.insert(all.end(), parts.begin(), parts.end());
    write_own(file, all, Durability::of_the_system, rights);
}

KeptFile::KeptFile(const std::filesystem::path& file, std::string_view kind, std::uint64_t key)
    : name_(file)
    , file_(file)
{
    const KeptHeader right = header_of(kind, key);
    KeptHeader found;
    if (file_.read({reinterpret_cast<char*>(&found), sizeof found}) != sizeof found || found.kind != right.kind
        || found.key != key)
        return;
    std::uint64_t left = file_.size() - sizeof found;
    for (const std::uint64_t size : found.sizes) {
        if (size > left)
            return;
        left -= size;
    }
    readable_ = left == 0;
    if (readable_)
        header_ = found;
}

bool KeptFile::read(std::initializer_list<std::span<unsigned char>> parts)
{
    std::array<std::uint64_t, std::tuple_size_v<decltype(header_.sizes)>> sizes{};
    if (!readable_ || parts.size() > sizes.size())
        return false;
    std::ranges::transform(parts, sizes.begin(), [](const auto& part) { return part.size(); });
    if (sizes != header_.sizes)
        return false;
    readable_ = false; // the bytes are read once
    ContentHash hash;
    add_header(hash, header_);
    for (const std::span<unsigned char> part : parts) {
        if (file_.read({reinterpret_cast<char*>(part.data()), part.size()}) != part.size())
            return false;
        hash.add(part.data(), part.size());
    }
    if (hash.value() != header_.sum)
        return false;
    std::error_code ignored;
    std::filesystem::last_write_time(name_, std::filesystem::file_time_type::clock::now(), ignored);
    return true;
}

} // namespace starbow
