#include "cone_hierarchy.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

/// The angle between unit vectors, accurate for small angles and for opposite directions, unlike an arc cosine in float.
float angle(const glm::vec3& a, const glm::vec3& b)
{
    if (glm::dot(a, b) < 0)
        return 3.14159265f - 2 * std::asin(std::min(1.0f, 0.5f * glm::length(a + b)));
    return 2 * std::asin(std::min(1.0f, 0.5f * glm::distance(a, b)));
}

/// An upper bound of float rounding.
constexpr float slack = 1e-6f;

BoundingCone around(const BoundingCone* const* parts, int count)
{
    glm::vec3 sum(0);
    for (int i = 0; i < count; ++i)
        sum += parts[i]->centre;
    // Opposite directions may cancel. Any centre serves for a cone that is nearly the sphere.
    BoundingCone cap = *parts[0];
    cap.centre = glm::length(sum) > 1e-3f ? glm::normalize(sum) : parts[0]->centre;
    cap.radius = 0;
    for (int i = 0; i < count; ++i) {
        cap.radius = std::max(cap.radius, angle(cap.centre, parts[i]->centre) + parts[i]->radius + slack);
        cap.finest = std::min(cap.finest, parts[i]->finest);
        cap.coarsest = std::max(cap.coarsest, parts[i]->coarsest);
    }
    return cap;
}

BoundingCone leaf_cap(const DirectionMap& map, glm::ivec2 low, glm::ivec2 high)
{
    glm::vec3 sum(0), any(0);
    for (int channel = 0; channel < map.channels; ++channel)
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
                if (const glm::vec4& texel = map.at(x, y, channel); texel.w > 0)
                    sum += glm::vec3(texel), any = glm::vec3(texel);
    BoundingCone cap;
    if (any == glm::vec3(0))
        return cap;
    cap.centre = glm::length(sum) > 1e-3f ? glm::normalize(sum) : any;
    cap.finest = 1e30f;
    for (int channel = 0; channel < map.channels; ++channel)
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
                if (const glm::vec4& texel = map.at(x, y, channel); texel.w > 0) {
                    cap.radius = std::max(cap.radius, angle(cap.centre, glm::vec3(texel)) + slack);
                    cap.finest = std::min(cap.finest, texel.w);
                    cap.coarsest = std::max(cap.coarsest, texel.w);
                }
    return cap;
}

int levels_for(glm::ivec2 size, int leaf)
{
    int levels = 1;
    while ((leaf << (levels - 1)) < std::max(size.x, size.y))
        ++levels;
    return levels;
}

} // namespace

ConeHierarchy::ConeHierarchy(const DirectionMap& map)
    : size_(map.size)
    , leaf_(8)
    , levels_(levels_for(map.size, 8))
{
    cones_.resize(levels_);
    for (int level = levels_ - 1; level >= 0; --level) {
        const glm::ivec2 cones = count(level);
        cones_[level].resize(std::size_t(cones.x) * cones.y);
        for (int y = 0; y < cones.y; ++y)
            for (int x = 0; x < cones.x; ++x) {
                BoundingCone& cap = cones_[level][std::size_t(y) * cones.x + x];
                if (level == levels_ - 1) {
                    cap = leaf_cap(map, {x * leaf_, y * leaf_}, glm::min(glm::ivec2(x + 1, y + 1) * leaf_, size_));
                    continue;
                }
                const glm::ivec2 finer = count(level + 1);
                const BoundingCone* parts[4];
                int found = 0;
                for (int j = 2 * y; j < std::min(2 * y + 2, finer.y); ++j)
                    for (int i = 2 * x; i < std::min(2 * x + 2, finer.x); ++i)
                        if (const BoundingCone& part = cones_[level + 1][std::size_t(j) * finer.x + i]; !part.empty())
                            parts[found++] = &part;
                if (found > 0)
                    cap = around(parts, found);
            }
    }
}

ConeHierarchy::ConeHierarchy(const glm::dmat3& direction_from_pixel, glm::ivec2 size)
    : size_(size)
    , leaf_(1)
    , levels_(levels_for(size, 1))
    , flat_(direction_from_pixel)
{
    const glm::dmat3& m = direction_from_pixel;
    unit_ = std::sqrt(std::abs(glm::determinant(m)));
    const double xx = glm::dot(m[0], m[0]), yy = glm::dot(m[1], m[1]), xy = glm::dot(m[0], m[1]);
    const glm::dvec2 towards = -glm::dvec2(glm::dot(m[0], m[2]), glm::dot(m[1], m[2]));
    foot_ = towards / glm::dvec2(xx, yy);
    if (std::abs(xy) > 1e-12 * std::sqrt(xx * yy)) {
        skew_ = {xx, xy, yy};
        foot_ = glm::dvec2(yy * towards.x - xy * towards.y, xx * towards.y - xy * towards.x) / (xx * yy - xy * xy);
    }
    constexpr int least_kept = 8; // pixels
    for (int level = 0; level < levels_ && side(level) >= least_kept; ++level) {
        const glm::ivec2 cones = count(level);
        std::vector<BoundingCone>& kept = cones_.emplace_back();
        kept.reserve(std::size_t(cones.x) * cones.y);
        for (int y = 0; y < cones.y; ++y)
            for (int x = 0; x < cones.x; ++x)
                kept.push_back(flat_cone(level, {x, y}));
    }
}

/// The point of a rectangle of pixels that is nearest to the eye. The square of the distance grows from the perpendicular's
/// foot as a quadratic form; where the axes are askew, its least value on the rectangle may lie anywhere on the edges.
glm::dvec2 ConeHierarchy::nearest_point(glm::dvec2 first, glm::dvec2 last) const
{
    const glm::dvec2 inside = glm::clamp(foot_, first, last);
    if (!skew_ || inside == foot_)
        return inside;
    const auto [xx, xy, yy] = *skew_;
    glm::dvec2 best = inside;
    double least = std::numeric_limits<double>::infinity();
    const auto try_point = [&](const glm::dvec2& p) {
        const glm::dvec2 off = p - foot_;
        if (const double square = xx * off.x * off.x + 2 * xy * off.x * off.y + yy * off.y * off.y; square < least)
            least = square, best = p;
    };
    for (const double x : {first.x, last.x})
        try_point({x, std::clamp(foot_.y - xy / yy * (x - foot_.x), first.y, last.y)});
    for (const double y : {first.y, last.y})
        try_point({std::clamp(foot_.x - xy / xx * (y - foot_.y), first.x, last.x), y});
    return best;
}

BoundingCone ConeHierarchy::flat_cone(int level, glm::ivec2 block) const
{
    const glm::ivec2 low = block * side(level), high = glm::min(low + side(level), size_);
    const glm::dvec2 first = glm::dvec2(low) + 0.5, last = glm::dvec2(high) - 0.5;
    auto at = [&](const glm::dvec2& p) { return *flat_ * glm::dvec3(p, 1); };
    const glm::dvec3 corners[4] = {at(first), at({last.x, first.y}), at({first.x, last.y}), at(last)};
    BoundingCone cap;
    // A cone of less than half a sphere is convex: if it contains the corners, it contains the rectangle.
    cap.centre = glm::normalize(at(0.5 * (first + last)));
    double farthest = 0, chord_square = 0;
    const glm::dvec3 centre(cap.centre);
    for (const glm::dvec3& corner : corners) {
        const double length = glm::length(corner);
        const glm::dvec3 off = corner / length - centre;
        chord_square = std::max(chord_square, glm::dot(off, off));
        farthest = std::max(farthest, length);
    }
    cap.radius = float(2 * std::asin(std::min(1.0, 0.5 * std::sqrt(chord_square)))) + slack;
    // The solid angle of a pixel is det M / length^3.
    const double nearest = glm::length(at(nearest_point(first, last)));
    cap.finest = float(unit_ / (farthest * std::sqrt(farthest)));
    cap.coarsest = float(unit_ / (nearest * std::sqrt(nearest)));
    return cap;
}

BoundingCone ConeHierarchy::cone(int level, glm::ivec2 block) const
{
    if (std::size_t(level) < cones_.size())
        return cones_[std::size_t(level)][std::size_t(block.y) * count(level).x + block.x];
    return flat_cone(level, block);
}

namespace {

/// Searches a block for the pixel nearest to a direction.
struct Search {
    const DirectionMap& map;
    const ConeHierarchy& cones;
    glm::vec3 wanted;
    glm::ivec2 best{-1};
    float nearest = 1e30f;

    void block(int level, glm::ivec2 at)
    {
        const BoundingCone cap = cones.cone(level, at);
        if (cap.empty() || angle(cap.centre, wanted) > cap.radius + std::min(nearest, 2 * cap.coarsest) + slack)
            return;
        const glm::ivec2 low = at * cones.side(level), high = glm::min(low + cones.side(level), map.size);
        if (level + 1 == cones.levels()) {
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x)
                    if (const glm::vec4& texel = map.at(x, y); texel.w > 0)
                        if (float off = glm::distance(glm::vec3(texel), wanted); off < nearest)
                            nearest = off, best = {x, y};
            return;
        }
        const glm::ivec2 finer = cones.count(level + 1);
        for (int j = 2 * at.y; j < std::min(2 * at.y + 2, finer.y); ++j)
            for (int i = 2 * at.x; i < std::min(2 * at.x + 2, finer.x); ++i)
                block(level + 1, {i, j});
    }
};

} // namespace

std::optional<glm::dvec2> find_pixel(const DirectionMap& map, const ConeHierarchy& cones, const glm::dvec3& direction)
{
    Search search{map, cones, direction};
    search.block(0, {0, 0});
    if (search.best.x < 0)
        return {};
    // The search continues from there along the picture's own steps, one-sided where a neighbour shows nothing.
    const glm::ivec2 p = search.best;
    const glm::dvec3 here = map.at(p.x, p.y);
    auto step = [&](glm::ivec2 way) {
        glm::dvec3 sum(0);
        for (int sign : {-1, 1}) {
            const glm::ivec2 q = p + sign * way;
            if (q.x >= 0 && q.y >= 0 && q.x < map.size.x && q.y < map.size.y && map.at(q.x, q.y).w > 0)
                sum = sum == glm::dvec3(0) ? double(sign) * (glm::dvec3(map.at(q.x, q.y)) - here)
                                           : 0.5 * (sum + double(sign) * (glm::dvec3(map.at(q.x, q.y)) - here));
        }
        return sum;
    };
    const glm::dvec3 x = step({1, 0}), y = step({0, 1}), off = direction - here;
    const double xx = glm::dot(x, x), yy = glm::dot(y, y), xy = glm::dot(x, y), det = xx * yy - xy * xy;
    if (!(det > 1e-6 * xx * yy))
        return {};
    const glm::dvec2 move(
        (glm::dot(off, x) * yy - glm::dot(off, y) * xy) / det, (glm::dot(off, y) * xx - glm::dot(off, x) * xy) / det);
    if (!(std::max(std::abs(move.x), std::abs(move.y)) < 0.75))
        return {};
    return glm::dvec2(p) + 0.5 + move;
}

namespace {

struct Pyramid {
    const ConeHierarchy& cones;
    std::span<const glm::dvec3> sides;
    PixelBox box{glm::ivec2(1 << 30), glm::ivec2(0), 1};

    bool sees(const BoundingCone& cap) const
    {
        const double reach = cap.radius < 1.57f ? std::sin(double(cap.radius)) + slack : 1;
        return std::all_of(sides.begin(), sides.end(),
            [&](const glm::dvec3& side) { return glm::dot(side, glm::dvec3(cap.centre)) >= -reach; });
    }
    void add(int level, glm::ivec2 at)
    {
        const BoundingCone cap = cones.cone(level, at);
        if (cap.empty() || !sees(cap))
            return;
        const int side = cones.side(level);
        if (level + 1 < cones.levels() && side > 8) {
            const glm::ivec2 finer = cones.count(level + 1);
            for (int j = 2 * at.y; j < std::min(2 * at.y + 2, finer.y); ++j)
                for (int i = 2 * at.x; i < std::min(2 * at.x + 2, finer.x); ++i)
                    add(level + 1, {i, j});
            return;
        }
        box.low = glm::min(box.low, at * side);
        box.high = glm::max(box.high, glm::min((at + 1) * side, cones.size()));
        box.finest = std::min(box.finest, double(cap.finest));
    }
};

} // namespace

PixelBox pixels_in_pyramid(const ConeHierarchy& cones, std::span<const glm::dvec3> sides)
{
    Pyramid pyramid{cones, sides};
    pyramid.add(0, {0, 0});
    return pyramid.box.high.x > 0 ? pyramid.box : PixelBox{};
}

} // namespace starbow
