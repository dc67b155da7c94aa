#include "handle.h"
#include "displays/projections/views.h"

namespace starbow {

std::optional<glm::dvec3> handle_direction(const Layout& layout, const Adjustable& number)
{
    const Adjustable::Spot& spot = number.spots[0];
    if (!number.unmoved || layout.outputs[spot.output].viewports[spot.viewport].warp)
        return {};
    for (const View& view : views_of(layout, spot.output, layout.outputs[spot.output].size))
        if (view.viewport == spot.viewport)
            return direction(view.picture, *number.unmoved * glm::dvec2(view.picture.size));
    return {};
}

} // namespace starbow
