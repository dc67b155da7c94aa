#include "placards.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "runtime/operation/log.h"
#include "runtime/world/surroundings.h"
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

/// Signs are for visitors and guides in free flight: a tour says itself what is to be seen.
bool wants_signs(const Session& session)
{
    return session.information != Information::laboratory && session.flight.hud && !session.menu.open
        && in_hand(session.visit) && visitor_flies(session);
}

/// Half the extent of a panel on the plane z = 1.
glm::dvec2 half_of(const Panel& panel, double degree_px)
{
    return 0.5 * glm::dvec2(panel.size) * (std::tan(degree) / degree_px);
}

} // namespace

void Placards::forget()
{
    things_.reset(), sign_.reset();
    no_room_ = false;
}

void Placards::prepare(
    const Session& session, const Shot& shot, const GpuWorld& world, FrameRenderer& frame, const Typesetter& typesetter)
{
    const ViewSet& views = frame.views();
    const double degree_px = views.hud_width() * std::tan(degree) / (2 * views.hud_place.half.x);
    placards_.clear();
    if (wants_signs(session))
        add_sign(session, shot, world, views, degree_px, typesetter);
    else
        sign_.reset();
    if (session.beside == Beside::none)
        no_room_ = false;
    if (session.beside == Beside::none || session.alignment.pattern() != Pattern::none)
        frame.drop_inset();
    else if (!no_room_)
        add_inset(session, shot, frame, degree_px, typesetter);
    frame.place(placards_);
}

/// The boxes of the world's things. The rules of a flight with a pace hold them; without one they are read at their first
/// use.
std::span<const AlignedBox> Placards::things_in(const Session& session, const GpuWorld& world)
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

void Placards::add_sign(const Session& session, const Shot& shot, const GpuWorld& world, const ViewSet& views,
    double degree_px, const Typesetter& typesetter)
{
    sign_ = sign_for(shot, things_in(session, world), world.world, world.scene.seconds_per_time_unit(), sign_);
    if (!sign_)
        return;
    std::vector<std::string> lines = lines_of(*sign_, session.words);
    if (lines != sign_lines_ || sign_panel_.size.x == 0) {
        sign_lines_ = std::move(lines);
        sign_panel_ = draw_sign(typesetter, sign_lines_, degree_px);
    }
    placards_.push_back(
        {.letters = &sign_panel_, .place = views.place_above(sign_->towards, half_of(sign_panel_, degree_px))});
}

void Placards::add_inset(
    const Session& session, const Shot& shot, FrameRenderer& frame, double degree_px, const Typesetter& typesetter)
{
    const ViewSet& views = frame.views();
    const double half_x = 0.42 * views.hud_place.half.x;
    const glm::dvec2 half(half_x, half_x * Inset::aspect);
    try {
        const int width = std::clamp(int(2 * half.x / std::tan(degree) * degree_px), 64, 1024);
        telescope_deg_ = session.beside == Beside::telescope ? telescope_fov_deg(glm::length(shot.u), telescope_deg_) : 0;
        frame.show_inset(beside(shot, session.beside, session.programme.start.exposure_ev), width,
            telescope_deg_ > 0 ? telescope_deg_ : beside_fov_deg);
    } catch (const InputError& error) {
        no_room_ = true;
        write_log(LogKind::inset_no_room, one_line(error.what()) + "; the small picture is left out");
        return;
    }
    std::string name;
    if (telescope_deg_ > 0) {
        char angle[32]; // 30, 1.5, 0.06
        std::snprintf(angle, sizeof angle, "%g", telescope_deg_);
        name = session.words("beside.telescope_angle", {{"angle", session.words.number(angle)}});
    } else {
        name = session.words(std::string("beside.") + name_of(session.beside));
    }
    if (name != name_ || name_panel_.size.x == 0) {
        name_ = name;
        name_panel_ = draw_name(typesetter, name_, degree_px);
    }
    const glm::dvec2 name_half = half_of(name_panel_, degree_px);
    placards_.push_back({.picture = &frame.inset_picture(), .place = views.place_beside_hud(half, 0)});
    placards_.push_back({.letters = &name_panel_, .place = views.place_beside_hud(name_half, 2 * half.y)});
}

} // namespace starbow
