#include "kept_rows.h"
#include "config/json/error.h"
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>

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
        std::ifstream in(file, std::ios::binary);
        std::string found(head.size(), '\0');
        if (in && in.read(found.data(), std::streamsize(found.size())) && found == head) {
            whole = head.size();
            std::vector<std::byte> bytes(bytes_);
            std::uint32_t row;
            std::uint64_t sum;
            while (in.read(reinterpret_cast<char*>(&row), sizeof row)
                && in.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes_))
                && in.read(reinterpret_cast<char*>(&sum), sizeof sum) && row < std::uint32_t(rows)
                && sum == sum_of(bytes.data(), bytes_)) {
                rows_[row] = bytes;
                whole += sizeof row + bytes_ + sizeof sum;
            }
        }
    }
    std::error_code error;
    if (whole > 0)
        std::filesystem::resize_file(file, whole, error); // an end that was cut off
    if (whole == 0 || error) {
        std::ofstream out(file, std::ios::binary | std::ios::trunc);
        if (!out.write(head.data(), std::streamsize(head.size())).flush())
            throw InputError(file.string(), "", "can't be written; a folder that can be written is right");
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
    std::ofstream out(file_, std::ios::binary | std::ios::app);
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
    out.write(reinterpret_cast<const char*>(bytes), std::streamsize(bytes_));
    out.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    if (!out.flush())
        throw InputError(file_.string(), "", "can't be written; a disk with room is right");
}

} // namespace starbow
