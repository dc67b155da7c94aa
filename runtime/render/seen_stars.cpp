#include "seen_stars.h"
#include "debug.h"
#include "shaders/shared_structs.h"
#include <algorithm>

namespace starbow {
namespace {

/// A star's change of direction that does not show, radians: 0.02 seconds of arc.
constexpr double least_change = 1e-7;

} // namespace

SeenStars::SeenStars(Device& device, const GpuWorld& world)
    : field_(world.stars)
    , globes_(world.globes.get())
{
    if (!on())
        return;
    entries_ = make_mapped_buffer(
        device, (field_.stars.size() + globes().count) * sizeof(shared::StarEntry), vk::BufferUsageFlagBits::eStorageBuffer);
    name_object(device, entries_, "seen stars: entries");
}

void SeenStars::follow(const EyeEvent& event, bool exactly)
{
    if (!on())
        return;
    // The stars' places are those from the Sun.
    const glm::dvec3 eye = event.place + (globes_ ? globes_->from_sun(event.time) : glm::dvec3(0));
    if (globes_) {
        seen_globes_.resize(globes().count);
        globes_->as_stars(globes_->seen(event), seen_globes_);
        copy_to(entries_, std::as_bytes(std::span(seen_globes_)), field_.stars.size() * sizeof(shared::StarEntry));
    }
    const double reach = exactly ? 0 : least_change * std::max(nearest_, field_.least_distance);
    if (eye_ && glm::distance(eye, *eye_) <= reach)
        return;
    eye_ = eye;
    stars_.resize(field_.stars.size());
    nearest_ = stars_from(field_, eye, stars_);
    copy_to(entries_, std::as_bytes(std::span(stars_)));
    patches_ = star_patches(stars_, std::move(patches_));
}

} // namespace starbow
