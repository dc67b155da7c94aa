#include "lab.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "runtime/hud/lab_scales.h"
#include "runtime/operation/log.h"
#include <algorithm>

namespace starbow {

Lab::Lab(const std::filesystem::path& log, double every_s, bool by_eye, const Words& words)
    : words_(words)
    , log_(log.empty() ? nullptr : std::make_unique<LabLog>(log, write_log))
    , every_s_(every_s)
    , by_eye_(by_eye)
    , panel_number_(std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count())
{
    if (!log_ || log_->lines() == 0)
        return;
    const std::string name = log.string(),
                      bytes = read_whole(log, most_lab_bytes, "a log that starbow run --log has written");
    for (const auto& [number, text] : lab_texts(bytes, name))
        add_to_plots(text, number);
}

void Lab::add_to_plots(std::string_view text, long number)
{
    LabLine line;
    try {
        line = read_lab_line(text, log_->file().string(), number);
    } catch (const InputError& error) {
        // A line that a power cut has cut is no reason not to fly.
        write_log(LogKind::lab_line_skipped, std::string(error.what()) + "; the plots leave this line out");
        return;
    }
    constexpr std::size_t most = 100'000; // more would cost frames; hours of a log that is written by itself
    for (std::size_t i = 1; i < plot_names.size(); ++i) {
        add_points(points_[i], Plot(i), last_line_ ? &*last_line_ : nullptr, line);
        if (points_[i].size() > most)
            points_[i].erase(points_[i].begin(), points_[i].begin() + most / 2);
    }
    last_line_ = std::move(line);
}

void Lab::read(const FrameRenderer& frame, Switches pressed, const GpuWorld& world, double dt_s,
    const std::function<void(std::string)>& say)
{
    if (pressed[Switch::overlay])
        overlay_ = Overlay((int(overlay_) + 1) % int(overlay_names.size()));
    if (pressed[Switch::why])
        why_ = Why((int(why_) + 1) % int(why_names.size()));
    if (pressed[Switch::plot])
        plot_ = Plot((int(plot_) + 1) % int(plot_names.size()));
    if ((pressed[Switch::mark] || pressed[Switch::log] || every_s_ > 0) && overlay_ == Overlay::off)
        overlay_ = Overlay::aim; // marking and logging show the crosshair
    if (pressed.any())
        said_.clear();
    keep_reading(say);
    marks_due_ += pressed[Switch::mark];
    lines_due_ += pressed[Switch::log];
    if (!on() || effects_.comparison != Comparison::none) { // the instruments measure the physical picture only
        measured_.reset();
        marks_due_ = lines_due_ = 0;
        return;
    }
    const std::vector<Probed> probed = frame.probed();
    if (probed.empty())
        return; // the first frame with instruments is still to come
    const MeasuringObserver& observer = frame.observer();
    Probed seen = probed[0];
    seen.ray = aim_of(observer); // exact, unlike the picture's pixel
    const Spot aimed = spot_at(observer, seen, world.world);
    for (; marks_due_ > 0; --marks_due_) {
        if (marks_[0] && marks_[1])
            marks_ = {}, mark_numbers_ = {};
        mark_numbers_[marks_[0] ? 1 : 0] = ++marks_made_;
        marks_[marks_[0] ? 1 : 0] = snapped(aimed, world.world);
    }
    measured_ = measured_of(frame.head(), ship_, world.scene, world.world, effects_, aimed, probed[0].light, marks_);
    measured_->mark_numbers = mark_numbers_;
    waited_s_ += dt_s;
    if (every_s_ > 0 && waited_s_ >= every_s_ && (lines_due_ == 0 || by_eye_)) { // otherwise the press writes this line
        waited_s_ = 0;
        keep_line(*measured_, {}, say);
    }
    for (; lines_due_ > 0; --lines_due_) {
        waited_s_ = 0;
        keep(say);
    }
}

void Lab::type(std::string_view keys)
{
    if (!writes() || keys.empty())
        return;
    entry_->type(keys);
    drawn_ = {}; // the key is in the next picture
}

void Lab::keep(const std::function<void(std::string)>& say)
{
    if (!log_)
        say(words_("lab.no_log"));
    else if (by_eye_)
        entry_.emplace(*measured_), said_.clear(), drawn_ = {};
    else
        keep_line(*measured_, {}, say);
}

void Lab::keep_reading(const std::function<void(std::string)>& say)
{
    if (!entry_ || entry_->open())
        return;
    if (const std::optional<WrittenReading> reading = entry_->written()) {
        keep_line(entry_->instant(), reading, say);
        said_ = says_of(*reading, words_);
    }
    entry_.reset();
    drawn_ = {};
}

void Lab::keep_line(
    const Measured& measured, const std::optional<WrittenReading>& reading, const std::function<void(std::string)>& say)
{
    if (log_->write(measured, overlay_names[std::size_t(overlay_)], reading)) {
        add_to_plots(log_->last(), log_->lines() + 1);
        drawn_ = {}; // the point is in the next picture
        if (every_s_ == 0)
            say(words_("lab.logged", {{"line", std::to_string(log_->lines())}, {"file", log_->file().filename().string()}}));
    }
}

std::optional<Instruments> Lab::request(
    const ViewSet& views, const Shot& shot, const Flight& flight, const GpuWorld& world, const Typesetter& typesetter)
{
    if (!on())
        return {};
    ship_ = flight.ship, effects_ = flight.effects;
    const auto now = std::chrono::steady_clock::now();
    // The same rate as the display's figures keeps them readable.
    const bool again = now - drawn_ > std::chrono::milliseconds(100);
    if (again)
        scale_ = overlay_scale(world.world, shot.position, world.scene.seconds_per_time_unit()), drawn_ = now;
    Instruments what{overlay_ == Overlay::off ? Overlay::aim : overlay_, marks_, scale_};
    if (measured_ && (flight.hud || entry_)) {
        const int width = views.lab_panel_width(aspect());
        if (again || panel_.size != glm::ivec2(width, int(width * aspect())))
            panel_ = draw_panel(typesetter, width), ++panel_number_;
        what.panel = &panel_, what.panel_number = panel_number_;
        if (plot_ == Plot::none && !entry_)
            what.scale_place = scale_place(overlay_, why_);
    }
    return what;
}

double Lab::aspect() const { return entry_ ? entry_aspect : plot_ == Plot::none ? lab_aspect(overlay_, why_) : plot_aspect; }

Panel Lab::draw_panel(const Typesetter& typesetter, int width) const
{
    if (entry_)
        return draw_lines(typesetter, entry_->lines(words_), {width, int(width * entry_aspect)});
    if (plot_ == Plot::none)
        return draw_lab_panel(typesetter, words_, *measured_, {overlay_, scale_, why_, by_eye_, said_}, width,
            std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
    return draw_lab_plot(typesetter, words_, plot_, points_[std::size_t(plot_)], glm::length(measured_->observer.u), width);
}

} // namespace starbow
