#include "row_cache.h"
#include "hash.h"
#include "whole_file.h"
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace starbow {

// The file: the key and a line feed; then for each row that is finished its number, its bytes and a checksum over the key,
// the number and the bytes.

static std::uint64_t sum_of(const std::string& head, std::uint32_t row, const std::byte* bytes, std::size_t count)
{
    ContentHash sum;
    sum.add(head.data(), head.size());
    sum.add(&row, sizeof row);
    sum.add(bytes, count);
    return sum.value();
}

RowCache::RowCache(const std::filesystem::path& file, const std::string& key, std::size_t bytes_per_row, int rows)
    : file_(file)
    , head_(key + '\n')
    , bytes_(bytes_per_row)
    , rows_(std::size_t(rows))
{
    std::size_t whole = 0; // bytes of the file that count
    {
        RegularFile in(file);
        const auto read = [&](void* data, std::size_t bytes) { return in.read({static_cast<char*>(data), bytes}) == bytes; };
        std::string found(head_.size(), '\0');
        if (read(found.data(), found.size()) && found == head_) {
            whole = head_.size();
            std::vector<std::byte> bytes(bytes_);
            std::uint32_t row;
            std::uint64_t sum;
            while (read(&row, sizeof row) && read(bytes.data(), bytes_) && read(&sum, sizeof sum)
                && row < std::uint32_t(rows) && sum == sum_of(head_, row, bytes.data(), bytes_)) {
                rows_[row] = bytes;
                whole += sizeof row + bytes_ + sizeof sum;
            }
        }
    }
    std::error_code error;
    if (whole > 0)
        std::filesystem::resize_file(file, whole, error); // an end that was cut off
    if (whole == 0 || error) {
        write_whole(file, head_);
        rows_.assign(std::size_t(rows), {});
    }
}

int RowCache::count() const
{
    return int(std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return !row.empty(); }));
}

void RowCache::put(int row, const std::byte* bytes)
{
    const std::scoped_lock lock(mutex_);
    const std::uint32_t number = std::uint32_t(row);
    const std::uint64_t sum = sum_of(head_, number, bytes, bytes_);
    std::string entry(reinterpret_cast<const char*>(&number), sizeof number);
    entry.append(reinterpret_cast<const char*>(bytes), bytes_);
    entry.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    const int to = open_to_write(file_, O_APPEND, "a file for the rows that are finished");
    const ssize_t wrote = ::write(to, entry.data(), entry.size());
    const int why = wrote < 0 ? errno : ENOSPC;
    if (::close(to) != 0 || wrote != ssize_t(entry.size()))
        refuse_writing(file_, why);
}

} // namespace starbow
