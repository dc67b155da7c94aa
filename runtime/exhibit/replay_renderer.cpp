#include "replay_renderer.h"
#include "config/json/error.h"
#include "config/json/reader.h"

namespace starbow {

ReplayRenderer::ReplayRenderer(
    OffscreenRenderer& renderer, Pattern pattern, const Exposing& exposing, double start_ev, const Comfort& comfort)
    : renderer_(renderer)
    , layout_(renderer.layout())
    , alignment_(pattern)
    , exposing_(exposing)
    , start_ev_(start_ev)
    , comfort_(comfort)
{
    renderer_.frame().bloom(bloom_of(exposing, renderer_.on_processor()));
    renderer_.frame().show(pattern);
}

double ReplayRenderer::wanted_ev(double flights_ev) const
{
    return range_mode_.follower.shown ? flights_ev - start_ev_ : shown_ev(exposure_, exposing_, flights_ev, start_ev_);
}

void ReplayRenderer::take(const RecordEntry& entry, const Flight& flight)
{
    Controls controls = entry.controls;
    exposure_.locked ^= controls.lock_exposure;
    exposure_ = adapted_to(exposure_, entry.exposure_ev, exposing_, start_ev_);
    const bool had_curve = range_mode_.follower.shown.has_value();
    range_mode_ = entry.ranged
        ? advance(std::move(range_mode_), entry.range_goal, 1e-9 * double(entry.dt_ns), exposure_.locked)
        : RangeMode();
    if (had_curve != range_mode_.follower.shown.has_value())
        calm_ev_ = {};
    if (exposing_.calm && (exposure_.ev || !exposing_.automatic))
        calm_ev_ = calmed_ev(calm_ev_, wanted_ev(flight.exposure_ev), 1e-9 * double(entry.dt_ns));
    controls.save = false;
    Layout layout = layout_;
    if (alignment_.apply(controls, layout)) {
        try {
            renderer_.frame().adopt(layout);
            layout_ = std::move(layout);
        } catch (const InputError& error) { // the exhibit undoes such a change too
            alignment_.say(one_line(error.what()));
        }
    }
    renderer_.frame().show(alignment_.pattern());
    renderer_.frame().move_head(controls.head);
}

std::vector<std::vector<std::uint8_t>> ReplayRenderer::picture(
    const Flight& flight, const std::string& scene, const Panel* hud)
{
    renderer_.frame().vignette(comfort_.vignette.value_or(Vignette()), flight.vignette);
    Shot shot = shot_of(flight, scene, comfort_);
    shot.exposure_ev = calm_ev_.value.value_or(wanted_ev(shot.exposure_ev));
    renderer_.frame().range(range_mode_.follower.shown);
    return renderer_.picture(shot, hud);
}

} // namespace starbow
