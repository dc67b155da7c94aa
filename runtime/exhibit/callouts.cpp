#include "callouts.h"
#include "config/json/error.h"
#include "config/model/named_words.h"
#include "runtime/world/surroundings.h"
#include <cstdio>

namespace starbow {
namespace {

/// Signs are for visitors and guides in free flight: a tour says itself what is to be seen.
bool wants_signs(const Session& session)
{
    return session.choices.information != Information::laboratory && session.flight().hud && !session.menu.open
        && session.attendance.in_hand() && session.source->by_hand();
}

/// The distance between two eyes whose baseline does not turn with the look, scene units; 0 where a layout has none.
double eyes_apart(const Layout& layout, const SceneFile& scene)
{
    const Stereo& stereo = layout.stereo;
    if (!has_two_eyes(layout) || stereo.turning || stereo.method == StereoMethod::shared)
        return 0;
    return stereo.separation_m * stereo.units_per_m(scene.unit_m, scene.light_speed_m_s);
}

} // namespace

void Callouts::choose(const Session& session, const GpuWorld& world, PictureState& now)
{
    if (wants_signs(session))
        sign_ = sign_for(now.shot, things_in(session, world), world.world, world.scene.seconds_per_time_unit(),
            eyes_apart(session.layout, world.scene), sign_);
    else
        sign_.reset();
    if (sign_)
        now.sign = {lines_of(*sign_, session.words), sign_->towards};
    if (const TourPlayer* tour = session.tour(); tour && session.flight().hud && !session.menu.open)
        show_step(*tour, world, now);
    if (session.choices.sky_names)
        name_sky(world, session.choices.language, now);
    if (session.choices.inset != InsetView::none)
        now.inset = inset_picture(
            session.choices.inset, now.shot, session.content.start.exposure_ev, telescope_deg_, session.words);
}

void Callouts::show_step(const TourPlayer& tour, const GpuWorld& world, PictureState& now)
{
    now.title = tour.title();
    if (!tour.over())
        now.highlights
            = shown_highlights(tour.steps()[tour.step()].highlights, now.shot, world.world, world.scene, enlarged_deg_);
}

void name_sky(const GpuWorld& world, const std::string& language, PictureState& now)
{
    now.figures = figures_fit(now.shot, world.scene);
    now.sky_labels = sky_labels(world.sky_names, now.shot, world.world, world.scene, language);
}

/// The boxes of the world's things. The rules of a flight with a pace hold them; without one they are read at their first
/// use.
std::span<const AlignedBox> Callouts::things_in(const Session& session, const GpuWorld& world)
{
    if (session.rules.pace)
        return session.rules.pace->things;
    if (!things_) {
        try {
            things_ = things_at_rest(world.scene);
        } catch (const InputError&) { // the file has changed since the world was read
            things_.emplace();
        }
    }
    return *things_;
}

InsetPicture inset_picture(InsetView kind, const Shot& shot, double start_ev, double& telescope_deg, const Words& words)
{
    telescope_deg = kind == InsetView::telescope ? telescope_fov_deg(glm::length(shot.u), telescope_deg) : 0;
    InsetPicture made{.kind = kind, .start_ev = start_ev};
    if (telescope_deg > 0) {
        made.fov_deg = telescope_deg;
        char angle[32]; // 30, 1.5, 0.06
        std::snprintf(angle, sizeof angle, "%g", telescope_deg);
        made.name = words("inset.telescope_angle", {{"angle", words.number(angle)}});
    } else {
        made.name = words(inset_view_words[std::size_t(kind)]);
    }
    return made;
}

} // namespace starbow
