#include "avenue.h"
#include "config/model/layout.h"
#include "config/model/shipped.h"
#include "runtime/world/detail.h"
#include <cmath>

namespace starbow {
namespace {

GpuWorld without_stars(RenderContext& context)
{
    World world = load_world(context.world.scene);
    add_detail_levels(world);
    return upload(context.device, context.pipelines, std::move(world), context.world.scene, {}, context.world.spectra.level);
}

} // namespace

Avenue::Avenue()
    : context(shipped_file("scenes", "avenue"), device_options(false))
    , starless(without_stars(context))
{
}

Layout window_of(glm::ivec2 size)
{
    Layout layout = load_layout(shipped_file("layouts", "desk"));
    layout.outputs[0].size = size;
    return layout;
}

Shot along_avenue(const Shot& start, double gamma)
{
    Shot shot = start;
    if (gamma > 1) {
        shot.position.z = -8;
        shot.u = {0, 0, -std::sqrt((gamma - 1) * (gamma + 1))};
    }
    shot.exposure_ev = gamma > 1 ? -3 : 0;
    return shot;
}

} // namespace starbow
