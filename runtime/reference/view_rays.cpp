#include "view_rays.h"
#include "config/model/turn.h"
#include <cmath>
#include <cstdint>

namespace starbow {
namespace {

constexpr int columns = 16; ///< of samples on a pixel of a warped view

/// The base 2 digits of i mirrored at the point (van der Corput).
double mirrored(std::uint32_t i)
{
    double value = 0, digit = 0.5;
    for (; i > 0; i >>= 1, digit *= 0.5)
        value += (i & 1) * digit;
    return value;
}

Picture source_of(const CompiledView& view)
{
    return view.mesh ? warped_picture(view.view, *view.mesh, view.view.projection_given) : view.view.picture;
}

glm::dmat3 turn_of(const Projection& projection)
{
    if (auto* planar = std::get_if<Planar>(&projection))
        return cockpit_from_picture(planar->turn);
    if (auto* lens = std::get_if<Lens>(&projection))
        return cockpit_from_picture(lens->turn);
    return glm::dmat3(1);
}

} // namespace

std::vector<glm::dvec2> sample_places(int count)
{
    std::vector<glm::dvec2> places;
    for (int i = 0; i < count; ++i)
        places.emplace_back(std::fmod(mirrored(std::uint32_t(i)) + 0.5 / count, 1.0), (i + 0.5) / count);
    return places;
}

ViewRays::ViewRays(const CompiledView& view, const std::vector<glm::dvec2>& samples)
    : view_(view)
    , places_(samples)
    , channels_(view.channels())
    , source_(source_of(view))
    , rays_(source_)
    , turn_(turn_of(source_.projection))
{
    if (!view.mesh)
        return;
    const glm::ivec2 size = view.view.size;
    centres_ = std::make_unique<WarpRaster>(*view.mesh, size);
    fine_ = std::make_unique<WarpRaster>(*view.mesh, glm::ivec2(size.x * columns, size.y * int(samples.size())));
}

std::optional<glm::dvec3> ViewRays::warped(const WarpSample& sample, int channel) const
{
    return warped_direction(*view_.mesh, source_, rays_, turn_, sample, channel);
}

std::optional<glm::dvec3> ViewRays::direction(const glm::dvec2& pixel, int channel) const
{
    if (!view_.mesh)
        return rays_.direction(pixel * view_.view.picture_from_pixel, channels_ == 3 ? Channel(channel) : Channel::green);
    const DirectionMap& map = *view_.map;
    const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(pixel)), glm::ivec2(0), map.size - 1);
    const glm::dvec4 here = map.at(at.x, at.y, channel);
    if (here.w == 0)
        return {};
    glm::dvec3 way(here);
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec3 step(0);
        int count = 0;
        for (int sign : {-1, 1}) {
            glm::ivec2 beside = at;
            beside[axis] += sign;
            if (beside[axis] < 0 || beside[axis] >= map.size[axis])
                continue;
            const glm::dvec4 there = map.at(beside.x, beside.y, channel);
            if (there.w > 0)
                step += double(sign) * (glm::dvec3(there) - glm::dvec3(here)), ++count;
        }
        if (count > 0)
            way += step / double(count) * (pixel[axis] - at[axis] - 0.5);
    }
    return glm::normalize(way);
}

double ViewRays::pixel_rad(const glm::ivec2& at, int channel) const
{
    glm::dvec3 edges[2];
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec2 half(0), middle = glm::dvec2(at) + 0.5;
        half[axis] = 0.5;
        const auto before = direction(middle - half, channel), after = direction(middle + half, channel);
        if (!before || !after)
            return 0;
        edges[axis] = *after - *before;
    }
    const double longer = std::max(glm::length(edges[0]), glm::length(edges[1]));
    return std::max(std::sqrt(glm::length(glm::cross(edges[0], edges[1]))), 0.5 * longer);
}

ViewRays::Row ViewRays::row(int y) const
{
    Row row;
    row.rays = this;
    row.y = y;
    if (!view_.mesh)
        return row;
    const std::size_t width = std::size_t(view_.view.size.x), count = places_.size();
    row.centres_.resize(width);
    centres_->row(y, row.centres_);
    row.samples_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        row.samples_[i].resize(width * columns);
        fine_->row(y * int(count) + int(i), row.samples_[i]);
    }
    return row;
}

std::optional<glm::dvec3> ViewRays::Row::centre(int x, int channel) const
{
    return rays->view_.mesh ? rays->warped(centres_[std::size_t(x)], channel) : rays->direction({x + 0.5, y + 0.5}, channel);
}

std::optional<glm::dvec3> ViewRays::Row::sample(int x, std::size_t i, int channel) const
{
    const glm::dvec2& place = rays->places_[i];
    if (!rays->view_.mesh)
        return rays->direction(glm::dvec2(x, y) + place, channel);
    return rays->warped(samples_[i][std::size_t(x * columns + int(place.x * columns))], channel);
}

} // namespace starbow
