#include "replay_renderer.h"
#include "callouts.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include <utility>

namespace starbow {
namespace {

/// A frame's flight, as the record has flown it.
class FlownFlight : public FlightSource {
public:
    FlownFlight(const Flight& flight, double start_ev)
        : flight_(flight)
        , start_ev_(start_ev)
    {
    }
    const Flight& flight() const override { return flight_; }
    const Flight& advance(const Controls&, std::int64_t) override { return flight_; }
    double begun_ev() const override { return start_ev_; }
    Flight* switched() override { return nullptr; }

private:
    const Flight& flight_;
    double start_ev_;
};

} // namespace

ReplayRenderer::ReplayRenderer(OffscreenRenderer& renderer, Pattern pattern, const Exposing& exposing, double start_ev,
    Words words, const Comfort& comfort)
    : renderer_(renderer)
    , kept_(renderer.layout())
    , layout_(kept_)
    , alignment_(pattern)
    , light_(exposing)
    , start_ev_(start_ev)
    , words_(std::move(words))
    , comfort_(comfort)
{
    now_.bloom = bloom_of(exposing, renderer_.on_processor());
    now_.vignette = comfort.vignette.value_or(Vignette());
}

/// A builder's move by a tablet. A replay writes no layout, and one on another layout has other grips.
void ReplayRenderer::queue_move(const Command& command)
{
    try {
        if (command.kind != CommandKind::keep)
            alignment_.queue(command, layout_);
    } catch (const InputError& error) {
        alignment_.say(one_line(error.what()));
    }
}

void ReplayRenderer::take(const RecordEntry& entry, const Flight& flight)
{
    RecordEntry now = entry;
    apply(choices_, entry.controls);
    for (const Command& command : entry.commands)
        if (switches_choice(command.kind))
            apply(choices_, command);
        else if (aligns(command.kind))
            queue_move(command);
    light_.advance(now,
        {.source = FlownFlight(flight, start_ev_),
            .range = entry.ranged,
            .filter = choices_.filter,
            .locks = entry.controls[Switch::lock_exposure],
            .replays = true,
            .dt_s = 1e-9 * double(entry.dt_ns)});
    Controls& controls = now.controls;
    controls.set(Switch::save, false);
    Layout layout = layout_;
    if (alignment_.apply(controls, layout, kept_)) {
        try {
            renderer_.frame().adopt(layout);
            layout_ = std::move(layout);
        } catch (const InputError& error) { // the exhibit undoes such a change too
            alignment_.refuse(one_line(error.what()));
        }
    }
    now_.head = controls.head;
    now_.fade = light_.fade();
}

std::vector<std::vector<std::uint8_t>> ReplayRenderer::picture(
    const Flight& flight, const std::string& scene, const Panel* hud)
{
    now_.shot = shot_of(flight, scene, comfort_);
    now_.shot.exposure_ev = light_.ev();
    now_.range = light_.curve();
    now_.vignette_part = flight.vignette;
    now_.pattern = alignment_.pattern();
    now_.inset.reset();
    if (choices_.inset != InsetView::none)
        now_.inset = inset_picture(choices_.inset, now_.shot, start_ev_, telescope_deg_, words_);
    pictures_.set_up(now_, words_, renderer_.frame());
    return renderer_.picture(now_.shot, hud);
}

} // namespace starbow
