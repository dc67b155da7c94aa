#include "replay_renderer.h"
#include "config/json/error.h"
#include "config/json/reader.h"

namespace starbow {

Reel::Reel(Studio& studio, Pattern pattern, const Exposing& exposing, double start_ev)
    : studio_(studio)
    , layout_(studio.layout())
    , workbench_(pattern)
    , exposing_(exposing)
    , start_ev_(start_ev)
{
    studio_.frame().bloom(exposing.bloom);
    studio_.frame().show(pattern);
}

void Reel::take(const RecordEntry& entry)
{
    Controls controls = entry.controls;
    exposure_.locked ^= controls.lock_exposure;
    exposure_.ev = entry.exposure_ev;
    controls.save = false;
    Layout layout = layout_;
    if (workbench_.apply(controls, layout)) {
        try {
            studio_.frame().adopt(layout);
            layout_ = std::move(layout);
        } catch (const InputError& error) { // as in the exhibit, where it is turned back
            workbench_.say(one_line(error.what()));
        }
    }
    studio_.frame().show(workbench_.pattern());
    studio_.frame().move_head(controls.head);
}

std::vector<std::vector<std::uint8_t>> Reel::picture(const Flight& flight, const std::string& scene, const Panel* hud)
{
    Shot shot = shot_of(flight, scene);
    shot.exposure_ev = shown_ev(exposure_, exposing_, shot.exposure_ev, start_ev_);
    return studio_.picture(shot, hud);
}

} // namespace starbow
