#include "cube_map_plan.h"
#include "scratch.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <tuple>

namespace starbow {
namespace {

constexpr int least_side = 16, most_side = 8192; // texels across one image, without gutter

/// Drafts images of parts of a tile.
struct Draft {
    const Quality& quality;
    double density;
    int rest_frame;
    bool spreads; ///< the filter of a pixel may reach beyond the image
    int finest_clip_level;

    /// The texel grid of an image.
    struct Grid {
        double unit; ///< face units per texel
        int levels, gutter, step; ///< mip levels; texels around the demand, and of which its edges are multiples
    };
    Grid grid(const Demand& demand) const
    {
        const glm::dvec2 extent = demand.rect.high - demand.rect.low;
        const double longest = std::max(extent.x, extent.y);
        double unit = std::min(demand.finest / density, std::max(longest, 1e-300) / least_side);
        unit = std::max(unit, longest / most_side);
        // Bilinear filtering holds up to a twofold reduction; beyond it the image needs mips.
        const int most_levels = quality.mips ? 5 : 1;
        const int levels = std::clamp(1 + int(std::floor(std::log2(demand.coarsest / unit) - 0.2)), 1, most_levels);
        // Twice as wide where pixels' filters reach beyond the image, so that the image holds all their texels.
        return {unit, levels, (spreads ? 4 : 2) << (levels - 1), 1 << levels};
    }

    PlannedImage image(int tile, const SubTiles& sub_tiles, const Demand& demand) const
    {
        const auto [unit, levels, gutter, step] = grid(demand);
        PlannedImage image;
        image.tile = tile;
        image.sub_tiles = sub_tiles;
        image.face = tile_face(tile);
        image.rest_frame = rest_frame;
        image.texels_per_unit = 1 / unit;
        image.levels = levels;
        for (int i = 0; i < 2; ++i) {
            // Edges lie on the face's texel grid, so that a growing rectangle does not shift its texels.
            const double first = std::floor(demand.rect.low[i] / (step * unit)) * step - gutter;
            const double last = std::ceil(demand.rect.high[i] / (step * unit)) * step + gutter;
            image.low[i] = first * unit;
            image.high[i] = last * unit;
            image.size[i] = int(last - first);
        }
        if (const double hole = clip_hole(tile, finest_clip_level); hole > 0)
            image.clip_hole = std::max(0.0, hole - (gutter + 1) * unit);
        return image;
    }

    /// An image's texels in the mean over all places of its edges on the grid: unlike its own, they change smoothly.
    double mean_texels(const Demand& demand) const
    {
        const auto [unit, levels, gutter, step] = grid(demand);
        const glm::dvec2 side = (demand.rect.high - demand.rect.low) / unit + double(step + 2 * gutter);
        return side.x * side.y;
    }

    /// The cost of an image, in texels.
    double cost(const PlannedImage& image) const
    {
        constexpr double with_mips = 4.0 / 3;
        return double(image.size.x) * image.size.y * (image.levels > 1 ? with_mips : 1) + quality.image_cost_texels;
    }
};

constexpr int halved = TILE_SUB_TILES - 1; // intervals below this index have halves

void merge(TileDemands& all, const Demands::Tile& demand)
{
    for (int b = TileDemands::intervals - 1; b >= 0; --b)
        for (int a = TileDemands::intervals - 1; a >= 0; --a) {
            Demand& own = all.demands[b][a];
            double& wanted = all.wanted[b][a];
            if (a < halved) {
                own = all.demands[b][2 * a + 1];
                own.add(all.demands[b][2 * a + 2]);
                wanted = all.wanted[b][2 * a + 1] + all.wanted[b][2 * a + 2];
            } else if (b < halved) {
                own = all.demands[2 * b + 1][a];
                own.add(all.demands[2 * b + 2][a]);
                wanted = all.wanted[2 * b + 1][a] + all.wanted[2 * b + 2][a];
            } else {
                own = demand.sub_tiles[std::size_t((b - halved) * TILE_SUB_TILES + a - halved)];
                const glm::dvec2 extent = own.rect.high - own.rect.low;
                wanted = own.rect.empty() ? 0 : extent.x * extent.y / (own.finest * own.finest);
            }
        }
}

/// Divides a tile into the rectangles of sub-tiles that cost least together.
class Cutting {
public:
    Cutting(const Draft& draft, const TileDemands& demands)
        : draft_(draft)
        , demands_(demands)
    {
        for (auto& row : ways_)
            std::fill(std::begin(row), std::end(row), Way::unknown);
    }

    void add_images(std::vector<PlannedImage>& images, std::vector<Demand>& held)
    {
        if (!demands_.demands[0][0].rect.empty())
            add(0, 0, images, held);
    }

private:
    enum class Way : char { unknown, whole, along_a, along_b };

    /// The sub-tiles of an interval of the heap.
    static void interval_sub_tiles(int interval, int& first, int& count)
    {
        const int level = std::bit_width(unsigned(interval + 1)) - 1;
        count = TILE_SUB_TILES >> level;
        first = (interval + 1 - (1 << level)) * count;
    }
    static SubTiles sub_tiles(int a, int b)
    {
        SubTiles sub_tiles;
        interval_sub_tiles(a, sub_tiles.first.x, sub_tiles.count.x);
        interval_sub_tiles(b, sub_tiles.first.y, sub_tiles.count.y);
        return sub_tiles;
    }

    /// Returns the least cost of a part over all its divisions, and stores that division.
    double cost(int a, int b)
    {
        const Demand& demand = demands_.demands[b][a];
        if (demand.rect.empty())
            return 0;
        double& cost = costs_[b][a];
        Way& way = ways_[b][a];
        if (way != Way::unknown)
            return cost;
        way = Way::whole;
        cost = draft_.cost(draft_.image(demands_.tile, {}, demand));
        // A division costs at least one more image and the texels without any waste.
        const double least = demands_.wanted[b][a] * draft_.density * draft_.density + 2 * draft_.quality.image_cost_texels;
        if (cost <= least)
            return cost;
        if (a < halved)
            if (const double cut = this->cost(2 * a + 1, b) + this->cost(2 * a + 2, b); cut < cost)
                cost = cut, way = Way::along_a;
        if (b < halved)
            if (const double cut = this->cost(a, 2 * b + 1) + this->cost(a, 2 * b + 2); cut < cost)
                cost = cut, way = Way::along_b;
        return cost;
    }

    void add(int a, int b, std::vector<PlannedImage>& images, std::vector<Demand>& held)
    {
        if (demands_.demands[b][a].rect.empty())
            return;
        cost(a, b);
        switch (ways_[b][a]) {
        case Way::along_a:
            add(2 * a + 1, b, images, held), add(2 * a + 2, b, images, held);
            return;
        case Way::along_b:
            add(a, 2 * b + 1, images, held), add(a, 2 * b + 2, images, held);
            return;
        default:
            images.push_back(draft_.image(demands_.tile, sub_tiles(a, b), demands_.demands[b][a]));
            held.push_back(demands_.demands[b][a]);
        }
    }

    const Draft& draft_;
    const TileDemands& demands_;
    double costs_[TileDemands::intervals][TileDemands::intervals];
    Way ways_[TileDemands::intervals][TileDemands::intervals];
};

/// The images of all tiles, at one density.
struct Allocation {
    const std::vector<RestFrameRequest>& requests;
    const Quality& quality;
    std::span<const TileDemands> by_tile;
    CubeMapPlan& plan;
    std::vector<Demand>& held; ///< of each image

    Draft draft(int rest_frame, double density) const
    {
        const std::size_t at = std::size_t(rest_frame);
        return {quality, density, rest_frame, requests[at].bounds.has_value(), plan.finest_clip_level[at]};
    }
    /// Divides all tiles.
    void divide(double density)
    {
        plan.images.clear(), held.clear();
        for (const TileDemands& demands : by_tile) {
            const Draft own = draft(demands.rest_frame, density);
            Cutting(own, demands).add_images(plan.images, held);
        }
    }
    /// Gives the images another density.
    void scale(double density)
    {
        for (std::size_t i = 0; i < held.size(); ++i) {
            PlannedImage& image = plan.images[i];
            image = draft(image.rest_frame, density).image(image.tile, image.sub_tiles, held[i]);
        }
    }
    double mean_texels(double density) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < held.size(); ++i)
            sum += draft(plan.images[i].rest_frame, density).mean_texels(held[i]);
        return sum;
    }
    /// The density at which the images have so many texels. It changes smoothly with the demand. If it followed the
    /// images' own texels, it would jump whenever an image grew by a row, and all texels of the picture with it.
    double fitting(double density, double texels) const
    {
        for (int i = 0; i < 8; ++i) {
            const double ratio = texels / mean_texels(density);
            density *= std::sqrt(ratio);
            if (std::abs(ratio - 1) < 1e-7)
                break;
        }
        return density;
    }
    void sum_up()
    {
        plan.texels = 0;
        plan.levels = 1;
        plan.cut = false;
        for (const PlannedImage& image : plan.images) {
            plan.levels = std::max(plan.levels, image.levels);
            plan.texels += double(image.size.x) * image.size.y;
            plan.cut = plan.cut || !image.sub_tiles.all();
        }
    }
};

/// The tangent of the angle from straight behind within which the views need one density: D is nearly constant within
/// 1 / gamma, and all may be dark. Finer nested images would repeat the last one.
double even_behind(const RestFrameRequest& request)
{
    const double E = request.E;
    double dark_D = 1e300;
    for (const ViewRequest& view : request.views)
        dark_D = std::min(dark_D, view.dark_D);
    // D = E s + (1 - s) / E in the world's direction with s the square of the sine of half that angle.
    const double s = E > 1 ? std::clamp((dark_D - 1 / E) / (E - 1 / E), 0.0, 0.14) : 0; // up to 44 degrees
    return std::max(2 / (E + 1 / E), std::tan(2 * std::asin(std::sqrt(s))));
}

/// Packs images on shelves, tallest first, into an atlas that is about square. Corners are multiples of `align`, so that
/// mips don't overlap.
void pack(CubeMapPlan& plan, std::vector<std::size_t>& order, int align)
{
    order.clear();
    double area = 0;
    int widest = 0;
    for (const PlannedImage& image : plan.images) {
        order.push_back(order.size());
        area += double(image.size.x) * image.size.y;
        widest = std::max(widest, image.size.x);
    }
    reserve_headroom(order);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(plan.images[a].size.y, b) > std::tuple(plan.images[b].size.y, a);
    });
    int width = std::max(widest, (int(1.1 * std::sqrt(area)) + 63) / 64 * 64);
    glm::ivec2 pen(0);
    int shelf = 0;
    for (std::size_t at : order) {
        PlannedImage& image = plan.images[at];
        if (pen.x + image.size.x > width)
            pen = {0, pen.y + shelf}, shelf = 0;
        image.atlas = pen;
        pen.x = (pen.x + image.size.x + align - 1) / align * align;
        shelf = std::max(shelf, (image.size.y + align - 1) / align * align);
    }
    plan.atlas_size = {width, std::max(1, pen.y + shelf)};
}

} // namespace

CubeMapPlan plan_cube_map(const std::vector<ViewRequest>& views, double E, const Quality& quality)
{
    return plan_cube_map({RestFrameRequest{views, E}}, quality);
}

CubeMapPlan plan_cube_map(const std::vector<RestFrameRequest>& requests, const Quality& quality)
{
    PlanScratch room;
    return plan_cube_map(requests, quality, room);
}

CubeMapPlan plan_cube_map(
    const std::vector<RestFrameRequest>& requests, const Quality& quality, PlanScratch& room, CubeMapPlan before)
{
    CubeMapPlan plan;
    std::swap(plan.images, before.images);
    std::swap(plan.finest_clip_level, before.finest_clip_level), plan.finest_clip_level.clear();
    double dark_pixels = 0;
    std::size_t used = 0; // of room.by_tile, whose elements of 54 kB are filled in place
    if (room.demands.size() < requests.size())
        room.demands.resize(requests.size());
    for (std::size_t rest_frame = 0; rest_frame < requests.size(); ++rest_frame) {
        // Nested images would not be around the axis behind where the cube map has other axes; there D varies little.
        const RestFrameRequest& request = requests[rest_frame];
        const int finest_clip_level = request.aligned() ? std::clamp(int(std::ceil(-2 * std::log2(even_behind(request)))), 0,
                                          std::min(quality.clip_levels, REAR_LEVELS - 1))
                                                        : 0;
        plan.finest_clip_level.push_back(finest_clip_level);
        room.demands[rest_frame].clear();
        const double dark = add_demands(room.demands[rest_frame], request, finest_clip_level, quality.pixel_rays);
        if (rest_frame == 0)
            dark_pixels = dark;
        for (int tile = 0; tile < TILE_COUNT; ++tile)
            if (const Demands::Tile& demand = room.demands[rest_frame].tiles[std::size_t(tile)]; demand.any) {
                if (used == room.by_tile.size())
                    room.by_tile.emplace_back();
                TileDemands& all = room.by_tile[used++];
                all.rest_frame = int(rest_frame), all.tile = tile;
                merge(all, demand);
            }
    }
    reserve_headroom(room.by_tile);
    const std::span<const TileDemands> by_tile = std::span(room.by_tile).first(used);
    for (const ViewRequest& view : requests[0].views)
        if (!view.beside)
            plan.pixels += double(view.cones->size().x) * view.cones->size().y;

    Allocation allocation{requests, quality, by_tile, plan, room.held};
    double density = quality.texels_per_pixel;
    allocation.divide(density);
    // Moving bodies may fill the view, and so may the world behind them: the limit counts for each rest frame.
    int seen = 0;
    for (std::size_t i = 0; i < plan.images.size(); ++i)
        seen += i == 0 || plan.images[i].rest_frame != plan.images[i - 1].rest_frame;
    // Dark texels are few; a little more keeps the picture's edge of light as fine as it was.
    constexpr double dark_counts = 1.0 / 16;
    const double counted = plan.pixels - (1 - dark_counts) * dark_pixels;
    // Tiles cost time whatever their texels, and their gutters are texels: less would only be coarse.
    const double least_texels = quality.image_cost_texels * double(used) / 16;
    const double most_texels
        = std::min(std::max(quality.max_texels_per_pixel * counted * std::max(seen, 1), least_texels), quality.max_texels);
    // Other divisions suit a coarser plan, and they have other texels.
    for (int i = 0; i < 3 && allocation.mean_texels(density) > (1 + 1e-6) * most_texels; ++i) {
        density = allocation.fitting(density, most_texels);
        allocation.divide(density);
    }
    if (allocation.mean_texels(density) > (1 + 1e-6) * most_texels) {
        density = allocation.fitting(density, most_texels);
        allocation.scale(density);
    }
    allocation.sum_up();
    reserve_headroom(room.held);
    reserve_headroom(plan.images);
    pack(plan, room.by_height, 1 << plan.levels);
    for (int i = 0; i < 8 && std::max(plan.atlas_size.x, plan.atlas_size.y) > quality.max_atlas_side; ++i) {
        density *= 0.9 * quality.max_atlas_side / std::max(plan.atlas_size.x, plan.atlas_size.y);
        allocation.divide(density);
        allocation.sum_up();
        pack(plan, room.by_height, 1 << plan.levels);
    }
    return plan;
}

void mark_needed(CubeMapPlan& whole, const CubeMapPlan& part)
{
    const auto meet = [](const SubTiles& a, const SubTiles& b) {
        return glm::all(glm::lessThan(a.first, b.first + b.count)) && glm::all(glm::lessThan(b.first, a.first + a.count));
    };
    for (PlannedImage& image : whole.images)
        image.needed = std::ranges::any_of(part.images, [&](const PlannedImage& own) {
            return own.rest_frame == image.rest_frame && own.tile == image.tile && meet(own.sub_tiles, image.sub_tiles);
        });
}

bool can_reuse(const CubeMapPlan& drawn, const CubeMapPlan& wanted)
{
    constexpr double hardly_less = 0.8;
    return drawn.finest_clip_level == wanted.finest_clip_level
        && std::all_of(wanted.images.begin(), wanted.images.end(), [&](const PlannedImage& image) {
               const auto same = std::find_if(drawn.images.begin(), drawn.images.end(), [&](const PlannedImage& own) {
                   return own.rest_frame == image.rest_frame && own.tile == image.tile && own.sub_tiles == image.sub_tiles;
               });
               return same != drawn.images.end() && glm::all(glm::lessThanEqual(same->low, image.low))
                   && glm::all(glm::greaterThanEqual(same->high, image.high)) && same->clip_hole <= image.clip_hole
                   && same->levels >= image.levels && same->needed >= image.needed
                   && same->texels_per_unit >= hardly_less * image.texels_per_unit;
           });
}

glm::dmat4 clip_from_cube(const PlannedImage& image, double near_distance)
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

shared::TileEntry tile_entry(const PlannedImage& image)
{
    const glm::dvec2 offset = glm::dvec2(image.atlas) - image.low * image.texels_per_unit;
    return {
        glm::vec4(image.texels_per_unit, offset, image.levels - 1), glm::vec4(image.atlas, image.atlas + image.size - 1)};
}

namespace {

/// The image whose sub-tiles are nearest to the given one.
const PlannedImage& nearest_image(std::span<const PlannedImage> images, const glm::ivec2& sub_tile)
{
    const auto off = [&](const PlannedImage& image) {
        const glm::ivec2 past
            = glm::max(image.sub_tiles.first - sub_tile, sub_tile - (image.sub_tiles.first + image.sub_tiles.count - 1));
        return std::max({past.x, past.y, 0});
    };
    return *std::min_element(
        images.begin(), images.end(), [&](const PlannedImage& a, const PlannedImage& b) { return off(a) < off(b); });
}

} // namespace

std::span<const PlannedImage> of_first_tile(std::span<const PlannedImage> images)
{
    const auto other = [&](const PlannedImage& image) {
        return image.rest_frame != images[0].rest_frame || image.tile != images[0].tile;
    };
    return images.first(std::size_t(std::find_if(images.begin(), images.end(), other) - images.begin()));
}

std::size_t write_tiles(const CubeMapPlan& plan, shared::TileTable& table)
{
    std::size_t bytes = 0;
    const auto write = [&](auto& to, const auto& value) { to = value, bytes += sizeof to; };
    for (std::size_t tile = 0; tile < plan.finest_clip_level.size() * TILE_COUNT; ++tile) {
        write(table.sub_tiles_from_face[tile], glm::vec4(0));
        write(table.entries[tile * SUB_TILE_COUNT], shared::TileEntry{});
    }
    for (std::span<const PlannedImage> left = plan.images; !left.empty();) {
        const std::span<const PlannedImage> images = of_first_tile(left);
        left = left.subspan(images.size());
        const std::size_t tile = std::size_t(images[0].rest_frame * TILE_COUNT + images[0].tile);
        shared::TileEntry* entries = table.entries + tile * SUB_TILE_COUNT;
        if (images[0].sub_tiles.all()) {
            write(*entries, tile_entry(images[0]));
            continue;
        }
        write(table.sub_tiles_from_face[tile], glm::vec4(sub_tiles_from_face(images[0].tile)));
        std::array<bool, SUB_TILE_COUNT> written{};
        for (const PlannedImage& image : images) {
            const shared::TileEntry entry = tile_entry(image);
            for (int y = image.sub_tiles.first.y; y < image.sub_tiles.first.y + image.sub_tiles.count.y; ++y)
                for (int x = image.sub_tiles.first.x; x < image.sub_tiles.first.x + image.sub_tiles.count.x; ++x) {
                    write(entries[y * TILE_SUB_TILES + x], entry);
                    written[std::size_t(y * TILE_SUB_TILES + x)] = true;
                }
        }
        // A sub-tile without pixels refers to the nearest drawn one, because rounding may lead there.
        for (int sub_tile = 0; sub_tile < SUB_TILE_COUNT; ++sub_tile)
            if (!written[std::size_t(sub_tile)])
                write(entries[sub_tile],
                    tile_entry(nearest_image(images, {sub_tile % TILE_SUB_TILES, sub_tile / TILE_SUB_TILES})));
    }
    return bytes;
}

} // namespace starbow
