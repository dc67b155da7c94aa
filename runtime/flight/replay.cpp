#include "replay.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "history.h"
#include "input/choices.h"
#include <algorithm>

namespace starbow {
namespace fs = std::filesystem;
namespace {

/// Far longer than any written line. A longer line belongs to no record and is not read to its end.
constexpr std::size_t longest_line = 1 << 16;

/// True for a command whose effect the record's frames hold (what the hand did that steers, and the light that is shown), or
/// that has none on the flight, as names in the sky and the guide's pointer.
bool kept_in_frames(const Command& command)
{
    return switches_choice(command.kind) || aligns(command.kind) || command.kind == CommandKind::pointer;
}

} // namespace

Replay::Replay(const fs::path& file)
    : file_(one_line(file.string()))
    , stream_(file)
{
    if (stream_.has_fault())
        throw InputError(file_, "", stream_.fault() + "; a record of a flight is right");
    const auto first = line();
    if (!first && !cut_)
        throw InputError(file_, "", "is empty; a record of a flight is right");
    if (!first)
        throw InputError(file_ + ":1", "", "is cut off; a record of a flight is right");
    header_ = parse_record_header(file_, *first);
    const Flight start = flight_at(header_.start, header_.rules);
    pass_checks(&start);
}

/// The next line without its end; nullopt at the end of the file. An unfinished last line is left out: a crash
/// interrupted it.
std::optional<std::string> Replay::line()
{
    std::string text;
    while (at_ < got_ || (at_ = 0, got_ = stream_.read(piece_)) > 0) {
        const char c = piece_[at_++];
        ++read_;
        if (c == '\n') {
            ++line_;
            return text;
        }
        text += c;
        if (text.size() > longest_line)
            throw InputError(file_ + ":" + std::to_string(line_ + 1), "",
                "is longer than " + std::to_string(longest_line) + " bytes; a line that starbow has written is right");
    }
    cut_ = !text.empty();
    return {};
}

void Replay::look_ahead()
{
    ahead_.reset();
    auto text = line();
    if (!text)
        return;
    if (whole_)
        throw InputError(file_ + ":" + std::to_string(line_), "", "comes after the last line; nothing more is right");
    ahead_ = parse_record_line(file_, line_, std::move(*text));
}

std::optional<RecordEntry> Replay::next()
{
    if (open_)
        pass_checks(nullptr);
    open_ = ahead_.has_value();
    if (!ahead_)
        return {};
    RecordEntry entry = std::get<RecordEntry>(*ahead_);
    entry.controls.time_ns = time_ns_ += entry.controls.time_ns;
    ++frames_;
    return entry;
}

void Replay::compare(const Flight& flight) { pass_checks(&flight); }

/// Leaves the present frame, and compares the flight with all checks before the next one. Null: compares nothing.
void Replay::pass_checks(const Flight* flight)
{
    open_ = false;
    look_ahead();
    while (ahead_ && std::holds_alternative<RecordCheck>(*ahead_)) {
        const RecordCheck check = std::get<RecordCheck>(*ahead_);
        checks_ += flight != nullptr;
        if (flight && differs_.empty() && (check.ticks != flight->ticks || check.digest != digest(*flight)))
            differs_ = "by " + shown(double(flight->ticks) * tick_s) + " s of flight (" + file_ + ":" + std::to_string(line_)
                + "): " + shown_digest(digest(*flight)) + " instead of " + shown_digest(check.digest);
        whole_ = check.last;
        look_ahead();
    }
}

double Replay::part_read() const { return stream_.size() > 0 ? std::min(1.0, double(read_) / double(stream_.size())) : 0; }

std::string Replay::verdict() const
{
    std::string text = differs() ? "the replay differs from the record " + differs_
        : checks_ > 0            ? "the same to the bit at " + std::to_string(checks_) + (checks_ > 1 ? " checks" : " check")
                                 : "replayed, with nothing to compare: the record ends before its first check";
    if (cut_)
        text += "; the last line is incomplete and was left out";
    else if (!whole_)
        text += "; the record has no last line: its flight was cut off";
    return text;
}

const Command* exhibits_command(const RecordEntry& entry)
{
    const std::vector<Command>& commands = entry.commands;
    const auto at = std::ranges::find_if_not(commands, kept_in_frames);
    return at == commands.end() ? nullptr : &*at;
}

void fly_again(Replay& replay, const std::function<bool(const RecordEntry&, const Flight&)>& each)
{
    const RecordHeader& header = replay.header();
    Flight flight = flight_at(header.start, header.rules);
    History history;
    long shown = 0;
    while (const auto entry = replay.next()) {
        if (const Command* other = exhibits_command(*entry))
            throw InputError(replay.file() + ": frame " + std::to_string(shown) + " has a remote's command, "
                + one_line(words_of(*other)[0]) + ", that only an exhibit carries out; starbow run --replay is right");
        flight = flown(
            flight, history, entry->controls, entry->dt_ns, header.rules, header.seconds_per_time_unit, header.start);
        replay.compare(flight);
        if (!each(*entry, flight))
            return;
        shown += entry->shown;
    }
}

} // namespace starbow
