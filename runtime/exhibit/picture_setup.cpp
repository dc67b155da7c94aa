#include "picture_setup.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "runtime/hud/pointer_ring.h"
#include "runtime/hud/signs.h"
#include "runtime/operation/log.h"
#include <cmath>

namespace starbow {

/// The part of the head-up display's width that an inset has.
static constexpr double inset_part = 0.42;

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
            .over = {on->overlay, on->marks, on->scale, now.figures},
            .panel = on->panel,
            .scale = on->scale_place};
    else if (now.figures)
        what = {.over = {.figures = true}};
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
    if (now.pattern == Pattern::none) {
        place_sky_labels(now.sky_labels, views, degree_px);
        place_highlights(now.highlights, views, degree_px);
    }
    if (now.pointer && now.pattern == Pattern::none) {
        // So few steps that most frames of a glide draw no ring anew, and so many that a fade is smooth.
        const int step = int(std::lround(32 * now.pointer->strength));
        const Panel& ring
            = pointer_.of({std::to_string(step)}, degree_px, [&] { return draw_pointer(step / 32.0, degree_px); });
        callouts_.push_back({.letters = &ring, .place = views.place_at(now.pointer->towards, half_of(ring, degree_px))});
    }
    if (place_small_picture(now, views))
        frame.drop_insets();
    else
        place_insets(now, frame, degree_px);
    frame.place(callouts_);
}

void PictureSetup::place_sky_labels(const std::vector<SkyLabel>& labels, const ViewSet& views, double degree_px)
{
    std::map<std::string, Plate> kept; // a name's plate stays while it is in the picture
    for (const SkyLabel& label : labels)
        kept[label.name] = std::move(sky_names_[label.name]);
    sky_names_ = std::move(kept);
    const double gap = std::tan(0.4 * degree); // above a star
    for (const SkyLabel& label : labels) {
        const Panel& panel = sky_names_[label.name].of(
            {label.name}, degree_px, [&] { return draw_name(typesetter, label.name, degree_px); });
        const PanelPass::Place place = views.place_above(label.towards, half_of(panel, degree_px), -gap);
        if (views.shows_whole(place)) // a name that the picture's edge cuts is no name
            callouts_.push_back({.letters = &panel, .place = place});
    }
}

void PictureSetup::place_highlights(const std::vector<ShownHighlight>& highlights, const ViewSet& views, double degree_px)
{
    for (std::size_t k = 0; k < highlights.size() && k < rings_.size(); ++k) {
        const ShownHighlight& highlight = highlights[k];
        const double ring_px = std::round(ring_deg(highlight) * degree_px);
        if (ring_px == 0)
            continue;
        const Panel& panel = rings_[k].of(
            {highlight.name}, ring_px, [&] { return draw_ring(typesetter, highlight.name, ring_px, degree_px); });
        const double below = ring_middle_px(ring_px, degree_px) * std::tan(degree) / degree_px;
        callouts_.push_back(
            {.letters = &panel, .place = views.place_above(highlight.towards, half_of(panel, degree_px), below)});
    }
}

/// An inset to be drawn, and the highlight whose thing it enlarges.
struct PictureSetup::WantedInset {
    Shot shot;
    double fov_deg;
    const std::string& name;
    const ShownHighlight* highlight; ///< null: the inset that the visitor chose
};

/// That of the menu's choice, over the choice, in place of insets. Returns false where there is none.
bool PictureSetup::place_small_picture(const PictureState& now, const ViewSet& views)
{
    if (!now.hud || !now.hud->readings.caption || now.pattern != Pattern::none)
        return false;
    const SmallPicture* small = thumbnails_.find(now.hud->readings.caption->picture);
    if (!small)
        return false;
    const double half_x = inset_part * views.hud_place.half.x;
    const glm::dvec2 half(half_x, half_x * small->size.y / small->size.x);
    callouts_.push_back({.small = small, .place = views.place_beside_hud(half, 0, views.hud_place.half.x - half_x)});
    return true;
}

/// Those of the highlighted things that are to be enlarged, or else the one that the visitor chose.
std::vector<PictureSetup::WantedInset> PictureSetup::wanted_insets(const PictureState& now)
{
    std::vector<WantedInset> wanted;
    for (const ShownHighlight& highlight : now.highlights)
        if (highlight.enlarged_deg > 0 && wanted.size() < names_.size())
            wanted.push_back({looking(now.shot, highlight.towards), highlight.enlarged_deg, highlight.name, &highlight});
    if (const std::optional<InsetPicture>& own = now.inset; own && wanted.empty())
        wanted.push_back({inset_shot(now.shot, own->kind, own->start_ev), own->fov_deg, own->name, nullptr});
    return wanted;
}

void PictureSetup::place_insets(const PictureState& now, FrameRenderer& frame, double degree_px)
{
    const std::vector<WantedInset> wanted = now.pattern == Pattern::none ? wanted_insets(now) : std::vector<WantedInset>();
    if (wanted.empty())
        no_room_ = false;
    const double half_x = inset_part * frame.views().hud_place.half.x;
    const int width = std::clamp(int(2 * half_x / std::tan(degree) * degree_px), 64, 1024);
    std::size_t drawn = 0;
    try {
        for (; !no_room_ && drawn < wanted.size(); ++drawn)
            frame.show_inset(wanted[drawn].shot, width, wanted[drawn].fov_deg, drawn);
    } catch (const InputError& error) {
        no_room_ = true;
        write_log(LogKind::inset_no_room, one_line(error.what()) + "; the inset is left out");
    }
    frame.drop_insets(drawn);
    for (std::size_t k = 0; k < drawn; ++k) // the first at the left
        place_inset(wanted[k], k, double(drawn - 1 - k) * (2 * half_x + 0.02), half_x, frame, degree_px);
}

void PictureSetup::place_inset(
    const WantedInset& inset, std::size_t which, double aside, double half_x, const FrameRenderer& frame, double degree_px)
{
    const ViewSet& views = frame.views();
    const glm::dvec2 half(half_x, half_x * Inset::aspect);
    const Callout picture{.picture = &frame.inset_picture(which), .place = views.place_beside_hud(half, 0, aside)};
    if (inset.highlight) {
        const double ring = ring_deg(*inset.highlight) * degree, half_width = half_of(line_, line_degree_px).x;
        if (const auto place = ViewSet::place_line(picture.place, inset.highlight->towards, ring, half_width))
            callouts_.push_back({.letters = &line_, .place = *place});
    }
    const Panel& name
        = names_[which].of({inset.name}, degree_px, [&] { return draw_name(typesetter, inset.name, degree_px); });
    callouts_.push_back(picture);
    callouts_.push_back({.letters = &name, .place = views.place_beside_hud(half_of(name, degree_px), 2 * half.y, aside)});
}

} // namespace starbow
