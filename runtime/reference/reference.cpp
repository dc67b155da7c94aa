#include "reference.h"
#include "config/json/hash.h"
#include "config/json/row_cache.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "displays/finish/anaglyph.h"
#include "displays/finish/blend.h"
#include "globe_view.h"
#include "overlap.h"
#include "runtime/light/colour.h"
#include "runtime/light/srgb.h"
#include "runtime/world/fastest_motion.h"
#include "runtime/world/moving.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/worldline.h"
#include "shaders/tone.h"
#include "star_spots.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <sstream>
#include <thread>

namespace starbow {
namespace {

/// One view and the eye that looks through it.
struct ViewAt {
    const CompiledView* compiled;
    ViewRays rays;
    std::size_t eye;
    glm::dvec3 turning{0}; ///< not 0: the eye's offset from the head's middle where its baseline turns, cockpit, scene
                           ///< units
    std::size_t stars = 0, globes = 0;
    ViewShade shade; ///< read only where viewports overlap
};

struct EyeAt {
    ViewportObserver observer;
    glm::dvec3 place; ///< cockpit, scene units
    double beside;
    double pixel_rad = 0; ///< of the finest view that it looks through
};

class Picture_ {
public:
    /// ramps: of the views, or empty. plain: overlapping viewports are shown as a preview shows them.
    Picture_(const ReferenceInput& input, const Layout& layout, const Shot& shot, std::span<const CompiledView> views,
        std::span<const std::vector<float>> ramps, bool plain, int samples)
        : layout_(layout)
        , plain_(plain)
        , samples_(sample_places(samples))
        , pictures_(input.world)
        , colours_(input.world, input.scene, shot.effects[Effect::false_colours] ? false_colours() : eye())
        , globe_colours_(input.world.globes && input.scene.globes ? std::make_unique<GlobeColours>(
                             *input.world.globes, shot.effects[Effect::false_colours] ? false_colours() : eye())
                                                                  : nullptr)
        , exposure_(std::exp2(shot.exposure_ev))
    {
        const double scale = layout.stereo.units_per_m(input.scene.unit_m, input.scene.light_speed_m_s);
        const bool turns = layout.stereo.method == StereoMethod::reprojected && layout.stereo.turning;
        std::vector<EyeAt> places;
        views_.reserve(views.size());
        for (const CompiledView& compiled : views) {
            const View& view = compiled.view;
            const glm::dvec3 beside = view.picture.eye_m - view.head_m;
            const bool own = layout.stereo.method == StereoMethod::exact
                || (layout.stereo.method == StereoMethod::reprojected && !turns);
            EyeAt at{
                view.observer, (own ? view.picture.eye_m : view.head_m) * scale, turns ? glm::length(beside * scale) : 0};
            auto same = std::find_if(places.begin(), places.end(),
                [&](const EyeAt& e) { return e.observer == at.observer && e.place == at.place && e.beside == at.beside; });
            const std::size_t index = std::size_t(same - places.begin());
            if (same == places.end())
                places.push_back(at);
            places[index].pixel_rad = finest_pixel_rad(places[index].pixel_rad, compiled);
            const std::size_t own_ramp = views_.size();
            views_.push_back({&compiled, ViewRays(compiled, samples_), index, turns ? beside * scale : glm::dvec3(0), 0, 0,
                ViewShade(layout, compiled, ramps.empty() ? std::span<const float>() : ramps[own_ramp])});
        }
        if (input.scene.shadows)
            occluders_ = std::make_unique<Occluders>(input.world, input.world.instances);
        eyes_.reserve(places.size());
        for (const EyeAt& at : places)
            eyes_.emplace_back(input.world, input.scene, pictures_, colours_, globe_colours_.get(), occluders_.get(),
                starbow::observer_of(input.world, shot, at.observer), at.place, at.beside, at.pixel_rad);
        if (globe_colours_)
            for (ViewAt& view : views_) {
                view.globes = globes_.size();
                globes_.emplace_back(eyes_[view.eye], view.rays, view.compiled->view.size,
                    [&](const glm::dvec3& way) { return beside(view, way); });
            }
        else
            globes_.emplace_back();
        if (input.scene.stars && (!input.stars.empty() || globe_colours_))
            for (ViewAt& view : views_) {
                view.stars = stars_.size();
                stars_.emplace_back(
                    input.stars, *input.scene.stars, input.scene.unit_m, eyes_[view.eye], colours_,
                    [&](const glm::dvec3& way) { return beside(view, way); }, exposure_, globes_[view.globes].parts(),
                    globes_[view.globes].spots());
            }
    }

    /// Draws one row of the output into each canvas, and the numbers of the first. screens: empty where no viewports
    /// overlap.
    void row(
        int y, std::span<glm::dvec3* const> light, std::span<glm::dvec3* const> screens, Reference::Numbers* numbers) const
    {
        if (!screens.empty()) {
            for (std::size_t canvas = 0; canvas < light.size(); ++canvas)
                layered_row(y, int(canvas), light[canvas], screens[canvas], canvas == 0 ? numbers : nullptr);
            return;
        }
        for (const ViewAt& view : views_) {
            const View& own = view.compiled->view;
            const int inside = y - own.corner.y;
            if (inside < 0 || inside >= own.size.y)
                continue;
            const ViewRays::Row ways = view.rays.row(inside);
            for (int x = 0; x < own.size.x; ++x) {
                const std::size_t at = std::size_t(own.corner.x + x);
                const Pixel shown = pixel(view, ways, {x, inside});
                const glm::dvec3 glare = glare_at(view, ways, {x, inside}, shown.sun) * exposure_;
                light[std::size_t(own.canvas)][at] = shown.light * exposure_ + glare;
                if (own.canvas == 0 && numbers) {
                    numbers[at] = numbers_at(view, ways, x);
                    numbers[at].glare = glare;
                }
            }
        }
    }

private:
    /// The same for one canvas on which viewports overlap.
    void layered_row(int y, int canvas, glm::dvec3* light, glm::dvec3* screens, Reference::Numbers* numbers) const
    {
        struct ViewRow {
            const ViewAt* view;
            ViewRays::Row ways;
            int y;
        };
        std::vector<ViewRow> here;
        int width = 0;
        for (const ViewAt& view : views_) {
            const View& own = view.compiled->view;
            const int inside = y - own.corner.y;
            if (own.canvas != canvas || inside < 0 || inside >= own.size.y)
                continue;
            here.push_back({&view, view.rays.row(inside), inside});
            width = std::max(width, own.corner.x + own.size.x);
        }
        for (int x = 0; x < width; ++x) {
            std::vector<BlendLayer> coats;
            struct Light {
                const ViewRow* of;
                glm::dvec3 light, glare;
            };
            std::vector<Light> lights;
            for (const ViewRow& each : here) {
                const View& own = each.view->compiled->view;
                const glm::ivec2 at(x - own.corner.x, each.y);
                if (at.x < 0 || at.x >= own.size.x)
                    continue;
                const BlendLayer coat = coat_of(*each.view, each.ways, at);
                if (coat.order == nothing_shown)
                    continue;
                const Pixel shown = pixel(*each.view, each.ways, at);
                const glm::dvec3 glare = glare_at(*each.view, each.ways, at, shown.sun) * exposure_;
                lights.push_back({&each, shown.light * exposure_ + glare, glare});
                coats.push_back(coat);
                coats.back().screen
                    = tone_double::tone_map(glm::clamp(lights.back().light, glm::dvec3(0), glm::dvec3(1e30)));
            }
            if (coats.empty())
                continue;
            const BlendResult together = laid_over(coats, plain_);
            const auto& [of, foremost, glare] = lights[together.foremost];
            light[x] = foremost, screens[x] = together.screen;
            if (numbers) {
                numbers[x] = numbers_at(*of->view, of->ways, x - of->view->compiled->view.corner.x);
                numbers[x].glare = glare;
            }
        }
    }

    static constexpr int nothing_shown = std::numeric_limits<int>::min();

    /// A view's mask, brightness and order at one of its pixels; the order nothing_shown where it shows nothing.
    BlendLayer coat_of(const ViewAt& view, const ViewRays::Row& ways, const glm::ivec2& at) const
    {
        const View& own = view.compiled->view;
        BlendLayer coat;
        bool any = false;
        const glm::dvec3 mask = view.shade.mask(at.x, at.y);
        for (int c = 0; c < 3; ++c)
            if (ways.centre(at.x, view.rays.channels() == 3 ? c : 0))
                coat.mask[c] = mask[c], any = true;
        coat.brightness = view.shade.brightness(at.x, at.y);
        coat.order = any ? layout_.outputs[own.output].viewports[own.viewport].order : nothing_shown;
        return coat;
    }

    /// The eye's offset from its tracing eye's place, along a direction of the cockpit.
    glm::dvec3 beside(const ViewAt& view, const glm::dvec3& way) const
    {
        if (view.turning == glm::dvec3(0))
            return glm::dvec3(0);
        // The offset is level and to the right of the direction; within full_from_zenith_deg of the zenith it fades.
        const glm::dvec3 right = glm::cross(way, glm::dvec3(0, 1, 0));
        const double far = glm::length(view.turning) * (view.turning.x < 0 ? -1 : 1);
        return right * (far / std::max(glm::length(right), std::sin(layout_.stereo.full_from_zenith_deg * degree)));
    }

    /// A pixel's light without glare, and the part that is the Sun's disc.
    struct Pixel {
        glm::dvec3 light{0}, sun{0};
    };
    Pixel pixel(const ViewAt& view, const ViewRays::Row& ways, const glm::ivec2& at) const
    {
        const int channels = view.rays.channels();
        const TracingEye& eye = eyes_[view.eye];
        Pixel out;
        for (int channel = 0; channel < channels; ++channel) {
            if (!ways.centre(at.x, channel))
                continue; // nothing is shown there
            const double pixel_rad = globe_colours_ ? view.rays.pixel_rad(at, channel) : 0;
            glm::dvec3 sum(0), sun(0);
            int count = 0;
            for (std::size_t i = 0; i < samples_.size(); ++i)
                if (const auto way = ways.sample(at.x, i, channel)) {
                    const LookedAt seen = eye.look(*way, beside(view, *way), globes_[view.globes].parts(), pixel_rad);
                    sum += seen.light, sun += seen.sun;
                    ++count;
                }
            glm::dvec3 light = count > 0 ? sum / double(count) : glm::dvec3(0);
            if (count > 0)
                sun /= double(count);
            if (!stars_.empty())
                light += stars_[view.stars].light(view.rays, at, channel);
            if (channels == 3)
                out.light[channel] = light[channel], out.sun[channel] = sun[channel];
            else
                out = {light, sun};
        }
        return out;
    }

    /// The change by glare of a pixel's light. sun: as in Pixel.
    glm::dvec3 glare_at(const ViewAt& view, const ViewRays::Row& ways, const glm::ivec2& at, const glm::dvec3& sun) const
    {
        glm::dvec3 out(0);
        if (stars_.empty())
            return out;
        const int channels = view.rays.channels();
        for (int channel = 0; channel < channels; ++channel)
            if (ways.centre(at.x, channel)) {
                const glm::dvec3 glare = stars_[view.stars].glare(view.rays, at, channel)
                    + globes_[view.globes].glare(view.rays, at, channel, sun);
                if (channels == 3)
                    out[channel] = glare[channel];
                else
                    out = glare;
            }
        return out;
    }

    Reference::Numbers numbers_at(const ViewAt& view, const ViewRays::Row& ways, int x) const
    {
        const auto way = ways.centre(x, view.rays.channels() == 3 ? int(Channel::green) : 0);
        if (!way)
            return {};
        const TracingEye& eye = eyes_[view.eye];
        const LookedAt seen = eye.look(*way, beside(view, *way), globes_[view.globes].parts());
        const RestFrameView& rest_frame = eye.observer_of().rest_frames.front();
        const glm::dvec3 camera = glm::transpose(rest_frame.motion_from_frame) * (rest_frame.motion_from_cockpit * *way);
        const glm::dvec3& u = eye.observer_of().shot.u;
        const double speed = glm::length(u);
        const glm::dvec3 ahead = speed > 0 ? u / speed : glm::dvec3(0);
        const glm::dvec3 across = seen.world - ahead * glm::dot(ahead, seen.world);
        return {glm::normalize(camera), seen.world, across, seen.D, seen.distance, true};
    }

    const Layout& layout_;
    bool plain_;
    std::vector<glm::dvec2> samples_;
    Pictures pictures_;
    Colours colours_;
    std::unique_ptr<const GlobeColours> globe_colours_;
    std::unique_ptr<const Occluders> occluders_; ///< of a scene with shadows
    double exposure_;
    std::vector<ViewAt> views_;
    std::vector<TracingEye> eyes_;
    std::vector<StarSpots> stars_;
    std::vector<GlobeView> globes_;
};

std::string describe(const Shot& shot)
{
    std::ostringstream out;
    out.precision(17);
    out << shot.time << ' ' << shot.position.x << ' ' << shot.position.y << ' ' << shot.position.z << ' ' << shot.u.x << ' '
        << shot.u.y << ' ' << shot.u.z << ' ' << shot.ship_from_cockpit.w << ' ' << shot.ship_from_cockpit.x << ' '
        << shot.ship_from_cockpit.y << ' ' << shot.ship_from_cockpit.z << ' ';
    for (const EffectEntry& one : all_effects)
        out << shot.effects[one.which];
    out << int(shot.effects.comparison) << ' ' << shot.exposure_ev;
    return out.str();
}

void add_file(ContentHash& hash, const std::filesystem::path& file)
{
    RegularFile in(file);
    std::vector<char> bytes(1 << 16);
    while (const std::size_t got = in.read(bytes))
        hash.add(bytes.data(), got);
    hash.add(nullptr, 0); // the file's end
}

/// A sum of everything that rows depend on: the program, the files, and the data of the files that these name.
std::uint64_t sum_of(const ReferenceInput& input, const Layout& layout)
{
    ContentHash sum;
    for (const std::filesystem::path& file :
        {std::filesystem::path("/proc/self/exe"), layout.file, std::filesystem::path(input.scene.file), input.scene.gltf})
        add_file(sum, file);
    for (const Output& output : layout.outputs)
        for (const Viewport& viewport : output.viewports) {
            add_file(sum, viewport.alpha_mask);
            if (viewport.warp)
                add_file(sum, viewport.warp->file), add_file(sum, viewport.warp->frustum);
        }
    const World& world = input.world;
    sum.add(world.vertices.data(), world.vertices.size() * sizeof(Vertex));
    sum.add(world.vertex_maps.data(), world.vertex_maps.size() * sizeof(VertexMaps));
    sum.add(world.deforming.data(), world.deforming.size() * sizeof(glm::vec4));
    sum.add(world.indices.data(), world.indices.size() * sizeof(std::uint32_t));
    for (const Texture& texture : world.textures)
        sum.add(texture.rgba.data(), texture.rgba.size());
    if (world.globes) {
        add_file(sum, input.scene.globes->file);
        for (const Texture& map : world.globes->maps)
            sum.add(map.rgba.data(), map.rgba.size());
        sum.add(world.globes->sky.rgba.data(), world.globes->sky.rgba.size());
    }
    for (const Star& star : input.stars) {
        const double values[] = {star.direction.x, star.direction.y, star.direction.z, star.magnitude, star.temperature_K};
        sum.add(values, sizeof values);
    }
    return sum.value();
}

/// The key of a file of finished rows: everything that rows depend on.
std::string key_of(const ReferenceInput& input, const Layout& layout, const Shot& shot, std::size_t output, int samples)
{
    const glm::ivec2 size = layout.outputs[output].size;
    return "starbow rows " + std::to_string(sum_of(input, layout)) + ' ' + std::to_string(output) + ' '
        + std::to_string(size.x) + 'x' + std::to_string(size.y) + ' ' + std::to_string(samples) + ' ' + describe(shot);
}

/// The compiled views of a layout.
struct Views {
    std::vector<CompiledView> lit; ///< of all outputs that light screens; where they overlap they share their light
    std::vector<CompiledView> own; ///< of the output that is drawn
    std::vector<std::vector<float>> ramps; ///< of `lit`, or empty
    std::vector<std::vector<float>> own_ramps; ///< of `own`, or empty
};

Views compile_views(MapStore& store, const Layout& layout, std::size_t output)
{
    Views out;
    for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
        std::vector<CompiledView> views = compile_output(store, layout, i, layout.outputs[i].size);
        if (!layout.outputs[i].preview)
            out.lit.insert(out.lit.end(), views.begin(), views.end());
        if (i == output)
            out.own = std::move(views);
    }
    reject_empty(layout, out.lit);
    if (layout.blend.ramps)
        out.ramps = blend_ramps(layout, out.lit, layout.blend.power);
    for (std::size_t i = 0; i < out.ramps.size() && !layout.outputs[output].preview; ++i)
        if (out.lit[i].view.output == output)
            out.own_ramps.push_back(out.ramps[i]);
    return out;
}

/// The shade of each output; that of a preview is empty.
std::vector<Shade> shades_of(const Layout& layout, const Views& views)
{
    std::vector<Shade> shades(layout.outputs.size());
    for (std::size_t i = 0; i < layout.outputs.size(); ++i)
        if (!layout.outputs[i].preview)
            shades[i] = shade_of(layout, i, layout.outputs[i].size, views.lit, views.ramps);
    return shades;
}

/// A picture without light.
Reference dark(const Output& output, std::vector<Shade> shades, std::size_t index, bool numbers, bool overlapping)
{
    Reference out;
    out.size = output.size;
    out.packing = output.preview ? Packing::mono : output.packing;
    out.colour = output.colour;
    out.headroom = output.preview ? 1 : headroom(shades);
    out.shade = std::move(shades[index]);
    const std::size_t pixels = std::size_t(out.size.x) * std::size_t(out.size.y);
    out.light.assign(std::size_t(canvas_count(out.packing)), std::vector<glm::dvec3>(pixels, glm::dvec3(0)));
    if (overlapping)
        out.screens = out.light;
    if (numbers)
        out.numbers.resize(pixels);
    return out;
}

/// Bytes of one row in a file of finished rows.
std::size_t row_bytes(const Reference& out)
{
    return std::size_t(out.size.x)
        * ((out.light.size() + out.screens.size()) * sizeof(glm::dvec3)
            + (out.numbers.empty() ? 0 : sizeof(Reference::Numbers)));
}

/// Draws the rows of a picture in several threads, and takes those that are finished from their file.
class RowDrawing {
public:
    RowDrawing(const Picture_& picture, Reference& out, const ReferenceOptions& options, RowCache* kept)
        : picture_(picture)
        , out_(out)
        , options_(options)
        , kept_(kept)
        , done_(kept ? kept->count() : 0)
    {
    }

    /// Returns when all rows are drawn; rethrows the last problem of a row.
    void draw_all()
    {
        {
            std::vector<std::jthread> threads;
            for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
                threads.emplace_back([this] { draw_some(); });
            draw_some();
        }
        if (problem_)
            std::rethrow_exception(problem_);
    }

private:
    /// One row's memory in the picture.
    struct Row {
        std::vector<glm::dvec3*> light, screens; ///< by canvas
        Reference::Numbers* numbers; ///< null where none are wanted
    };

    Row row(int y) const
    {
        const std::size_t first = std::size_t(y) * std::size_t(out_.size.x);
        Row row{{}, {}, out_.numbers.empty() ? nullptr : &out_.numbers[first]};
        for (std::vector<glm::dvec3>& canvas : out_.light)
            row.light.push_back(&canvas[first]);
        for (std::vector<glm::dvec3>& canvas : out_.screens)
            row.screens.push_back(&canvas[first]);
        return row;
    }

    /// Calls copy(memory, bytes) for each part of a row, in their order in the file of finished rows.
    template <typename Copy> void each_part(const Row& row, Copy copy) const
    {
        const std::size_t width = std::size_t(out_.size.x);
        for (const auto& pictures : {row.light, row.screens})
            for (glm::dvec3* picture : pictures)
                copy(picture, width * sizeof(glm::dvec3));
        if (row.numbers)
            copy(row.numbers, width * sizeof(Reference::Numbers));
    }

    /// One thread's work: the next row, until none is left.
    void draw_some()
    {
        std::vector<std::byte> bytes(row_bytes(out_));
        for (int y = next_++; y < out_.size.y; y = next_++) {
            const Row to = row(y);
            if (const std::byte* from = kept_ ? kept_->row(y) : nullptr) {
                each_part(to, [&](void* part, std::size_t count) { std::memcpy(part, from, count), from += count; });
                continue;
            }
            try {
                picture_.row(y, to.light, to.screens, to.numbers);
                if (kept_) {
                    std::byte* at = bytes.data();
                    each_part(to, [&](const void* part, std::size_t count) { std::memcpy(at, part, count), at += count; });
                    kept_->put(y, bytes.data());
                }
                const std::scoped_lock lock(mutex_);
                ++done_;
                if (options_.progress)
                    options_.progress(done_, out_.size.y);
            } catch (...) {
                const std::scoped_lock lock(mutex_);
                problem_ = std::current_exception();
                next_ = out_.size.y;
            }
        }
    }

    const Picture_& picture_;
    Reference& out_;
    const ReferenceOptions& options_;
    RowCache* kept_;
    std::atomic<int> next_ = 0;
    std::mutex mutex_;
    int done_;
    std::exception_ptr problem_;
};

double tabled(const std::vector<glm::dvec3>& table, double light, int channel)
{
    const double at = light * double(table.size() - 1);
    const std::size_t i = std::min(std::size_t(at), table.size() - 2);
    return std::lerp(table[i][channel], table[i + 1][channel], at - double(i));
}

} // namespace

ReferenceWorld open_reference_world(const std::filesystem::path& file)
{
    ReferenceWorld opened{open_scene(file), {}, {}};
    opened.world = load_world(opened.scene);
    check_speeds(opened.world, opened.scene);
    place_bodies(opened.world, opened.scene);
    if (opened.scene.stars)
        opened.stars = stars_in_depth(*opened.scene.stars);
    return opened;
}

Reference reference(
    const ReferenceInput& input, const Layout& layout, const Shot& shot, std::size_t output, const ReferenceOptions& options)
{
    MapStore store{std::filesystem::path()};
    const Views views = compile_views(store, layout, output);
    const bool overlapping
        = std::any_of(views.own.begin(), views.own.end(), [](const CompiledView& view) { return view.view.layer > 0; });
    Reference out = dark(layout.outputs[output], shades_of(layout, views), output, options.numbers, overlapping);
    out.exposure = std::exp2(shot.exposure_ev);
    const Picture_ picture(input, layout, shot, views.own, views.own_ramps, layout.outputs[output].preview, options.samples);
    std::optional<RowCache> kept;
    if (!options.kept.empty())
        kept.emplace(options.kept, key_of(input, layout, shot, output, options.samples), row_bytes(out), out.size.y);
    RowDrawing(picture, out, options, kept ? &*kept : nullptr).draw_all();
    return out;
}

std::vector<std::uint8_t> shown(const Reference& r)
{
    const std::size_t count = std::size_t(r.size.x) * std::size_t(r.size.y);
    std::vector<std::uint8_t> bytes(4 * count, 255);
    const std::optional<Anaglyph> mixed = anaglyph(r.packing);
    const bool masked = !r.shade.empty() || r.headroom != 1;
    for (std::size_t i = 0; i < count; ++i) {
        auto screen = [&](std::size_t picture) {
            if (!r.screens.empty())
                return r.screens[picture][i];
            return tone_double::tone_map(glm::clamp(r.light[picture][i], glm::dvec3(0), glm::dvec3(1e30)));
        };
        const int x = int(i % std::size_t(r.size.x)), y = int(i / std::size_t(r.size.x));
        glm::dvec3 light;
        if (mixed) {
            light = r.colour.matrix * (mixed->left * screen(0) + mixed->right * screen(1));
        } else {
            const int second = r.packing == Packing::rows ? y & 1
                : r.packing == Packing::columns           ? x & 1
                : r.packing == Packing::checkerboard      ? (x + y) & 1
                                                          : 0;
            light = r.colour.matrix * screen(std::size_t(second));
        }
        light = glm::max(light, glm::dvec3(0));
        if (masked) {
            if (!r.shade.weight.empty())
                light *= glm::dvec3(r.shade.weight[i]);
            light *= r.headroom;
            if (!r.shade.black.empty())
                light += glm::dvec3(r.shade.black[i]);
        }
        light = glm::min(light, glm::dvec3(1));
        for (int c = 0; c < 3; ++c) {
            const double value = !r.colour.lut.empty() ? tabled(r.colour.lut, light[c], c)
                : r.colour.gamma != 0                  ? std::pow(light[c], 1 / r.colour.gamma)
                                                       : srgb_of_light(light[c]);
            bytes[4 * i + std::size_t(c)] = std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
        }
    }
    return bytes;
}

Channels channels(const Reference& r)
{
    const std::size_t count = r.numbers.size();
    Channels channels;
    for (const char* name : number_channels)
        channels.emplace_back(name, std::vector<float>(count, std::nanf("")));
    for (std::size_t i = 0; i < count; ++i) {
        const Reference::Numbers& n = r.numbers[i];
        if (!n.shown)
            continue;
        const glm::dvec3 light = glm::clamp((r.light[0][i] - n.glare) / r.exposure, glm::dvec3(-3e38), glm::dvec3(3e38));
        const double values[] = {light.r, light.g, light.b, n.camera.x, n.camera.y, n.camera.z, n.world.x, n.world.y,
            n.world.z, n.D, n.distance, n.across.x, n.across.y, n.across.z};
        for (std::size_t k = 0; k < number_channels.size(); ++k)
            channels[k].second[i] = float(values[k]);
    }
    return channels;
}

} // namespace starbow
