#pragma once
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace starbow {

/// Finished rows of a long picture in a file beside it, so that an interrupted picture goes on. Rows of another picture, by
/// its key, are dropped, and so are a row with a wrong bit and those after it.
class RowCache {
public:
    /// Throws InputError where the file can't be written.
    RowCache(const std::filesystem::path& file, const std::string& key, std::size_t bytes_per_row, int rows);

    /// A row's bytes if the file had them, or null.
    const std::byte* row(int row) const
    {
        return rows_[std::size_t(row)].empty() ? nullptr : rows_[std::size_t(row)].data();
    }
    int count() const;
    /// Several threads may call it.
    void put(int row, const std::byte* bytes);

private:
    std::filesystem::path file_;
    std::string head_; ///< the file's first line
    std::size_t bytes_ = 0;
    std::vector<std::vector<std::byte>> rows_;
    std::mutex mutex_;
};

} // namespace starbow
