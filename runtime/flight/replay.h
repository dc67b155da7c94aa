#pragma once
#include "config/json/whole_file.h"
#include "record.h"
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace starbow {

/// Reads a record frame by frame, and compares the flight with the record's checks. It holds one line of the record at a
/// time.
class Replay {
public:
    /// Reads the header. Throws InputError.
    explicit Replay(const std::filesystem::path& file);

    const RecordHeader& header() const { return header_; }
    const std::string& file() const { return file_; }

    /// The next frame, its controls' time counted from the record's beginning; nullopt after the last. Throws InputError
    /// with file and line.
    std::optional<RecordEntry> next();

    /// Compares the flight after that frame, where the record has a check there. A frame may be left without.
    void compare(const Flight& flight);

    int checks() const { return checks_; } ///< compared so far
    std::int64_t frames() const { return frames_; }
    /// The part of the file that has been read, from 0 to 1.
    double part_read() const;

    /// A sentence for people, once next() has returned nullopt: the flight was the same to the bit, or where it first
    /// differed, and which parts of the record are missing.
    std::string verdict() const;
    bool differs() const { return !differs_.empty(); }

private:
    std::optional<std::string> line();
    void look_ahead();
    void pass_checks(const Flight* flight);

    std::string file_;
    RegularFile stream_;
    std::array<char, 65536> piece_; ///< of the file, from which lines are taken
    std::size_t at_ = 0, got_ = 0; ///< the next byte of the piece, and how many it holds
    std::uintmax_t read_ = 0; ///< bytes of the lines so far
    int line_ = 0; ///< the last line that was read
    RecordHeader header_;
    std::optional<std::variant<RecordEntry, RecordCheck>> ahead_;
    std::int64_t time_ns_ = 0, frames_ = 0;
    int checks_ = 0;
    bool open_ = false; ///< the present frame's checks are still to come
    bool whole_ = false; ///< the record has the last line of a flight that ended properly
    bool cut_ = false; ///< an incomplete last line was left out
    std::string differs_; ///< the first difference
};

/// The first of a frame's commands that only an exhibit carries out; null: it has none.
const Command* exhibits_command(const RecordEntry& entry);

/// Flies a record again to its end, and compares the flight with the record's checks. each: is called after each frame, also
/// after those that were on no screen; it returns false to end before. Throws InputError also where the record has a
/// remote's command, which only an exhibit carries out.
void fly_again(Replay& replay, const std::function<bool(const RecordEntry&, const Flight&)>& each);

} // namespace starbow
