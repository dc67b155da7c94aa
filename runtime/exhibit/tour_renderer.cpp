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
    frame.meter(true);
    frame.range(range_mode_.follower.shown);
    if (range_mode_.follower.shown)
        shot.exposure_ev = 0;
}

std::vector<std::vector<std::uint8_t>> TourRenderer::picture(const Touring& touring)
{
    Readings shown = readings(touring.flight.ship, scene_, touring.flight.effects);
    shown.exposure_ev = touring.flight.exposure_ev;
    shown.caption = caption_of(touring, show_, words_, {});
    Shot shot = shot_of(touring.flight, show_.tour.scene);
    if (range_frame_s_ > 0) {
        follow_range(shot);
        if (const std::optional<RangeCurve>& curve = range_mode_.follower.shown)
            shown.range = Readings::Range{curve->stops(), curve->shown_stops()};
    }
    FrameRenderer& frame = renderer_.frame();
    callouts_.clear();
    if (const std::string title = title_of(touring, show_); !title.empty())
        callouts_.push_back(title_over(frame.views(), typesetter_, title, title_));
    frame.place(callouts_);
    const Panel panel = typesetter_.draw(shown, words_, frame.views().hud_width());
    return renderer_.picture(shot, shown.caption->text.empty() ? nullptr : &panel);
}

} // namespace starbow
