#pragma once
#include "config/model/exposing.h"
#include "config/model/flying.h"
#include "config/model/shot.h"
#include "flight.h"
#include "input/controls.h"
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace starbow {

/// A record of a flight is JSON, an object a line: what was flown, then one entry for each frame, a check now and then, and
/// a last line where the flight was left properly. Numbers are written so that they are read back to the bit.
constexpr int record_version = 1;

/// What was flown: all that a replay needs beside the entries.
struct RecordHeader {
    std::string scene, layout; ///< names of shipped ones, or paths
    std::uint64_t scene_digest = 0, layout_digest = 0; ///< of their files
    std::string pattern = "none"; ///< that the outputs showed first
    double seconds_per_time_unit = 1;
    Shot start;
    Flying rules;
    Exposing exposing;
};

/// One frame: what step() was given. Controls::told_ns is not kept: that clock means nothing on another day.
struct RecordEntry {
    std::int64_t dt_ns = 0;
    std::int64_t skipped_ns
        = 0; ///< of the visitor's time before it: a stall of the machine that the flight does not make up
    bool shown = true; ///< false: the visitor saw no picture of it, all windows being out of sight
    std::optional<double> exposure_ev; ///< that the automatic exposure had adapted to: what it saw is not repeated
    Controls controls; ///< time_ns: the sum of all dt_ns and skipped_ns so far
};

/// The flight's digest after so many ticks.
struct RecordCheck {
    std::int64_t ticks = 0;
    std::uint64_t digest = 0;
    bool last = false; ///< the flight was left here
};

/// A check is due whenever as many ticks have passed.
constexpr std::int64_t check_every_ticks = 10'000;

/// Each is a line with its end.
std::string text_of(const RecordHeader& header);
std::string text_of(const RecordEntry& entry);
std::string text_of(const RecordCheck& check);

/// Each reads a line without its end. line: counted from 1. Throws InputError with file, line, JSON pointer, value and what
/// would be right. time_ns of an entry's controls: how long it and what was skipped before it took.
RecordHeader parse_record_header(const std::string& file, std::string text);
std::variant<RecordEntry, RecordCheck> parse_record_line(const std::string& file, int line, std::string text);

/// 64 bits of FNV-1a, which tells accidents apart, not attacks.
std::uint64_t digest(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u);

/// Of every bit of a flight's state.
std::uint64_t digest(const Flight& flight);

/// 16 hexadecimal digits.
std::string shown_digest(std::uint64_t digest);

} // namespace starbow
