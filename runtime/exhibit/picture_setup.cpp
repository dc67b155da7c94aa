#include "picture_setup.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "runtime/hud/pointer_ring.h"
#include "runtime/hud/signs.h"
#include "runtime/operation/log.h"
#include <cmath>

namespace starbow {

/// Pixels of the head-up display to a degree.
static double degree_px_of(const ViewSet& views)
{
    return views.hud_width() * std::tan(degree) / (2 * views.hud_place.half.x);
}

/// Half the extent of a panel on the plane z = 1.
static glm::dvec2 half_of(const Panel& panel, double degree_px)
{
    return 0.5 * glm::dvec2(panel.size) * (std::tan(degree) / degree_px);
}

Callout title_over(const ViewSet& views, const Typesetter& typesetter, const std::string& title, Plate& plate)
{
    const int width = views.hud_width();
    const Panel& panel = plate.of({title}, width, [&] { return draw_title(typesetter, title, width); });
    return {.letters = &panel, .place = views.place_over_middle(half_of(panel, degree_px_of(views)))};
}

const Panel* PictureSetup::set_up(const PictureState& now, const Words& words, FrameRenderer& frame)
{
    frame.move_head(now.head);
    frame.meter(now.meters);
    frame.range(now.range);
    frame.bloom(now.bloom);
    frame.fade(now.fade);
    frame.vignette(now.vignette, now.vignette_part);
    frame.show(now.pattern);
    std::optional<Measuring> what;
    if (const std::optional<Instruments>& on = now.instruments)
        what = {.probes = {{glm::dvec3(0, 0, -1)}},
            .over = {on->overlay, on->marks, on->scale},
            .panel = on->panel,
            .scale = on->scale_place};
    frame.measure(what);
    place(now, frame);
    return now.hud ? panel_of(*now.hud, words, frame.views().hud_width()) : nullptr;
}

const Panel* PictureSetup::panel_of(const HudText& hud, const Words& words, int width)
{
    if (hud.number != drawn_ || panel_.size.x != width) {
        panel_ = typesetter.draw(hud.readings, words, width);
        drawn_ = hud.number;
    }
    return &panel_;
}

void PictureSetup::place(const PictureState& now, FrameRenderer& frame)
{
    const ViewSet& views = frame.views();
    const double degree_px = degree_px_of(views);
    callouts_.clear();
    if (!now.title.empty() && now.pattern == Pattern::none)
        callouts_.push_back(title_over(views, typesetter, now.title, title_));
    if (now.sign) {
        const std::vector<std::string>& lines = now.sign->lines;
        const Panel& panel = sign_.of(lines, degree_px, [&] { return draw_sign(typesetter, lines, degree_px); });
        callouts_.push_back({.letters = &panel, .place = views.place_above(now.sign->towards, half_of(panel, degree_px))});
    }
    if (now.pointer && now.pattern == Pattern::none) {
        // So few steps that most frames of a glide draw no ring anew, and so many that a fade is smooth.
        const int step = int(std::lround(32 * now.pointer->strength));
        const Panel& ring
            = pointer_.of({std::to_string(step)}, degree_px, [&] { return draw_pointer(step / 32.0, degree_px); });
        callouts_.push_back({.letters = &ring, .place = views.place_at(now.pointer->towards, half_of(ring, degree_px))});
    }
    if (!now.inset)
        no_room_ = false;
    if (!now.inset || now.pattern != Pattern::none)
        frame.drop_inset();
    else if (!no_room_)
        add_inset(*now.inset, now.shot, frame, degree_px);
    frame.place(callouts_);
}

void PictureSetup::add_inset(const InsetPicture& picture, const Shot& shot, FrameRenderer& frame, double degree_px)
{
    const ViewSet& views = frame.views();
    const double half_x = 0.42 * views.hud_place.half.x;
    const glm::dvec2 half(half_x, half_x * Inset::aspect);
    try {
        const int width = std::clamp(int(2 * half.x / std::tan(degree) * degree_px), 64, 1024);
        frame.show_inset(inset_shot(shot, picture.kind, picture.start_ev), width, picture.fov_deg);
    } catch (const InputError& error) {
        no_room_ = true;
        write_log(LogKind::inset_no_room, one_line(error.what()) + "; the inset is left out");
        return;
    }
    const Panel& name = name_.of({picture.name}, degree_px, [&] { return draw_name(typesetter, picture.name, degree_px); });
    const glm::dvec2 name_half = half_of(name, degree_px);
    callouts_.push_back({.picture = &frame.inset_picture(), .place = views.place_beside_hud(half, 0)});
    callouts_.push_back({.letters = &name, .place = views.place_beside_hud(name_half, 2 * half.y)});
}

} // namespace starbow
