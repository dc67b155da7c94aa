#pragma once
#include "config/model/exposing.h"
#include "config/model/flying.h"
#include "config/model/shot.h"
#include "flight.h"
#include "input/command.h"
#include "input/controls.h"
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace starbow {

/// The version of a flight's record. A record is JSON, an object a line: a header, then one entry for each frame, a check
/// now and then, and a last line if the flight ended properly. Numbers are written so that reading restores every bit.
constexpr int record_version = 1;

// Structs of other files that a record's header has in forms of its own.
struct RecordedShot : Shot { };
struct RecordedFlying : Flying { };

/// The header: all that a replay needs beside the entries.
struct RecordHeader {
    int version = record_version;
    std::string scene, layout; ///< names of shipped ones, or paths
    std::uint64_t scene_digest = 0, layout_digest = 0; ///< digests of their files
    std::string pattern = "none"; ///< the first test pattern of the outputs
    double seconds_per_time_unit = 1;
    RecordedShot start;
    RecordedFlying rules;
    Exposing exposing;
};

/// One frame: the arguments of step(). Controls::report_ns is not kept, because that clock means nothing on another day.
struct RecordEntry {
    std::int64_t dt_ns = 0;
    std::int64_t skipped_ns = 0; ///< visitor's time before the frame that is not flown: a stall of the machine
    bool shown = true; ///< false: the visitor saw no picture of the frame, because no window was visible
    std::optional<double> exposure_ev; ///< the automatic exposure's adapted EV, because a replay does not repeat the
                                       ///< metering
    double light = 1; ///< the part that a calm exhibit keeps of the picture's light
    bool ranged = false; ///< a curve shows everything at once
    std::vector<double> range_goal; ///< the curve that it follows from this frame on, as range_curve.h has it; empty: the
                                    ///< same as before
    std::vector<Command> commands; ///< of a remote, the guide's window and the menu, carried out before the step
    Controls controls; ///< time_ns: the sum of all dt_ns and skipped_ns so far
};

/// The flight's digest after some ticks.
struct RecordCheck {
    std::int64_t ticks = 0;
    std::uint64_t digest = 0;
    bool last = false; ///< the flight ended here
};

/// A check is due each time this many ticks have passed.
constexpr std::int64_t check_every_ticks = 10'000;

/// A line of the record, with its end.
std::string text_of(const RecordHeader& header);
std::string text_of(const RecordEntry& entry);
std::string text_of(const RecordCheck& check);

/// Each reads a line without its end. line: counted from 1. An entry's controls.time_ns is the sum of its own dt_ns and
/// skipped_ns. Throws InputError with file, line, JSON pointer, value and what would be right.
RecordHeader parse_record_header(const std::string& file, std::string text);
std::variant<RecordEntry, RecordCheck> parse_record_line(const std::string& file, int line, std::string text);

/// 64 bits of FNV-1a: they detect accidents, not attacks. before: the digest of the bytes in front.
std::uint64_t digest(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u);

/// The digest of every bit of a flight's state.
std::uint64_t digest(const Flight& flight);

/// 16 hexadecimal digits.
std::string shown_digest(std::uint64_t digest);

} // namespace starbow
