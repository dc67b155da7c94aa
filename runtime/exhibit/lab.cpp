#include "lab.h"
#include "runtime/operation/log.h"
#include <algorithm>

namespace starbow {

Measured measured_of(const MeasuringObserver& observer, const Ship& ship, const SceneFile& scene, const World& world,
    const Effects& effects, const Spot& aim, double light, const std::array<std::optional<Spot>, 2>& marks)
{
    const double seconds = scene.seconds_per_time_unit();
    Measured m{.observer = observer,
        .ship_s = ship.proper_time.total() * seconds,
        .world_s = observer.time * seconds,
        .light_speed_m_s = scene.light_speed_m_s,
        .seconds_per_time_unit = seconds,
        .effects = effects,
        .aim = read_spot(observer, aim, world, seconds)};
    m.aim.light = light;
    for (std::size_t i = 0; i < 2; ++i)
        if (marks[i])
            m.marks[i] = read_spot(observer, *marks[i], world, seconds);
    if (marks[0] && marks[1])
        m.pair = read_pair(observer, *marks[0], *marks[1], world, seconds);
    return m;
}

Lab::Lab(const std::filesystem::path& log, double every_s, const Words& words)
    : words_(words)
    , log_(log.empty() ? nullptr : std::make_unique<LabLog>(log, write_log))
    , every_s_(every_s)
{
}

void Lab::read(const FrameRenderer& frame, const LabSwitches& pressed, const GpuWorld& world, double dt_s,
    const std::function<void(std::string)>& say)
{
    if (pressed.overlay)
        overlay_ = Overlay((int(overlay_) + 1) % int(overlay_names.size()));
    if (pressed.why)
        why_ = Why((int(why_) + 1) % int(why_names.size()));
    if ((pressed.mark || pressed.log || every_s_ > 0) && overlay_ == Overlay::off)
        overlay_ = Overlay::aim; // marking and logging show the crosshair
    marks_due_ += pressed.mark;
    lines_due_ += pressed.log;
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
            marks_ = {};
        marks_[marks_[0] ? 1 : 0] = snapped(aimed, world.world);
    }
    measured_ = measured_of(frame.head(), ship_, world.scene, world.world, effects_, aimed, probed[0].light, marks_);
    waited_s_ += dt_s;
    if (every_s_ > 0 && waited_s_ >= every_s_)
        lines_due_ = std::max(lines_due_, 1); // a press in the same frame writes this line
    for (; lines_due_ > 0; --lines_due_) {
        waited_s_ = 0;
        keep(say);
    }
}

void Lab::keep(const std::function<void(std::string)>& say)
{
    if (!log_)
        say(words_("lab.no_log"));
    else if (log_->write(*measured_, overlay_names[std::size_t(overlay_)]) && every_s_ == 0)
        say(words_("lab.logged", {{"line", std::to_string(log_->lines())}, {"file", log_->file().filename().string()}}));
}

void Lab::request(
    FrameRenderer& frame, const Shot& shot, const Flight& flight, const GpuWorld& world, const Typesetter& typesetter)
{
    if (!on()) {
        frame.measure({});
        return;
    }
    ship_ = flight.ship, effects_ = flight.effects;
    const auto now = std::chrono::steady_clock::now();
    // The same rate as the display's figures keeps them readable.
    const bool again = now - drawn_ > std::chrono::milliseconds(100);
    if (again)
        scale_ = overlay_scale(world.world, shot.position, world.scene.seconds_per_time_unit()), drawn_ = now;
    Measuring what{
        .probes = {{glm::dvec3(0, 0, -1)}}, .over = {overlay_ == Overlay::off ? Overlay::aim : overlay_, marks_, scale_}};
    if (measured_ && flight.hud) {
        const double aspect = lab_aspect(overlay_, why_);
        const int width = frame.views().lab_panel_width(aspect);
        if (again || panel_.size != glm::ivec2(width, int(width * aspect)))
            panel_ = draw_lab_panel(typesetter, words_, *measured_, overlay_, scale_, why_, width);
        what.panel = &panel_;
        what.scale = scale_place(overlay_, why_);
    }
    frame.measure(what);
}

} // namespace starbow
