#include "plan.h"
#include "displays/direction_map.h"
#include "physics/physics.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

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
    double texel_angle; // one texel per pixel, radians
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

void ask(Demands& demands, int slot, const Rect& wanted, double texel_angle)
{
    Rect own = slot_rect(slot);
    Rect part{glm::max(own.low, wanted.low), glm::min(own.high, wanted.high)};
    if (part.empty())
        return;
    // The solid angle of a texel at (a, b) is its area over (1 + a^2 + b^2)^(3/2).
    glm::dvec2 at = 0.5 * (part.low + part.high);
    double unit = texel_angle * std::pow(1 + glm::dot(at, at), 0.75);
    Demand& demand = demands[slot];
    demand.rect.add(part);
    demand.finest = std::min(demand.finest, unit);
    demand.coarsest = std::max(demand.coarsest, unit);
}

void ask(Demands& demands, const Disc& disc, int rear_last)
{
    for (int face = 0; face < 6; ++face) {
        double normal = disc.centre[face_axis[face]] * face_sign[face];
        Rect wanted;
        if (!face_range(disc.centre[face_a[face]], normal, disc.radius, wanted.low.x, wanted.high.x)
            || !face_range(disc.centre[face_b[face]], normal, disc.radius, wanted.low.y, wanted.high.y))
            continue;
        if (face == 0) {
            ask(demands, SLOT_FRONT, wanted, disc.texel_angle);
        } else if (face == 1) {
            // The nested squares from the one that holds the disc's outermost point to the one of its innermost.
            glm::dvec2 far = glm::max(glm::abs(wanted.low), glm::abs(wanted.high));
            glm::dvec2 near = glm::max(glm::max(wanted.low, -wanted.high), glm::dvec2(0));
            int outer = rear_level(std::max(far.x, far.y), rear_last),
                inner = rear_level(std::max(near.x, near.y), rear_last);
            for (int level = outer; level <= inner; ++level)
                ask(demands, SLOT_REAR + level, wanted, disc.texel_angle);
        } else {
            for (int band = 0; band < SIDE_BANDS; ++band)
                ask(demands, SLOT_SIDES + (face - 2) * SIDE_BANDS + band, wanted, disc.texel_angle);
        }
    }
}

/// Walks a view's pixels in cells, cut finer where the boost spreads a cell over much of the sky.
struct Walk {
    const View& view;
    double E;
    int rear_last;
    Demands& demands;
    double least_angle; ///< below it a finer texel shows nothing more

    std::optional<glm::dvec3> look(glm::dvec2 pixel) const
    {
        auto n = direction(view.projection, view.size, pixel);
        if (!n)
            return {};
        return view.motion_from_cockpit * *n;
    }

    void cell(double x0, double y0, double x1, double y1) const
    {
        double width = std::max(x1 - x0, y1 - y0);
        glm::dvec2 middle(0.5 * (x0 + x1), 0.5 * (y0 + y1));
        const glm::dvec2 corner_at[4] = {{x0, y0}, {x1, y0}, {x0, y1}, {x1, y1}};
        auto centre = look(middle);
        std::optional<glm::dvec3> corners[4];
        for (int i = 0; i < 4; ++i)
            corners[i] = look(corner_at[i]);
        int seen = centre.has_value();
        for (auto& corner : corners)
            seen += corner.has_value();
        bool rim = seen < 5;
        if (rim && width > 4)
            return split(x0, y0, x1, y1);
        if (seen == 0 && width <= 1)
            return;
        if (rim && !centre) {
            for (int i = 0; i < 4; ++i)
                if (corners[i])
                    centre = corners[i], middle = corner_at[i];
            if (!centre)
                return;
        }
        double angle = std::max(pixel_angle(view.projection, view.size, middle), least_angle);
        double radius = angle; // a pixel's own extent, and some for a map that bends inside the cell
        if (rim)
            radius += 1.5 * width * angle;
        else
            for (auto& corner : corners)
                radius = std::max(radius, 1.05 * std::acos(std::clamp(glm::dot(*centre, *corner), -1.0, 1.0)) + 0.5 * angle);
        if (radius > 0.3 && width > 4)
            return split(x0, y0, x1, y1);

        // A boost maps circles to circles, so the world's disc follows exactly from its two ends on the meridian.
        glm::dvec2 across(centre->x, centre->y);
        double theta = std::atan2(glm::length(across), centre->z);
        auto world = [&](double camera) { return 2 * std::atan2(E * std::sin(camera / 2), std::cos(camera / 2)); };
        double low = world(theta - radius), high = world(std::min(theta + radius, theta + pi));
        Disc disc;
        disc.radius = std::min(pi, 0.5 * (high - low));
        if (disc.radius > 0.25 && width > 1.5)
            return split(x0, y0, x1, y1);
        double world_theta = 0.5 * (low + high);
        glm::dvec2 meridian = glm::length(across) > 0 ? across / glm::length(across) : glm::dvec2(1, 0);
        disc.centre = glm::dvec3(meridian * std::sin(world_theta), std::cos(world_theta));
        double half = 0.5 * theta;
        double D = 1 / (std::cos(half) * std::cos(half) / E + std::sin(half) * std::sin(half) * E);
        disc.texel_angle = D * angle;
        ask(demands, disc, rear_last);
    }

    void split(double x0, double y0, double x1, double y1) const
    {
        double x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
        cell(x0, y0, x, y);
        cell(x, y0, x1, y);
        cell(x0, y, x, y1);
        cell(x, y, x1, y1);
    }
};

/// Shelves, tallest first; the atlas is about square. Corners stay on multiples of `align` so that mips stay apart.
void pack(Plan& plan, int align)
{
    std::vector<PlanImage*> order;
    double area = 0;
    int widest = 0;
    for (PlanImage& image : plan.images) {
        order.push_back(&image);
        area += double(image.size.x) * image.size.y;
        widest = std::max(widest, image.size.x);
    }
    std::sort(order.begin(), order.end(),
        [](auto* a, auto* b) { return std::pair(a->size.y, b->slot) > std::pair(b->size.y, a->slot); });
    int width = std::max(widest, (int(1.1 * std::sqrt(area)) + 63) / 64 * 64);
    glm::ivec2 pen(0);
    int shelf = 0;
    for (PlanImage* image : order) {
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
    Demands demands;
    Plan plan;
    // Behind, D stops falling at 1/gamma from the axis: finer images would only repeat the last one.
    plan.rear_last = std::clamp(int(std::ceil(2 * std::log2(0.5 * (E + 1 / E)))), 0, REAR_LEVELS - 1);
    for (const View& view : views) {
        plan.pixels += double(view.size.x) * view.size.y;
        Walk walk{view, E, plan.rear_last, demands, 0.5 * pixel_length(view.projection, view.size)};
        // Cells of equal size, about 24 pixels, and no fewer than 16 across.
        double cell = std::min(24.0, std::max(view.size.x, view.size.y) / 16.0);
        int columns = std::max(1, int(std::ceil(view.size.x / cell))),
            rows = std::max(1, int(std::ceil(view.size.y / cell)));
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                walk.cell(double(view.size.x) * column / columns, double(view.size.y) * row / rows,
                    double(view.size.x) * (column + 1) / columns, double(view.size.y) * (row + 1) / rows);
    }

    constexpr int least = 8, most = 8192; // texels across one image
    constexpr int most_levels = 5;
    auto lay_out = [&](double density) {
        plan.images.clear();
        plan.texels = 0;
        plan.levels = 1;
        for (int slot = 0; slot < SLOT_COUNT; ++slot) {
            const Demand& demand = demands[slot];
            if (demand.rect.empty())
                continue;
            glm::dvec2 extent = demand.rect.high - demand.rect.low;
            double unit = std::min(demand.finest / density, std::max(std::max(extent.x, extent.y), 1e-300) / least);
            unit = std::max(unit, std::max(extent.x, extent.y) / most);
            PlanImage image;
            image.slot = slot;
            image.face = slot_face(slot);
            image.texels_per_unit = 1 / unit;
            // Up to twofold shrinking is what bilinear filtering holds; beyond it the image needs mips.
            image.levels = std::clamp(1 + int(std::floor(std::log2(demand.coarsest / unit) - 0.2)), 1, most_levels);
            int gutter = 2 << (image.levels - 1);
            int grid = 1 << image.levels;
            for (int i = 0; i < 2; ++i) {
                // Edges on the texel grid of the whole face, so that a rectangle that grows does not shift its texels.
                double first = std::floor(demand.rect.low[i] / (grid * unit)) * grid - gutter;
                double last = std::ceil(demand.rect.high[i] / (grid * unit)) * grid + gutter;
                image.low[i] = first * unit;
                image.high[i] = last * unit;
                image.size[i] = int(last - first);
            }
            if (slot >= SLOT_REAR && slot < SLOT_REAR + plan.rear_last)
                image.hole = std::max(0.0, std::exp2(-0.5 * (slot + 1 - SLOT_REAR)) - (gutter + 1) * unit);
            plan.levels = std::max(plan.levels, image.levels);
            plan.texels += double(image.size.x) * image.size.y;
            plan.images.push_back(image);
        }
    };
    double density = quality.texels_per_pixel;
    double most_texels = std::min(quality.max_texels_per_pixel * plan.pixels, quality.max_texels);
    lay_out(density);
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

std::vector<shared::SlotEntry> slot_table(const Plan& plan, glm::ivec2 atlas_extent)
{
    std::vector<shared::SlotEntry> table(SLOT_COUNT, shared::SlotEntry{glm::vec4(0), glm::vec4(0)});
    for (const PlanImage& image : plan.images) {
        glm::dvec2 scale = glm::dvec2(image.size) / (image.high - image.low) / glm::dvec2(atlas_extent);
        glm::dvec2 offset = glm::dvec2(image.atlas) / glm::dvec2(atlas_extent) - image.low * scale;
        table[image.slot] = {glm::vec4(scale, offset), glm::vec4(image.texels_per_unit, image.levels - 1, 0, 0)};
    }
    return table;
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
