#include "replay_renderer.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "placards.h"
#include <utility>

namespace starbow {

ReplayRenderer::ReplayRenderer(OffscreenRenderer& renderer, Pattern pattern, const Exposing& exposing, double start_ev,
    Words words, const Comfort& comfort)
    : renderer_(renderer)
    , layout_(renderer.layout())
    , alignment_(pattern)
    , exposing_(exposing)
    , start_ev_(start_ev)
    , words_(std::move(words))
    , comfort_(comfort)
{
    now_.bloom = bloom_of(exposing, renderer_.on_processor());
    now_.vignette = comfort.vignette.value_or(Vignette());
}

double ReplayRenderer::wanted_ev(double flights_ev) const
{
    return range_mode_.follower.shown ? flights_ev - start_ev_ : shown_ev(exposure_, exposing_, flights_ev, start_ev_);
}

void ReplayRenderer::take(const RecordEntry& entry, const Flight& flight)
{
    Controls controls = entry.controls;
    if (std::exchange(begun_, flight.leaps.begun) != flight.leaps.begun)
        exposure_ = {}, calm_ev_ = {}, range_mode_.follows_at_once = true;
    exposure_.locked ^= controls[Switch::lock_exposure];
    exposure_ = adapted_to(exposure_, entry.exposure_ev, exposing_, start_ev_);
    const bool had_curve = range_mode_.follower.shown.has_value();
    range_mode_ = entry.ranged
        ? advance(std::move(range_mode_), entry.range_goal, 1e-9 * double(entry.dt_ns), exposure_.locked)
        : RangeMode();
    if (had_curve != range_mode_.follower.shown.has_value())
        calm_ev_ = {};
    if (exposing_.calm && (exposure_.ev || !exposing_.automatic))
        calm_ev_ = calmed_ev(calm_ev_, wanted_ev(flight.exposure_ev), 1e-9 * double(entry.dt_ns));
    controls.set(Switch::save, false);
    Layout layout = layout_;
    if (alignment_.apply(controls, layout)) {
        try {
            renderer_.frame().adopt(layout);
            layout_ = std::move(layout);
        } catch (const InputError& error) { // the exhibit undoes such a change too
            alignment_.say(one_line(error.what()));
        }
    }
    if (controls[Switch::beside])
        beside_ = after(beside_);
    now_.head = controls.head;
    now_.black = 1 - entry.light;
}

std::vector<std::vector<std::uint8_t>> ReplayRenderer::picture(
    const Flight& flight, const std::string& scene, const Panel* hud)
{
    now_.shot = shot_of(flight, scene, comfort_);
    now_.shot.exposure_ev = calm_ev_.value.value_or(wanted_ev(now_.shot.exposure_ev));
    now_.range = range_mode_.follower.shown;
    now_.vignette_part = flight.vignette;
    now_.pattern = alignment_.pattern();
    now_.small_picture.reset();
    if (beside_ != Beside::none)
        now_.small_picture = small_picture(beside_, now_.shot, start_ev_, telescope_deg_, words_);
    pictures_.set_up(now_, words_, renderer_.frame());
    return renderer_.picture(now_.shot, hud);
}

} // namespace starbow
