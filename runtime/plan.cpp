#include "plan.h"
#include "physics/physics.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace starbow {
namespace {

constexpr double pi = 3.14159265358979323846;

// Components of a direction along a face's a axis, b axis and normal.
constexpr int face_axis[6] = {2, 2, 0, 0, 1, 1};
constexpr int face_a[6] = {0, 0, 1, 1, 0, 0};
constexpr int face_b[6] = {1, 1, 2, 2, 2, 2};
constexpr double face_sign[6] = {1, -1, 1, -1, 1, -1};

constexpr double band_edges[SIDE_BANDS + 1] = {-1, -0.5, 0, 1};

struct Rect {
    glm::dvec2 low{1e300}, high{-1e300};
    void add(const Rect& r) { low = glm::min(low, r.low), high = glm::max(high, r.high); }
    bool empty() const { return low.x > high.x || low.y > high.y; }
};

/// The part of a face's plane that belongs to a slot.
Rect slot_rect(int slot)
{
    if (slot == SLOT_FRONT)
        return {{-1, -1}, {1, 1}};
    if (slot < SLOT_REAR) {
        int band = (slot - SLOT_SIDES) % SIDE_BANDS;
        return {{-1, band_edges[band]}, {1, band_edges[band + 1]}};
    }
    double half = std::exp2(-0.5 * (slot - SLOT_REAR));
    return {{-half, -half}, {half, half}};
}

int slot_face(int slot) { return slot == SLOT_FRONT ? 0 : slot >= SLOT_REAR ? 1 : 2 + (slot - SLOT_SIDES) / SIDE_BANDS; }

int rear_level(double larger, int rear_last)
{
    // floor(-log2(larger^2)), an exact power of two going to the coarser image: the shader reads it from the exponent's
    // bits.
    int exponent;
    std::frexp(larger * larger, &exponent); // = [0.5, 1) 2^exponent
    return larger > 0 ? std::clamp(-exponent, 0, rear_last) : rear_last;
}

/// A circle on the sphere and what its pixels need.
struct Disc {
    glm::dvec3 centre;
    double radius; // radians, up to pi
    double finest, coarsest; // one texel per pixel, radians
};

/// Range of tan(angle) of a disc seen along a face's normal and one of its axes, clamped to the face. False if it misses.
bool face_range(double along_axis, double along_normal, double radius, double& low, double& high)
{
    double distance = std::hypot(along_axis, along_normal);
    if (radius >= pi / 2 || std::sin(radius) >= distance) {
        low = -1, high = 1;
        return true;
    }
    double middle = std::atan2(along_axis, along_normal), half = std::asin(std::sin(radius) / distance);
    if (middle - half > pi / 4 || middle + half < -pi / 4)
        return false;
    low = middle - half <= -pi / 4 ? -1 : std::tan(middle - half);
    high = middle + half >= pi / 4 ? 1 : std::tan(middle + half);
    return true;
}

struct Demand {
    Rect rect;
    double finest = 1e300; // face units per texel that some pixel wants
    double coarsest = 0;
};
using Demands = std::array<Demand, SLOT_COUNT>;

/// Calls each(slot, the part of its face's plane) for the slots that a circle may touch. False parts may be empty.
template <class Each> void each_slot(const glm::dvec3& centre, double radius, int rear_last, Each&& each)
{
    for (int face = 0; face < 6; ++face) {
        double normal = centre[face_axis[face]] * face_sign[face];
        Rect wanted;
        if (!face_range(centre[face_a[face]], normal, radius, wanted.low.x, wanted.high.x)
            || !face_range(centre[face_b[face]], normal, radius, wanted.low.y, wanted.high.y))
            continue;
        auto part = [&](int slot) {
            const Rect own = slot_rect(slot);
            const Rect part{glm::max(own.low, wanted.low), glm::min(own.high, wanted.high)};
            if (!part.empty())
                each(slot, part);
        };
        if (face == 0) {
            part(SLOT_FRONT);
        } else if (face == 1) {
            // The nested squares from the one that holds the circle's outermost point to the one of its innermost.
            glm::dvec2 far = glm::max(glm::abs(wanted.low), glm::abs(wanted.high));
            glm::dvec2 near = glm::max(glm::max(wanted.low, -wanted.high), glm::dvec2(0));
            int outer = rear_level(std::max(far.x, far.y), rear_last),
                inner = rear_level(std::max(near.x, near.y), rear_last);
            for (int level = outer; level <= inner; ++level)
                part(SLOT_REAR + level);
        } else {
            for (int band = 0; band < SIDE_BANDS; ++band)
                part(SLOT_SIDES + (face - 2) * SIDE_BANDS + band);
        }
    }
}

/// Where a layer's things are: in each slot, and all together.
struct Held {
    std::array<Rect, SLOT_COUNT> rects;
    glm::dvec3 axis{0, 0, 1};
    double radius = pi; ///< of the circle around `axis` that holds them all; below 0 where there are none

    /// Everywhere.
    Held()
    {
        for (int slot = 0; slot < SLOT_COUNT; ++slot)
            rects[std::size_t(slot)] = slot_rect(slot);
    }
    Held(const std::vector<Ball>& things, int rear_last)
    {
        glm::dvec3 sum(0);
        for (const Ball& thing : things)
            if (const double distance = glm::length(thing.centre); distance > thing.radius)
                sum += thing.centre / distance * (thing.radius / distance);
        if (glm::length(sum) > 0)
            axis = glm::normalize(sum);
        radius = -1;
        for (const Ball& thing : things) {
            const double distance = glm::length(thing.centre);
            const bool inside = !(distance > thing.radius * 1.0001);
            const glm::dvec3 way = inside ? axis : thing.centre / distance;
            const double spread = inside ? pi : std::asin(thing.radius / distance);
            radius = std::max(radius, std::min(pi, angle(axis, way) + spread));
            each_slot(way, spread, rear_last, [&](int slot, const Rect& part) { rects[std::size_t(slot)].add(part); });
        }
    }

    static double angle(const glm::dvec3& a, const glm::dvec3& b)
    {
        return 2 * std::asin(std::min(1.0, 0.5 * glm::length(a - b)));
    }
    bool touches(const glm::dvec3& centre, double r) const
    {
        return radius >= pi || (radius >= 0 && angle(axis, centre) <= radius + r);
    }
};

void ask(Demands& demands, const Held& held, const Disc& disc, int rear_last)
{
    if (!held.touches(disc.centre, disc.radius))
        return;
    each_slot(disc.centre, disc.radius, rear_last, [&](int slot, const Rect& wanted) {
        const Rect& own = held.rects[std::size_t(slot)];
        const Rect part{glm::max(own.low, wanted.low), glm::min(own.high, wanted.high)};
        if (part.empty())
            return;
        // The solid angle of a texel at (a, b) is its area over (1 + a^2 + b^2)^(3/2).
        const glm::dvec2 at = 0.5 * (wanted.low + wanted.high);
        const double per_angle = std::pow(1 + glm::dot(at, at), 0.75);
        Demand& demand = demands[std::size_t(slot)];
        demand.rect.add(part);
        demand.finest = std::min(demand.finest, disc.finest * per_angle);
        demand.coarsest = std::max(demand.coarsest, disc.coarsest * per_angle);
    });
}

/// Walks a view's blocks of pixels, finer where the boost spreads one over much of the sky.
struct Walk {
    const View& view;
    double E;
    bool galilean;
    int rear_last;
    const Held& held;
    Demands& demands;
    int coarsest_level; ///< that is fine enough to follow the view's outline

    void block(int level, glm::ivec2 at) const
    {
        const bool last = level + 1 == view.blocks->levels();
        if (view.blocks->flat() && level < coarsest_level)
            return split(level, at);
        const Cap cap = view.blocks->cap(level, at);
        if (cap.empty())
            return;
        if (!last && (level < coarsest_level || cap.radius > 0.3))
            return split(level, at);

        // A boost maps circles to circles, so the world's disc follows exactly from its two ends on the meridian.
        const glm::dvec3 centre = view.motion_from_cockpit * glm::dvec3(cap.centre);
        const double radius = cap.radius + 0.5 * cap.coarsest;
        const glm::dvec2 across(centre.x, centre.y);
        const double theta = std::atan2(glm::length(across), centre.z);
        const double beta = (E - 1 / E) / (E + 1 / E);
        auto world = [&](double camera) {
            return galilean ? camera + std::asin(beta * std::sin(camera))
                            : 2 * std::atan2(E * std::sin(camera / 2), std::cos(camera / 2));
        };
        const double low = world(theta - radius), high = world(std::min(theta + radius, theta + pi));
        Disc disc;
        disc.radius = std::min(pi, 0.5 * (high - low));
        if (!last && disc.radius > 0.25)
            return split(level, at);
        const double world_theta = 0.5 * (low + high);
        const glm::dvec2 meridian = glm::length(across) > 0 ? across / glm::length(across) : glm::dvec2(1, 0);
        disc.centre = glm::dvec3(meridian * std::sin(world_theta), std::cos(world_theta));
        auto doppler = [&](double camera) {
            const double c = std::cos(camera / 2), s = std::sin(camera / 2);
            return 1 / (c * c / E + s * s * E);
        };
        const double D = doppler(theta);
        if (galilean) {
            // Stretched by more away from the axis than around it, or less: both bounds hold the disc and its pixels.
            const glm::dvec2 stretch = physics::galilean_stretch(glm::dvec3(std::sin(theta), 0, std::cos(theta)), E, 1 / E);
            disc.radius = std::min(pi, std::max(disc.radius, 1.2 * radius * std::max(stretch.x, stretch.y)));
            disc.finest = std::min(stretch.x, stretch.y) * cap.finest;
            disc.coarsest = std::max(stretch.x, stretch.y) * cap.coarsest;
            disc.radius = std::min(pi, disc.radius + view.parallax_rad);
            ask(demands, held, disc, rear_last);
            return;
        }
        // A last block may still hold many pixels: the finest texel is then wanted at its far side.
        disc.finest = (disc.radius > 0.25 ? doppler(std::min(theta + cap.radius, pi)) : D) * cap.finest;
        disc.coarsest = D * cap.coarsest;
        disc.radius = std::min(pi, disc.radius + view.parallax_rad);
        ask(demands, held, disc, rear_last);
    }

    void split(int level, glm::ivec2 at) const
    {
        const glm::ivec2 finer = view.blocks->count(level + 1);
        for (int j = 2 * at.y; j < std::min(2 * at.y + 2, finer.y); ++j)
            for (int i = 2 * at.x; i < std::min(2 * at.x + 2, finer.x); ++i)
                block(level + 1, {i, j});
    }
};

/// Shelves, tallest first; the atlas is about square. Corners stay on multiples of `align` so that mips stay apart.
void pack(Plan& plan, int align)
{
    std::array<PlanImage*, MAX_LAYERS * SLOT_COUNT> order;
    std::size_t count = 0;
    double area = 0;
    int widest = 0;
    for (PlanImage& image : plan.images) {
        order[count++] = &image;
        area += double(image.size.x) * image.size.y;
        widest = std::max(widest, image.size.x);
    }
    const std::span all(order.data(), count);
    std::sort(all.begin(), all.end(), [](auto* a, auto* b) {
        return std::tuple(a->size.y, b->layer, b->slot) > std::tuple(b->size.y, a->layer, a->slot);
    });
    int width = std::max(widest, (int(1.1 * std::sqrt(area)) + 63) / 64 * 64);
    glm::ivec2 pen(0);
    int shelf = 0;
    for (PlanImage* image : all) {
        if (pen.x + image->size.x > width)
            pen = {0, pen.y + shelf}, shelf = 0;
        image->atlas = pen;
        pen.x = (pen.x + image->size.x + align - 1) / align * align;
        shelf = std::max(shelf, (image->size.y + align - 1) / align * align);
    }
    plan.atlas_size = {width, std::max(1, pen.y + shelf)};
}

} // namespace

SlotPlace slot_of(const glm::dvec3& n, int rear_last)
{
    glm::dvec3 m = glm::abs(n);
    int face;
    if (m.z >= std::max(m.x, m.y))
        face = n.z >= 0 ? 0 : 1;
    else if (m.x >= m.y)
        face = n.x >= 0 ? 2 : 3;
    else
        face = n.y >= 0 ? 4 : 5;
    glm::dvec2 at = glm::dvec2(n[face_a[face]], n[face_b[face]]) / m[face_axis[face]];
    if (face == 0)
        return {SLOT_FRONT, face, at};
    if (face == 1)
        return {SLOT_REAR + rear_level(std::max(std::abs(at.x), std::abs(at.y)), rear_last), face, at};
    int band = (at.y > band_edges[1]) + (at.y > band_edges[2]);
    return {SLOT_SIDES + (face - 2) * SIDE_BANDS + band, face, at};
}

glm::dvec3 face_direction(int face, const glm::dvec2& at)
{
    glm::dvec3 n;
    n[face_axis[face]] = face_sign[face];
    n[face_a[face]] = at.x;
    n[face_b[face]] = at.y;
    return n;
}

Plan make_plan(const std::vector<View>& views, double E, const Quality& quality)
{
    return make_plan({PlanLayer{views, E}}, quality);
}

Plan make_plan(const std::vector<PlanLayer>& layers, const Quality& quality, Plan before)
{
    std::array<Demands, MAX_LAYERS> demands;
    Plan plan;
    std::swap(plan.images, before.images), plan.images.clear();
    std::swap(plan.rear_last, before.rear_last), plan.rear_last.clear();
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        const double E = layers[layer].E;
        // Behind, D stops falling at 1/gamma from the axis: finer images would only repeat the last one.
        const int rear_last = std::clamp(
            int(std::ceil(2 * std::log2(0.5 * (E + 1 / E)))), 0, std::min(quality.rear_images, REAR_LEVELS - 1));
        plan.rear_last.push_back(rear_last);
        const Held held = layers[layer].things ? Held(*layers[layer].things, rear_last) : Held();
        for (const View& view : layers[layer].views) {
            const Blocks& blocks = *view.blocks;
            if (layer == 0)
                plan.pixels += double(blocks.size().x) * blocks.size().y;
            if (held.radius < 0)
                continue;
            // Blocks of up to 32 pixels, and no fewer than 16 across.
            const double wanted = std::min(32.0, std::max(blocks.size().x, blocks.size().y) / 16.0);
            int level = 0;
            while (level + 1 < blocks.levels() && blocks.side(level) > wanted)
                ++level;
            Walk{view, E, layers[layer].galilean, rear_last, held, demands[layer], level}.block(0, {0, 0});
        }
    }

    constexpr int least = 8, most = 8192; // texels across one image
    const int most_levels = quality.mips ? 5 : 1;
    auto lay_out = [&](double density) {
        plan.images.clear();
        plan.texels = 0;
        plan.levels = 1;
        for (std::size_t at = 0; at < layers.size() * SLOT_COUNT; ++at) {
            const std::size_t layer = at / SLOT_COUNT;
            const int slot = int(at % SLOT_COUNT);
            const Demand& demand = demands[layer][std::size_t(slot)];
            if (demand.rect.empty())
                continue;
            glm::dvec2 extent = demand.rect.high - demand.rect.low;
            double unit = std::min(demand.finest / density, std::max(std::max(extent.x, extent.y), 1e-300) / least);
            unit = std::max(unit, std::max(extent.x, extent.y) / most);
            PlanImage image;
            image.slot = slot;
            image.face = slot_face(slot);
            image.layer = int(layer);
            image.texels_per_unit = 1 / unit;
            // Up to twofold shrinking is what bilinear filtering holds; beyond it the image needs mips.
            image.levels = std::clamp(1 + int(std::floor(std::log2(demand.coarsest / unit) - 0.2)), 1, most_levels);
            // Twice as wide where pixels look past the image: what they filter in is then all told.
            int gutter = (layers[layer].things ? 4 : 2) << (image.levels - 1);
            int grid = 1 << image.levels;
            for (int i = 0; i < 2; ++i) {
                // Edges on the texel grid of the whole face, so that a rectangle that grows does not shift its texels.
                double first = std::floor(demand.rect.low[i] / (grid * unit)) * grid - gutter;
                double last = std::ceil(demand.rect.high[i] / (grid * unit)) * grid + gutter;
                image.low[i] = first * unit;
                image.high[i] = last * unit;
                image.size[i] = int(last - first);
            }
            if (slot >= SLOT_REAR && slot < SLOT_REAR + plan.rear_last[layer])
                image.hole = std::max(0.0, std::exp2(-0.5 * (slot + 1 - SLOT_REAR)) - (gutter + 1) * unit);
            plan.levels = std::max(plan.levels, image.levels);
            plan.texels += double(image.size.x) * image.size.y;
            plan.images.push_back(image);
        }
    };
    double density = quality.texels_per_pixel;
    lay_out(density);
    // What moves may fill the view as well as the world behind it.
    int seen = 0;
    for (std::size_t i = 0; i < plan.images.size(); ++i)
        seen += i == 0 || plan.images[i].layer != plan.images[i - 1].layer;
    double most_texels = std::min(quality.most_texels_per_pixel * plan.pixels * std::max(seen, 1), quality.max_texels);
    for (int i = 0; i < 4 && plan.texels > 1.02 * most_texels; ++i) {
        density *= std::sqrt(most_texels / plan.texels);
        lay_out(density);
    }
    pack(plan, 1 << plan.levels);
    for (int i = 0; i < 8 && std::max(plan.atlas_size.x, plan.atlas_size.y) > quality.max_atlas_side; ++i) {
        density *= 0.9 * quality.max_atlas_side / std::max(plan.atlas_size.x, plan.atlas_size.y);
        lay_out(density);
        pack(plan, 1 << plan.levels);
    }
    return plan;
}

bool serves(const Plan& drawn, const Plan& wanted)
{
    constexpr double hardly_less = 0.8;
    return drawn.rear_last == wanted.rear_last
        && std::all_of(wanted.images.begin(), wanted.images.end(), [&](const PlanImage& image) {
               const auto same = std::find_if(drawn.images.begin(), drawn.images.end(),
                   [&](const PlanImage& own) { return own.layer == image.layer && own.slot == image.slot; });
               return same != drawn.images.end() && glm::all(glm::lessThanEqual(same->low, image.low))
                   && glm::all(glm::greaterThanEqual(same->high, image.high)) && same->hole <= image.hole
                   && same->levels >= image.levels && same->texels_per_unit >= hardly_less * image.texels_per_unit;
           });
}

glm::dmat4 clip_from_motion(const PlanImage& image, double near_distance)
{
    // x_clip / w runs from -1 to 1 over the picture, depth is near / distance.
    glm::dvec2 scale = 2.0 / (image.high - image.low), offset = -(image.high + image.low) / (image.high - image.low);
    glm::dmat4 m(0);
    m[face_a[image.face]][0] = scale.x;
    m[face_axis[image.face]][0] = offset.x * face_sign[image.face];
    m[face_b[image.face]][1] = scale.y;
    m[face_axis[image.face]][1] = offset.y * face_sign[image.face];
    m[3][2] = near_distance;
    m[face_axis[image.face]][3] = face_sign[image.face];
    return m;
}

shared::SlotEntry slot_entry(const PlanImage& image)
{
    const glm::dvec2 offset = glm::dvec2(image.atlas) - image.low * image.texels_per_unit;
    return {
        glm::vec4(image.texels_per_unit, offset, image.levels - 1), glm::vec4(image.atlas, image.atlas + image.size - 1)};
}

void put_slots(const Plan& plan, std::span<shared::SlotEntry> table)
{
    std::fill_n(table.begin(), plan.rear_last.size() * SLOT_COUNT, shared::SlotEntry{});
    for (const PlanImage& image : plan.images)
        table[std::size_t(image.layer * SLOT_COUNT + image.slot)] = slot_entry(image);
}

glm::dmat3 motion_from_world(const glm::dvec3& u, const glm::dquat& ship_from_cockpit)
{
    double length = glm::length(u);
    glm::dvec3 z = length > 0 ? u / length : ship_from_cockpit * glm::dvec3(0, 0, -1);
    z = glm::normalize(z);
    glm::dvec3 up = ship_from_cockpit * glm::dvec3(0, 1, 0);
    if (std::abs(glm::dot(up, z)) > 0.99)
        up = ship_from_cockpit * glm::dvec3(0, 0, 1);
    glm::dvec3 y = glm::normalize(up - glm::dot(up, z) * z);
    glm::dvec3 x = glm::cross(y, z);
    return glm::transpose(glm::dmat3(x, y, z));
}

} // namespace starbow
