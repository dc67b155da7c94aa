#include "reel.h"
#include "config/error.h"
#include "config/reader.h"

namespace starbow {

Reel::Reel(Studio& studio, Pattern pattern)
    : studio_(studio)
    , layout_(studio.layout())
    , workbench_(pattern)
{
    studio_.frame().show(pattern);
}

void Reel::take(Controls controls)
{
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
    return studio_.picture(shot_of(flight, scene), hud);
}

} // namespace starbow
