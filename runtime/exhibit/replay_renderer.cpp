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
    renderer_.frame().bloom(exposing.bloom);
    renderer_.frame().show(pattern);
}

void ReplayRenderer::take(const RecordEntry& entry, const Flight& flight)
{
    Controls controls = entry.controls;
    exposure_.locked ^= controls.lock_exposure;
    exposure_ = adapted_to(exposure_, entry.exposure_ev, exposing_, start_ev_);
    if (exposing_.calm && (exposure_.ev || !exposing_.automatic))
        calm_ev_
            = calmed_ev(calm_ev_, shown_ev(exposure_, exposing_, flight.exposure_ev, start_ev_), 1e-9 * double(entry.dt_ns));
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
    shot.exposure_ev = calm_ev_.value.value_or(shown_ev(exposure_, exposing_, shot.exposure_ev, start_ev_));
    return renderer_.picture(shot, hud);
}

} // namespace starbow
