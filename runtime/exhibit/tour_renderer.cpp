#include "tour_renderer.h"

namespace starbow {

void TourRenderer::follow_range(Shot& shot)
{
    FrameRenderer& frame = renderer_.frame();
    std::vector<double> goal;
    if (!range_mode_.wanted) {
        if (const std::optional<RangeCurve> first = renderer_.ranged(shot)) // nothing was drawn before
            range_mode_.wanted = first, range_mode_.follower = {first, first};
    } else if (wants_goal(range_mode_, range_frame_s_)) {
        goal = range_goal(frame.surface_samples(), frame.star_samples(), shot.exposure_ev);
    }
    range_mode_ = advance(std::move(range_mode_), goal, range_frame_s_, false);
    if (range_mode_.follower.shown)
        shot.exposure_ev = 0;
}

std::vector<std::vector<std::uint8_t>> TourRenderer::picture(const Touring& touring)
{
    Readings shown = readings(touring.flight.ship, world_.scene, touring.flight.effects);
    shown.exposure_ev = touring.flight.exposure_ev;
    shown.caption = caption_of(touring, show_, words_, {});
    PictureState now{.shot = shot_of(touring.flight, show_.tour.scene), .bloom = bloom_};
    if (range_frame_s_ > 0) {
        follow_range(now.shot);
        now.meters = true;
        now.range = range_mode_.follower.shown;
        if (now.range)
            shown.range = Readings::Range{now.range->stops(), now.range->shown_stops()};
    }
    now.title = title_of(touring, show_);
    if (!touring.over)
        now.highlights = shown_highlights(
            show_.tour.steps[touring.step()].highlights, now.shot, world_.world, world_.scene, enlarged_deg_);
    FrameRenderer& frame = renderer_.frame();
    pictures_.set_up(now, words_, frame);
    const Panel panel = pictures_.typesetter.draw(shown, words_, frame.views().hud_width());
    return renderer_.picture(now.shot, shown.caption->text.empty() ? nullptr : &panel);
}

} // namespace starbow
