#include "tour_renderer.h"

namespace starbow {

std::vector<std::vector<std::uint8_t>> TourRenderer::picture(const Touring& touring)
{
    Readings shown = readings(touring.flight.ship, scene_, touring.flight.effects);
    shown.exposure_ev = touring.flight.exposure_ev;
    shown.caption = caption_of(touring, show_, words_, {});
    const Panel panel = typesetter_.draw(shown, words_, renderer_.frame().views().hud_width());
    return renderer_.picture(shot_of(touring.flight, show_.tour.scene), shown.caption->text.empty() ? nullptr : &panel);
}

} // namespace starbow
