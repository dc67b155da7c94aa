#include "sound.h"
#include "config/json/reader.h"
#include "page_bytes.h"
#include <algorithm>
#include <cmath>
#include <zlib.h>

namespace starbow {
namespace {

/// Frames are nanoseconds since 1970 where a master begins; these are of the year 2262.
constexpr std::int64_t last_frame = std::int64_t(1) << 62;
constexpr std::size_t most_name = 64, most_file_name = 300, most_digest = 64;
constexpr double longest_frame_ms = 1e6, whole_sphere_sr = 12.57;
/// No panel is wider: a texture that every GPU can hold.
constexpr std::int32_t most_page_side = 8192;
constexpr std::size_t most_sign_lines = 8, most_sign_letters = 200, most_choices = 256, most_highlights = 2;

/// Collects the first fault.
struct Faults {
    std::string first{};

    void when(bool wrong, const char* what)
    {
        if (wrong && first.empty())
            first = what;
    }
    void outside(const char* what, double value, double low, double high)
    {
        if (first.empty() && !(value >= low && value <= high))
            first = std::string("has ") + what + " " + shown(value) + "; a number from " + shown(low) + " to " + shown(high)
                + " is right";
    }
    void outside(const char* what, const glm::dvec3& value, double most)
    {
        for (int i = 0; i < 3; ++i)
            outside(what, value[i], -most, most);
    }
    void no_unit(const char* what, double squared) { outside(what, squared, 0.999, 1.001); }
    void no_turn(const char* what, const glm::dquat& q) { no_unit(what, q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z); }
};

bool is_name(const std::string& text, std::size_t most) { return !text.empty() && text.size() <= most; }

void look_at(const Shot& shot, Faults& faults)
{
    constexpr double far = 1e30, most_gamma = 1e9;
    faults.outside("the time", shot.time, -far, far);
    faults.outside("the place", shot.position, far);
    faults.outside("the velocity", shot.u, most_gamma);
    faults.no_turn("a turn of the ship whose square is", shot.ship_from_cockpit);
    faults.outside("the exposure", shot.exposure_ev, -1000, 1000);
}

void look_at(const RangeCurve& curve, Faults& faults)
{
    constexpr double most_stops = 1000;
    faults.outside("the curve's low end", curve.low, -most_stops, most_stops);
    faults.outside("the curve's high end", curve.high, curve.low, most_stops);
    for (const double knot : curve.shown)
        faults.outside("a knot of the curve", knot, -most_stops, most_stops);
    faults.when(!std::ranges::is_sorted(curve.shown), "has a curve that falls");
}

void look_at(const Caption& caption, Faults& faults)
{
    const int count = int(caption.choices.size());
    faults.when(caption.choices.size() > most_choices, "has too many choices");
    faults.when(caption.chosen < -1 || caption.chosen >= count, "has a chosen choice that is none of its choices");
    faults.when(caption.right < -1 || caption.right >= count, "has a right choice that is none of its choices");
    faults.when(caption.menu && caption.chosen < 0, "has a menu without a choice");
}

void look_at(const Readings& shown, Faults& faults)
{
    constexpr double most = 1e30;
    faults.outside("1 - v/c", shown.beta_deficit, 0, 1);
    faults.outside("the view's cosine", shown.looked_cosine, -1, 1);
    faults.outside("gamma", shown.gamma, 0.999, most);
    faults.outside("the Doppler factor", shown.doppler_ahead, 0, most);
    for (const double number : {shown.ship_s, shown.world_s, shown.distance_m, shown.exposure_ev})
        faults.outside("a reading", number, -most, most);
    faults.outside("the speed of light", shown.light_speed_m_s, 1e-30, most);
    faults.outside("the frames per second", shown.frames_per_s, 0, most);
    if (shown.range) {
        faults.outside("the view's stops", shown.range->stops, 0, 1000);
        faults.outside("the shown stops", shown.range->shown, 0, 1000);
    }
    if (shown.lever)
        faults.outside("the lever", *shown.lever, 0, 1);
    if (shown.caption)
        look_at(*shown.caption, faults);
}

void look_at(const Instruments& on, Faults& faults)
{
    constexpr double most = 1e30;
    for (const std::optional<Spot>& mark : on.marks)
        if (mark) {
            faults.outside("a mark's place", mark->at, most);
            faults.when(mark->frame < 0, "has a mark without a frame");
            faults.when(mark->sky && mark->clock, "has a mark on a clock of the sky");
        }
    faults.outside("the nearest colour", on.scale.nearest_s, 0, most);
    faults.outside("the farthest colour", on.scale.farthest_s, on.scale.nearest_s, most);
    faults.outside("the contours' step", on.scale.emission_step_s, 0, most);
    faults.when(on.panel_number < 0, "has a page with a number below 0");
    for (int i = 0; i < 4; ++i)
        faults.outside("the scale's place", on.scale_place[i], -most_page_side, most_page_side);
}

void look_at(const PictureState& now, Faults& faults)
{
    look_at(now.shot, faults);
    faults.outside("the head's way", now.head.moved_m, 100);
    faults.no_turn("a turn of the head whose square is", now.head.turned);
    if (now.range)
        look_at(*now.range, faults);
    faults.outside("the bloom", now.bloom, 0, 1);
    faults.outside("the part of black", now.fade, 0, 1);
    faults.outside("the vignette's elevation", now.vignette.elevation_deg, -90, 90);
    faults.outside("the vignette's clear part", now.vignette.clear_deg, 0, 180);
    faults.outside("the vignette's soft part", now.vignette.soft_deg, 0.001, 180);
    faults.outside("the vignette's darkness", now.vignette.darkness, 0, 1);
    faults.outside("the vignette's part", now.vignette_part, 0, 1);
    if (now.hud) {
        faults.when(now.hud->number < 0, "has a text with a number below 0");
        look_at(now.hud->readings, faults);
    }
    faults.when(now.title.size() > most_sign_letters, "has too long a title");
    if (now.sign) {
        faults.when(now.sign->lines.size() > most_sign_lines, "has a sign with too many lines");
        for (const std::string& line : now.sign->lines)
            faults.when(line.size() > most_sign_letters, "has a sign with too long a line");
        faults.no_unit("a sign in a direction whose square is", glm::dot(now.sign->towards, now.sign->towards));
    }
    faults.when(now.highlights.size() > most_highlights, "has more than two highlights");
    for (const ShownHighlight& highlight : now.highlights) {
        faults.when(highlight.name.size() > most_sign_letters, "has a highlight with too long a name");
        faults.no_unit("a highlight in a direction whose square is", glm::dot(highlight.towards, highlight.towards));
        faults.outside("a highlight's radius", highlight.radius, 0, 1.6);
        faults.outside("a highlight's field", highlight.enlarged_deg, 0, inset_fov_deg);
    }
    faults.when(now.sky_labels.size() > most_sky_labels, "has too many names of the sky");
    for (const SkyLabel& label : now.sky_labels) {
        faults.when(label.name.size() > most_sign_letters, "has too long a name of the sky");
        faults.no_unit("a name in a direction whose square is", glm::dot(label.towards, label.towards));
    }
    if (now.inset) {
        faults.when(now.inset->kind == InsetView::none, "has an inset of nothing");
        faults.outside("the inset's exposure", now.inset->start_ev, -1000, 1000);
        faults.outside("the inset's field", now.inset->fov_deg, 1e-9, 170);
        faults.when(now.inset->name.size() > most_sign_letters, "has an inset with too long a name");
    }
    if (now.instruments)
        look_at(*now.instruments, faults);
}

void look_at(const std::vector<LuminanceSample>& samples, Faults& faults)
{
    for (const LuminanceSample& sample : samples) {
        faults.outside("a luminance", double(sample.luminance), 0, 3.5e38);
        faults.outside("a solid angle", double(sample.solid_angle_sr), 0, whole_sphere_sr);
    }
}

void look_at(const FileDigests& files, Faults& faults)
{
    for (const auto& [name, digest] : files)
        faults.when(
            !is_name(name, most_file_name) || !is_name(digest, most_digest), "has a file without a name or a digest");
}

} // namespace

std::string fault_of(const StateMessage& state)
{
    Faults faults;
    faults.outside("the frame", double(state.frame), 0, double(last_frame));
    faults.when(state.bytes.empty() || state.bytes.size() > most_state_bytes, "has no state of 1 to 4096 bytes");
    faults.when(state.led_ms < 0, "says a time below 0");
    return faults.first;
}

std::string fault_of(const ReadyMessage& ready)
{
    Faults faults;
    faults.when(!is_name(ready.node, most_name), "has no name of a node");
    faults.outside("the frame", double(ready.frame), 0, double(last_frame));
    faults.outside("the time of a frame", ready.frame_ms, 0, longest_frame_ms);
    for (const ViewSamples& view : ready.samples) {
        faults.when(view.view < 0, "has samples of a view below 0");
        look_at(view.surfaces, faults), look_at(view.stars, faults);
    }
    return faults.first;
}

std::string fault_of(const GoMessage& go)
{
    Faults faults;
    faults.outside("the frame", double(go.frame), 0, double(last_frame));
    for (const std::string& member : go.members)
        faults.when(!is_name(member, most_name), "has no name of a node");
    return faults.first;
}

std::string fault_of(const ConfigMessage& config)
{
    Faults faults;
    faults.when(!is_name(config.node, most_name), "has no name of a node");
    look_at(config.files, faults), look_at(config.layout, faults);
    return faults.first;
}

std::string fault_of(const PageMessage& page)
{
    Faults faults;
    faults.when(page.number <= 0, "has no number");
    faults.outside("the width", page.width, 1, most_page_side);
    faults.outside("the height", page.height, 1, most_page_side);
    const std::int64_t pixels = std::int64_t(page.width) * page.height;
    faults.when(pixels > most_page_pixels, "has too many pixels");
    faults.when(faults.first.empty() && page.texels.size() > compressBound(uLong(2 * pixels)), "has more bytes than pixels");
    return faults.first;
}

std::string fault_of(const SharedState& shared)
{
    Faults faults;
    faults.when(shared.scene.empty(), "has no scene");
    faults.when(shared.level < -1, "has a level below -1");
    for (const TurnedNumber& number : shared.turned)
        faults.outside("a turned number", number.value, -1e6, 1e6);
    look_at(shared.picture, faults);
    return faults.first;
}

} // namespace starbow
