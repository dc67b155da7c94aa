#include "kept_rows.h"
#include "config/json/whole_file.h"
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace starbow {

// The file: the key and a line feed; then for each row that is finished its number, its bytes and their sum.

static std::uint64_t sum_of(const std::byte* bytes, std::size_t count)
{
    std::uint64_t sum = 0xcbf29ce484222325; // FNV-1a
    for (std::size_t i = 0; i < count; ++i)
        sum = (sum ^ std::uint64_t(bytes[i])) * 0x100000001b3;
    return sum;
}

KeptRows::KeptRows(const std::filesystem::path& file, const std::string& key, std::size_t bytes_per_row, int rows)
    : file_(file)
    , bytes_(bytes_per_row)
    , rows_(std::size_t(rows))
{
    const std::string head = key + '\n';
    std::size_t whole = 0; // bytes of the file that count
    {
        RegularFile in(file);
        const auto read = [&](void* data, std::size_t bytes) { return in.read({static_cast<char*>(data), bytes}) == bytes; };
        std::string found(head.size(), '\0');
        if (read(found.data(), found.size()) && found == head) {
            whole = head.size();
            std::vector<std::byte> bytes(bytes_);
            std::uint32_t row;
            std::uint64_t sum;
            while (read(&row, sizeof row) && read(bytes.data(), bytes_) && read(&sum, sizeof sum)
                && row < std::uint32_t(rows) && sum == sum_of(bytes.data(), bytes_)) {
                rows_[row] = bytes;
                whole += sizeof row + bytes_ + sizeof sum;
            }
        }
    }
    std::error_code error;
    if (whole > 0)
        std::filesystem::resize_file(file, whole, error); // an end that was cut off
    if (whole == 0 || error) {
        write_whole(file, head);
        rows_.assign(std::size_t(rows), {});
    }
}

int KeptRows::count() const
{
    return int(std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return !row.empty(); }));
}

void KeptRows::put(int row, const std::byte* bytes)
{
    const std::scoped_lock lock(mutex_);
    const std::uint32_t number = std::uint32_t(row);
    const std::uint64_t sum = sum_of(bytes, bytes_);
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
