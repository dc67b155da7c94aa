#include "tour_player.h"
#include <algorithm>
#include <cmath>

namespace starbow {

constexpr double fade_s = 1.5, prompt_s = 12;

std::string announced(const Step& step)
{
    return filled(step.question ? step.question->ask : step.caption, {{"measured", "…"}});
}

const Flight& TourPlayer::advance(const Controls& controls, std::int64_t dt_ns)
{
    const std::uint32_t begun = touring_.flight.leaps.begun;
    touring_ = starbow::advance(std::move(touring_), show_, controls, dt_ns);
    if (touring_.flight.leaps.begun != begun)
        automatic_ = 0;
    const double dt_s = 1e-9 * double(dt_ns);
    automatic_ = std::clamp(automatic_ + (by_hand() ? dt_s : -dt_s) / fade_s, 0.0, 1.0);
    over_s_ = touring_.over ? over_s_ + dt_s : 0;
    return touring_.flight;
}

void TourPlayer::again()
{
    const Flight before = touring_.flight;
    touring_ = touring_at(show_);
    count_beginning(touring_.flight, before);
    automatic_ = over_s_ = 0;
}

Tour TourPlayer::staged(Tour tour) const
{
    tour = seen_on(std::move(tour), staging_.surrounds);
    return staging_.read_aloud ? paced_to_be_read(std::move(tour)) : tour;
}

void TourPlayer::reword(Tour tour)
{
    const double before_s = tour_.steps[touring_.step()].seconds;
    tour_ = staged(std::move(tour));
    const double longer = tour_.steps[touring_.step()].seconds / before_s;
    touring_.into_ns = std::llround(longer * double(touring_.into_ns));
    touring_.answered_ns = std::llround(longer * double(touring_.answered_ns));
}

double TourPlayer::shown_ev(const Exposure& adapted, const Exposing& rules) const
{
    const double tours = touring_.flight.exposure_ev, turned = std::clamp(tours + touring_.brighter_ev, -60.0, 60.0);
    return glm::mix(turned, starbow::shown_ev(adapted, rules, turned, tours), glm::smoothstep(0.0, 1.0, automatic_));
}

std::optional<Caption> TourPlayer::caption(const Words& words, const InputCapabilities& capabilities) const
{
    Caption caption = caption_of(touring_, show_, words, capabilities);
    if (caption.text.empty())
        return {};
    return caption;
}

std::string TourPlayer::prompt(const Words& words) const
{
    return touring_.over && over_s_ < prompt_s ? words("touring.over") : "";
}

} // namespace starbow
