#pragma once
#include "why.h"
#include <filesystem>
#include <string>

namespace starbow {

/// What was measured, as a spreadsheet reads it (RFC 4180): a first line of names with their units, then a line for each
/// press. Each is in the file, as far as other programs see it, before the next frame; so a crash costs none.
class LabLog {
public:
    /// file: a new one, or one with the same first line, which is continued. Throws InputError for any other, or where it
    /// can't be written.
    explicit LabLog(const std::filesystem::path& file);
    ~LabLog();
    LabLog(const LabLog&) = delete;

    /// False where the disk does not take it; said once on standard error, and then nothing more is kept.
    bool write(const Measured& measured, const std::string& overlay);
    long lines() const { return lines_; } ///< in the file, without the first
    const std::filesystem::path& file() const { return file_; }

private:
    bool write_out(const std::string& text);

    std::filesystem::path file_;
    int stream_ = -1;
    long lines_ = 0;
    bool failed_ = false;
};

/// Without its end.
std::string log_header();
/// utc: ISO 8601. What is not known is left empty.
std::string log_line(const Measured& measured, const std::string& overlay, const std::string& utc);

} // namespace starbow
