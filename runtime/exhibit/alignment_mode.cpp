#include "alignment_mode.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "runtime/operation/log.h"

namespace starbow {

void AlignmentMode::say(std::string line)
{
    write_log(LogKind::alignment_changed, line);
    says_ = std::move(line);
    until_ = Clock::now() + std::chrono::seconds(8);
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

bool AlignmentMode::apply(const Controls& controls, Layout& layout)
{
    if (controls[Switch::home] || controls[Switch::reset])
        show_first();
    if (controls[Switch::pattern]) {
        pattern_ = Pattern((int(pattern_) + 1) % int(pattern_names.size()));
        write_log(LogKind::pattern_shown, std::string("test pattern: ") + pattern_names[std::size_t(pattern_)]);
    }
    if (controls[Switch::save])
        save(layout);
    const std::vector<Adjustable> all = adjustables(layout);
    const std::size_t count = all.size();
    chosen_ = std::min(chosen_, count - 1);
    // The first press shows the chosen number; further presses move on.
    if (controls.choose != 0 && std::exchange(choosing_, true))
        chosen_ = (chosen_ + count + std::size_t(controls.choose + int(count))) % count;
    const bool turned = controls.turn_by != 0;
    if (turned) {
        layout = adjusted(std::move(layout), all[chosen_], controls.turn_by);
        choosing_ = true;
    }
    if (turned || controls.choose != 0)
        say(all[chosen_].name + ": " + shown(value_of(layout, all[chosen_]))
            + (turned ? "   (F5 saves it)" : "   (Page Up, Page Down)"));
    return turned;
}

} // namespace starbow
