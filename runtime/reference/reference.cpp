#include "reference.h"
#include "config/model/angles.h"
#include "displays/finish/anaglyph.h"
#include "displays/finish/blend.h"
#include "kept_rows.h"
#include "runtime/light/colour.h"
#include "runtime/light/srgb.h"
#include "runtime/world/moving.h"
#include "runtime/world/worldline.h"
#include "star_spots.h"
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#define FN inline
namespace starbow::tone {
using namespace glm;
using real = double;
using rvec3 = glm::dvec3;
#include "shaders/tone.glsl"
} // namespace starbow::tone
#undef FN

namespace starbow {
namespace {

/// One view and the eye that looks through it.
struct ViewAt {
    const CompiledView* compiled;
    ViewRays rays;
    std::size_t eye;
    glm::dvec3 turning{0}; ///< not 0: the eye's offset from the head's middle where its baseline turns, cockpit, scene
                           ///< units
    std::size_t stars = 0;
};

struct EyeAt {
    ViewportObserver observer;
    glm::dvec3 place; ///< cockpit, scene units
    double beside;
};

class Picture_ {
public:
    Picture_(const ReferenceInput& input, const Layout& layout, const Shot& shot, std::span<const CompiledView> views,
        int samples)
        : layout_(layout)
        , samples_(sample_places(samples))
        , pictures_(input.world)
        , colours_(input.world, input.scene, shot.effects.false_colours ? false_colours() : eye())
        , exposure_(std::exp2(shot.exposure_ev))
    {
        const double scale = layout.stereo.hyper_stereo / input.scene.unit_m;
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
            views_.push_back({&compiled, ViewRays(compiled, samples_), index, turns ? beside * scale : glm::dvec3(0)});
        }
        eyes_.reserve(places.size());
        for (const EyeAt& at : places)
            eyes_.emplace_back(input.world, input.scene, pictures_, colours_,
                starbow::observer_of(input.world, shot, at.observer), at.place, at.beside);
        if (input.scene.stars && !input.stars.empty())
            for (ViewAt& view : views_) {
                view.stars = stars_.size();
                stars_.emplace_back(input.stars, *input.scene.stars, eyes_[view.eye], colours_,
                    [&](const glm::dvec3& way) { return beside(view, way); });
            }
    }

    /// Draws one row of the output into each layer's picture, and the numbers of the first.
    void row(int y, std::span<glm::dvec3* const> light, Reference::Numbers* numbers) const
    {
        for (const ViewAt& view : views_) {
            const View& own = view.compiled->view;
            const int inside = y - own.corner.y;
            if (inside < 0 || inside >= own.size.y)
                continue;
            const ViewRays::Row ways = view.rays.row(inside);
            for (int x = 0; x < own.size.x; ++x) {
                const std::size_t at = std::size_t(own.corner.x + x);
                light[std::size_t(own.canvas)][at] = pixel(view, ways, {x, inside}) * exposure_;
                if (own.canvas == 0 && numbers)
                    numbers[at] = numbers_at(view, ways, x);
            }
        }
    }

private:
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

    glm::dvec3 pixel(const ViewAt& view, const ViewRays::Row& ways, const glm::ivec2& at) const
    {
        const int channels = view.rays.channels();
        const TracingEye& eye = eyes_[view.eye];
        glm::dvec3 out(0);
        for (int channel = 0; channel < channels; ++channel) {
            if (!ways.centre(at.x, channel))
                continue; // nothing is shown there
            glm::dvec3 sum(0);
            int count = 0;
            for (std::size_t i = 0; i < samples_.size(); ++i)
                if (const auto way = ways.sample(at.x, i, channel)) {
                    sum += eye.look(*way, beside(view, *way)).light;
                    ++count;
                }
            glm::dvec3 light = count > 0 ? sum / double(count) : glm::dvec3(0);
            if (!stars_.empty())
                light += stars_[view.stars].light(view.rays, at, channel);
            if (channels == 3)
                out[channel] = light[channel];
            else
                out = light;
        }
        return out;
    }

    Reference::Numbers numbers_at(const ViewAt& view, const ViewRays::Row& ways, int x) const
    {
        const auto way = ways.centre(x, view.rays.channels() == 3 ? int(Channel::green) : 0);
        if (!way)
            return {};
        const TracingEye& eye = eyes_[view.eye];
        const LookedAt seen = eye.look(*way, beside(view, *way));
        const RestFrameView& layer = eye.observer_of().layers.front();
        const glm::dvec3 camera = glm::transpose(layer.motion_from_frame) * (layer.motion_from_cockpit * *way);
        return {glm::normalize(camera), seen.world, seen.D, seen.distance, true};
    }

    const Layout& layout_;
    std::vector<glm::dvec2> samples_;
    Pictures pictures_;
    Colours colours_;
    double exposure_;
    std::vector<ViewAt> views_;
    std::vector<TracingEye> eyes_;
    std::vector<StarSpots> stars_;
};

std::string describe(const Shot& shot)
{
    std::ostringstream out;
    out.precision(17);
    out << shot.time << ' ' << shot.position.x << ' ' << shot.position.y << ' ' << shot.position.z << ' ' << shot.u.x << ' '
        << shot.u.y << ' ' << shot.u.z << ' ' << shot.ship_from_cockpit.w << ' ' << shot.ship_from_cockpit.x << ' '
        << shot.ship_from_cockpit.y << ' ' << shot.ship_from_cockpit.z << ' ' << shot.effects.aberration
        << shot.effects.doppler << shot.effects.headlight << int(shot.effects.comparison) << shot.effects.false_colours
        << ' ' << shot.exposure_ev;
    return out.str();
}

/// A sum of bytes, FNV-1a by eights.
class Sum {
public:
    void add(const void* bytes, std::size_t count)
    {
        for (std::size_t i = 0; i < count; i += 8) {
            std::uint64_t value = 0;
            std::memcpy(&value, static_cast<const char*>(bytes) + i, std::min<std::size_t>(8, count - i));
            take(value);
        }
        take(count);
    }
    void add(const std::filesystem::path& file)
    {
        std::ifstream in(file, std::ios::binary);
        std::vector<char> bytes(1 << 16);
        while (in.read(bytes.data(), std::streamsize(bytes.size())), in.gcount() > 0)
            add(bytes.data(), std::size_t(in.gcount()));
        take(~std::uint64_t(0));
    }
    std::uint64_t value() const { return sum_; }

private:
    void take(std::uint64_t value) { sum_ = std::rotl((sum_ ^ value) * 0x100000001b3, 29); }
    std::uint64_t sum_ = 0xcbf29ce484222325;
};

/// A sum of everything that rows depend on: the program, the files, and the data of the files that these name.
std::uint64_t sum_of(const ReferenceInput& input, const Layout& layout)
{
    Sum sum;
    for (const std::filesystem::path& file :
        {std::filesystem::path("/proc/self/exe"), layout.file, std::filesystem::path(input.scene.file), input.scene.gltf})
        sum.add(file);
    for (const Output& output : layout.outputs)
        for (const Viewport& viewport : output.viewports)
            if (viewport.warp)
                sum.add(viewport.warp->file), sum.add(viewport.warp->frustum);
    const World& world = input.world;
    sum.add(world.vertices.data(), world.vertices.size() * sizeof(Vertex));
    sum.add(world.indices.data(), world.indices.size() * sizeof(std::uint32_t));
    for (const Texture& texture : world.textures)
        sum.add(texture.rgba.data(), texture.rgba.size());
    for (const Star& star : input.stars) {
        const double values[] = {star.direction.x, star.direction.y, star.direction.z, star.magnitude, star.temperature_K};
        sum.add(values, sizeof values);
    }
    return sum.value();
}

double tabled(const std::vector<glm::dvec3>& table, double light, int channel)
{
    const double at = light * double(table.size() - 1);
    const std::size_t i = std::min(std::size_t(at), table.size() - 2);
    return std::lerp(table[i][channel], table[i + 1][channel], at - double(i));
}

} // namespace

ReferenceWorld open_reference_world(const std::filesystem::path& file)
{
    ReferenceWorld opened{load_scene_file(file), {}, {}};
    opened.world = load_world(opened.scene.gltf);
    check_speeds(opened.world, opened.scene);
    place_bodies(opened.world, opened.scene);
    if (opened.scene.stars)
        opened.stars = load_stars(opened.scene.stars->catalogue);
    return opened;
}

Reference reference(
    const ReferenceInput& input, const Layout& layout, const Shot& shot, std::size_t output, const ReferenceOptions& options)
{
    // All views of all outputs: where they overlap their light is shared.
    MapStore store{std::filesystem::path()};
    std::vector<CompiledView> lit, own;
    for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
        std::vector<CompiledView> views = compile_output(store, layout, i, layout.outputs[i].size);
        if (!layout.outputs[i].preview)
            lit.insert(lit.end(), views.begin(), views.end());
        if (i == output)
            own = std::move(views);
    }
    reject_empty(layout, lit);
    std::vector<std::vector<float>> ramps;
    if (layout.blend.ramps)
        ramps = blend_ramps(layout, lit, layout.blend.power);
    std::vector<Shade> shades(layout.outputs.size());
    for (std::size_t i = 0; i < layout.outputs.size(); ++i)
        if (!layout.outputs[i].preview)
            shades[i] = shade_of(layout, i, layout.outputs[i].size, lit, ramps);

    const Output& of = layout.outputs[output];
    Reference out;
    out.size = of.size;
    out.exposure = std::exp2(shot.exposure_ev);
    out.packing = of.preview ? Packing::mono : of.packing;
    out.colour = of.colour;
    out.headroom = of.preview ? 1 : headroom(shades);
    out.shade = std::move(shades[output]);
    const std::size_t width = std::size_t(of.size.x), rows = std::size_t(of.size.y);
    out.light.assign(std::size_t(canvas_count(out.packing)), std::vector<glm::dvec3>(width * rows, glm::dvec3(0)));
    if (options.numbers)
        out.numbers.resize(width * rows);

    const Picture_ picture(input, layout, shot, own, options.samples);
    const std::size_t light_bytes = width * sizeof(glm::dvec3),
                      numbers_bytes = options.numbers ? width * sizeof(Reference::Numbers) : 0;
    const std::size_t row_bytes = out.light.size() * light_bytes + numbers_bytes;
    std::optional<KeptRows> kept;
    if (!options.kept.empty())
        kept.emplace(options.kept,
            "starbow rows " + std::to_string(sum_of(input, layout)) + ' ' + std::to_string(output) + ' '
                + std::to_string(width) + 'x' + std::to_string(rows) + ' ' + std::to_string(options.samples) + ' '
                + describe(shot),
            row_bytes, int(rows));
    std::atomic<int> next = 0;
    int done = kept ? kept->count() : 0;
    std::mutex mutex;
    std::exception_ptr problem;
    auto work = [&] {
        std::vector<std::byte> bytes(row_bytes);
        std::vector<glm::dvec3*> light(out.light.size());
        for (int y = next++; y < int(rows); y = next++) {
            const std::size_t first = std::size_t(y) * width;
            for (std::size_t i = 0; i < light.size(); ++i)
                light[i] = &out.light[i][first];
            Reference::Numbers* numbers = options.numbers ? &out.numbers[first] : nullptr;
            if (const std::byte* from = kept ? kept->row(y) : nullptr) {
                for (glm::dvec3* one : light)
                    std::memcpy(one, from, light_bytes), from += light_bytes;
                if (numbers)
                    std::memcpy(numbers, from, numbers_bytes);
                continue;
            }
            try {
                picture.row(y, light, numbers);
                if (kept) {
                    std::byte* to = bytes.data();
                    for (const glm::dvec3* one : light)
                        std::memcpy(to, one, light_bytes), to += light_bytes;
                    if (numbers)
                        std::memcpy(to, numbers, numbers_bytes);
                    kept->put(y, bytes.data());
                }
                const std::scoped_lock lock(mutex);
                ++done;
                if (options.progress)
                    options.progress(done, int(rows));
            } catch (...) {
                const std::scoped_lock lock(mutex);
                problem = std::current_exception();
                next = int(rows);
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
            threads.emplace_back(work);
        work();
    }
    if (problem)
        std::rethrow_exception(problem);
    return out;
}

std::vector<std::uint8_t> shown(const Reference& r)
{
    const std::size_t count = std::size_t(r.size.x) * std::size_t(r.size.y);
    std::vector<std::uint8_t> bytes(4 * count, 255);
    const std::optional<Anaglyph> mixed = anaglyph(r.packing);
    const bool masked = !r.shade.empty() || r.headroom != 1;
    for (std::size_t i = 0; i < count; ++i) {
        auto screen = [&](std::size_t layer) {
            return tone::tone_map(glm::clamp(r.light[layer][i], glm::dvec3(0), glm::dvec3(1e30)));
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
    const char* names[] = {"R", "G", "B", "cameraDirection.X", "cameraDirection.Y", "cameraDirection.Z", "worldDirection.X",
        "worldDirection.Y", "worldDirection.Z", "doppler", "depth"};
    const std::size_t count = r.numbers.size();
    Channels channels;
    for (const char* name : names)
        channels.emplace_back(name, std::vector<float>(count, std::nanf("")));
    for (std::size_t i = 0; i < count; ++i) {
        const Reference::Numbers& n = r.numbers[i];
        if (!n.shown)
            continue;
        const glm::dvec3 light = glm::clamp(r.light[0][i] / r.exposure, glm::dvec3(-3e38), glm::dvec3(3e38));
        const double values[] = {
            light.r, light.g, light.b, n.camera.x, n.camera.y, n.camera.z, n.world.x, n.world.y, n.world.z, n.D, n.distance};
        for (std::size_t k = 0; k < 11; ++k)
            channels[k].second[i] = float(values[k]);
    }
    return channels;
}

} // namespace starbow
