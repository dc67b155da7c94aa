#pragma once
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace starbow {

/// Finished rows of a long picture in a file beside it, so that one that was interrupted goes on where it was. Of another
/// picture, told by its key, none are taken.
class KeptRows {
public:
    KeptRows() = default; ///< keeps none
    /// Throws InputError where the file can't be written.
    KeptRows(const std::filesystem::path& file, const std::string& key, std::size_t bytes_per_row, int rows);

    bool has(int row) const { return !done_.empty() && done_[std::size_t(row)]; }
    const std::byte* row(int row) const { return rows_.data() + std::size_t(row) * bytes_; }
    int count() const;
    /// Safe from several threads.
    void put(int row, const std::byte* bytes);
    /// The picture is complete.
    void remove();

private:
    std::filesystem::path file_;
    std::size_t bytes_ = 0;
    std::vector<bool> done_;
    std::vector<std::byte> rows_;
    std::mutex mutex_;
};

} // namespace starbow
