#pragma once
#include "config/model/log_kinds.h"
#include "lab_quantities.h"
#include <filesystem>
#include <string>

namespace starbow {

/// The log of measurements, for spreadsheets (RFC 4180): a first line of names with units, then a line for each press of
/// the key. Each line is visible to other programs before the next frame, so a crash loses none.
class LabLog {
public:
    /// file: a new one, or one with the same first line, which is continued. Throws InputError for any other, or where the
    /// file can't be written.
    /// log: receives the sentence about the first line that the disk refuses.
    LabLog(const std::filesystem::path& file, LogTo log);
    ~LabLog();
    LabLog(const LabLog&) = delete;

    /// Appends a line. Returns false if the disk refuses it; later lines are lost then.
    bool write(const Measured& measured, const std::string& overlay, const std::optional<WrittenReading>& reading = {});
    long lines() const { return lines_; } ///< in the file, without the first
    const std::string& last() const { return last_; } ///< the last line written, without its end
    const std::filesystem::path& file() const { return file_; }

private:
    bool write_out(const std::string& text);

    std::filesystem::path file_;
    std::string last_;
    LogTo log_;
    int stream_ = -1;
    long lines_ = 0;
    bool failed_ = false;
};

/// The first line, without its end.
std::string log_header();
/// A line, without its end. utc: ISO 8601. Unknown values are left empty. reading: of a student at this instant.
std::string log_line(const Measured& measured, const std::string& overlay, const std::string& utc,
    const std::optional<WrittenReading>& reading = {});

} // namespace starbow
