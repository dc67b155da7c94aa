#include "alignment_mode.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "runtime/hud/handle.h"
#include "runtime/operation/log.h"
#include <algorithm>
#include <utility>

namespace starbow {

void AlignmentMode::say(std::string line)
{
    write_log(LogKind::alignment_changed, line);
    says_ = std::move(line);
    until_ = Clock::now() + std::chrono::seconds(8);
}

std::string AlignmentMode::refuse(const std::string& why)
{
    moves_.erase(moves_.begin() + std::ptrdiff_t(std::min(moves_before_, moves_.size())), moves_.end());
    const std::size_t place = why.rfind(": ");
    std::string problem = "This " + (place == why.npos ? "can't be shown: " + why : why.substr(place + 2));
    say(problem);
    return problem;
}

void AlignmentMode::save(const Layout& layout)
{
    try {
        // Compares with the file's present content, so that other people's edits stay.
        const std::vector<Change> turned = changes(load_layout(layout.file), layout);
        if (turned.empty())
            return say("Nothing has been changed since the layout was saved");
        patch_file(layout.file, turned);
        std::string line = "Saved in " + layout.file.filename().string();
        for (const Change& change : turned)
            line += ": " + change.pointer + " " + change.value.dump();
        say(line);
    } catch (const InputError& error) {
        say(one_line(error.what()));
    }
}

namespace {

std::optional<Grip> find_grip(const Layout& layout, const std::string& name)
{
    for (Grip& one : grips(layout))
        if (one.name == name)
            return std::move(one);
    return {};
}

/// A grip's numbers, for people.
std::string numbers_of(const Layout& layout, const Grip& grip)
{
    std::string text;
    for (const Adjustable& one : grip.numbers)
        text += (text.empty() ? "" : ", ") + shown(value_of(layout, one));
    return text;
}

std::string one_of(const std::vector<Grip>& grips)
{
    return grips.empty() ? "a layout with a \"quad\" or a turn" : "one of its own, such as \"" + grips.front().name + "\",";
}

/// The numbers of another layout in this one, where both have them and they differ.
Layout with_numbers_of(const Layout& layout, const Layout& other) { return turned_again(layout, layout, other); }

} // namespace

void AlignmentMode::choose_grip(const Layout& layout, const Grip& grip)
{
    grip_ = grip.name, grip_says_ = numbers_of(layout, grip), handle_ = handle_direction(layout, grip.numbers[0]);
    say(grip_ + ": " + grip_says_);
}

void AlignmentMode::reset_moves()
{
    moves_.clear(), queued_.clear(), moved_.reset();
    grip_.clear(), grip_says_.clear(), handle_.reset();
}

bool AlignmentMode::queue(const Command& command, const Layout& layout)
{
    switch (command.kind) {
    case CommandKind::grip:
        if (const std::optional<Grip> grip = find_grip(layout, command.text))
            choose_grip(layout, *grip);
        else
            throw InputError(
                "the layout has no grip \"" + one_line(command.text) + "\"; " + one_of(grips(layout)) + " is right");
        return true;
    case CommandKind::move:
        if (grip_.empty())
            throw InputError("no grip is chosen yet; the command grip before is right");
        break;
    case CommandKind::move_back:
        if (moves_.empty() && queued_.empty())
            throw InputError("nothing has been moved; a move before is right");
        break;
    case CommandKind::as_saved:
    case CommandKind::keep:
        break;
    default:
        return false;
    }
    queued_.push_back(command);
    return true;
}

bool AlignmentMode::apply_command(const Command& command, Layout& layout, const Layout& kept)
{
    if (command.kind == CommandKind::as_saved && command.on) {
        if (moved_)
            return false;
        moved_ = layout;
        layout = with_numbers_of(layout, kept);
        return true;
    }
    // Whatever else is done is done to the builder's own picture.
    bool changed = show_moved(layout);
    if (command.kind == CommandKind::move_back && !moves_.empty()) {
        const Move last = std::move(moves_.back());
        moves_.pop_back();
        layout = turned_again(layout, last.after, last.before);
        changed = true;
    }
    if (const auto grip = find_grip(layout, grip_); grip && command.kind == CommandKind::move) {
        constexpr std::size_t most_moves = 200;
        Layout after = moved(layout, *grip, command.number, command.second);
        moves_.push_back({std::exchange(layout, after), std::move(after)});
        if (moves_.size() > most_moves)
            moves_.erase(moves_.begin());
        changed = true;
    }
    if (const auto grip = find_grip(layout, grip_); grip && changed)
        choose_grip(layout, *grip);
    if (command.kind == CommandKind::keep)
        save(layout);
    return changed;
}

bool AlignmentMode::show_moved(Layout& layout)
{
    if (!moved_)
        return false;
    layout = with_numbers_of(layout, *std::exchange(moved_, {}));
    return true;
}

bool AlignmentMode::turn_by_keys(const Controls& controls, Layout& layout)
{
    const std::vector<Adjustable> all = adjustables(layout);
    const std::size_t count = all.size();
    if (count == 0) {
        say("This layout has no number to change; a \"quad\" in a viewport gives it some");
        return false;
    }
    chosen_ = std::min(chosen_, count - 1);
    // The first press shows the chosen number; further presses move on.
    if (controls.choose != 0 && std::exchange(choosing_, true))
        chosen_ = (chosen_ + count + std::size_t(controls.choose + int(count))) % count;
    const bool turned = controls.turn_by != 0;
    if (turned) {
        layout = adjusted(std::move(layout), all[chosen_], controls.turn_by);
        choosing_ = true;
    }
    handle_ = handle_direction(layout, all[chosen_]);
    say(all[chosen_].name + ": " + shown(value_of(layout, all[chosen_]))
        + (turned ? "   (F5 saves it)" : "   (Page Up, Page Down)"));
    return turned;
}

bool AlignmentMode::apply(const Controls& controls, Layout& layout, const Layout& kept)
{
    if (controls[Switch::home] || controls[Switch::reset])
        show_first();
    if (controls[Switch::pattern]) {
        pattern_ = Pattern((int(pattern_) + 1) % int(pattern_names.size()));
        write_log(LogKind::pattern_shown, std::string("test pattern: ") + pattern_names[std::size_t(pattern_)]);
    }
    const bool saves = controls[Switch::save], turns = controls.choose != 0 || controls.turn_by != 0;
    bool changed = (saves || turns) && show_moved(layout);
    if (saves)
        save(layout);
    if (turns)
        changed |= turn_by_keys(controls, layout);
    moves_before_ = moves_.size();
    for (const Command& command : std::exchange(queued_, {}))
        changed |= apply_command(command, layout, kept);
    return changed;
}

} // namespace starbow
