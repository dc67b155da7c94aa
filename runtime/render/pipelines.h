#pragma once
#include "pipeline_layouts.h"
#include "resources.h"
#include "runtime/world/world.h"
#include "shaders/shared_structs.h"
#include <array>
#include <map>
#include <string_view>
#include <tuple>

namespace starbow {

/// Formats of the images between the passes.
constexpr vk::Format light_format = vk::Format::eR16G16B16A16Sfloat;
constexpr vk::Format depth_format = vk::Format::eD32Sfloat;
constexpr vk::Format exact_format = vk::Format::eR32G32B32A32Sfloat;
constexpr vk::Format words_format = vk::Format::eR32G32B32A32Uint;
constexpr vk::Format meter_format = vk::Format::eR32G32Sfloat; // luminance, solid angle
constexpr vk::Format map_format = vk::Format::eR32G32Uint; // a direction map's texel, packed
constexpr vk::Format inverse_format = vk::Format::eR32G32B32A32Uint; // InverseMap's cell

/// Formats of the images that a pass draws into at once. On the stack, because passes are looked up by them many times a
/// frame.
struct Formats {
    std::array<vk::Format, MAX_GROUPS + 1> list{};
    std::size_t count = 0;

    Formats() = default;
    Formats(std::initializer_list<vk::Format> formats)
    {
        for (vk::Format format : formats)
            push_back(format);
    }
    void push_back(vk::Format format) { list[count++] = format; }
    void pop_back() { list[--count] = {}; }
    std::size_t size() const { return count; }
    auto begin() const { return list.begin(); }
    auto end() const { return list.begin() + std::ptrdiff_t(count); }
    vk::Format& operator[](std::size_t i) { return list[i]; }
    vk::Format operator[](std::size_t i) const { return list[i]; }
    auto operator<=>(const Formats&) const = default;
};

/// Counts of the basis coefficients that represent light: constants of the passes that write and read the cube map.
struct CoefficientCounts {
    int reflected = 3, own = 0;
    bool with_alpha = false; ///< each image leaves its fourth number to the alpha of blended surfaces
    /// Formats of the images that hold them, one group of coefficients each.
    Formats formats(bool half_floats) const
    {
        const int all = reflected + own;
        Formats formats;
        for (int group = 0; group < GROUP_COUNT(all, with_alpha); ++group)
            formats.push_back(half_floats ? light_format : exact_format);
        if (!with_alpha && all > 4 && all % 4 == 1)
            formats[formats.size() - 1] = half_floats ? vk::Format::eR16Sfloat : vk::Format::eR32Sfloat;
        if (!with_alpha && all > 4 && all % 4 == 2)
            formats[formats.size() - 1] = half_floats ? vk::Format::eR16G16Sfloat : vk::Format::eR32G32Sfloat;
        return formats;
    }
    auto operator<=>(const CoefficientCounts&) const = default;
};

/// A material's variant of the cube pass: constant_ids of cube.frag.
struct SurfaceVariant {
    bool base_texture, emissive_texture, masked, unlit;
    int lights;
    CoefficientCounts coefficients{};
    int kinds = 1; ///< number of kinds of spectra that shine
    bool matrices = false; ///< otherwise the coefficients are the colour with ultraviolet and infrared
    bool clock = false;
    bool finite_existence = false; ///< tests existence intervals
    bool several_rest_frames = false; ///< the world has several rest frames
    bool lamps_move = false;
    bool cones = false; ///< some lamps shine in cones
    bool blink = false;
    bool moves = false; ///< animated
    bool deforms = false;
    bool unshifted = false; ///< light is stored as its colour at D = 1
    int shadows = 0; ///< constant_id 20 of cube.frag
    bool blended = false; ///< drawn over what is behind it, by its alpha
    bool mapped = false; ///< gloss, or maps with coordinates of their own; the following hold for it alone
    bool matt = false, roughness_map = false, normal_map = false, occlusion_map = false;
    Topology topology = Topology::triangles;
    auto operator<=>(const SurfaceVariant&) const = default;
};
/// A viewport's variant of the warp pass: constant_ids of view.glsl and received_light.glsl.
struct WarpVariant {
    bool map, aberration, doppler, headlight, mips;
    bool channels = false; ///< red, green and blue look different ways
    bool reproject = false, turning = false; ///< stereo from one cube map; by the azimuth
    bool stars = false; ///< added to the cube map's light
    bool linear = false; ///< exposed linear light, for the glow
    CoefficientCounts coefficients{};
    bool by_table = true; ///< otherwise the coefficients are the colour
    bool several_rest_frames = false; ///< something moves in the world
    bool galilean = false; ///< Galilean aberration
    int rays = 1; ///< along each side of a pixel
    bool single = false; ///< one image of the plan, ahead, shows all
    bool cut = false; ///< tiles may have several images
    int cube_samples = 1; ///< of each texel
    bool unaligned = false; ///< some cube map may have other axes than the motion's
    bool layered = false; ///< the exposure's samples count by the view's part of each pixel
    bool world_alone = false; ///< no body is seen in these pixels, of several rest frames
    bool milky_way = false; ///< of several rest frames: the sky has a panorama
    int globes = 0; ///< of the world
    int rest_frames = 1; ///< of the world, if something that moves is in view; MAX_REST_FRAMES: more than a few
    bool range = false; ///< through the curve that shows everything at once
    auto operator<=>(const WarpVariant&) const = default;
};

/// An output's variant of the finish pass: constant_ids of finish.frag.
struct FinishVariant {
    int combine = 0; ///< 0: one canvas; two by rows: 1, columns: 2, checkerboard: 3, added: 4
    bool masked = false;
    int curve = 0; ///< 0 sRGB, 1 gamma, 2 table
    bool dithered = true;
    auto operator<=>(const FinishVariant&) const = default;
};

/// The images that a pass draws into.
struct TargetKind {
    Formats colours;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    auto operator<=>(const TargetKind&) const = default;
};

/// The specialization constants of a pass; constant_id is the index. On the stack, as Formats.
struct SpecializationConstants {
    std::array<std::uint32_t, 28> list{};
    std::size_t count = 0;

    SpecializationConstants() = default;
    template <class... Values>
    requires(std::is_convertible_v<Values, std::uint32_t>&&...) SpecializationConstants(Values... values)
        : list{std::uint32_t(values)...}
        , count(sizeof...(values))
    {
    }
    std::uint32_t& operator[](std::size_t i) { return list[i]; }
    auto operator<=>(const SpecializationConstants&) const = default;
};

/// Pipelines that stay although no frame uses them. On lavapipe one takes 3 MB, and 0.05 s to make again from the driver's
/// cache; a flight uses about ten at a time, a visit with all switches a hundred. On a GPU they are small, and the warm-up
/// makes some hundreds.
constexpr std::size_t most_pipelines_in_software = 128, most_pipelines = 1024;

/// Every pipeline of the program, each made at its first use. The caller of a pipeline records it at once and does not keep
/// it: see release_old.
class Pipelines {
public:
    explicit Pipelines(Device& device);

    vk::Pipeline surface(const SurfaceVariant& variant, const TargetKind& target);
    vk::Pipeline sky(bool milky_way, const TargetKind& target);
    vk::Pipeline warp(const WarpVariant& variant, vk::Format target);
    /// The stars of a view's pixels at which no light of the cube map shows.
    vk::Pipeline dark(const WarpVariant& variant, vk::Format target);
    vk::Pipeline stars(const WarpVariant& variant, vk::Format target);
    vk::Pipeline measure(const WarpVariant& variant);
    vk::Pipeline probe(const WarpVariant& variant);
    /// overlay: OVERLAY_ of shared.h.
    vk::Pipeline overlay(const WarpVariant& variant, int overlay, vk::Format target);
    vk::Pipeline mip(vk::Format target); ///< MipChain's
    vk::Pipeline compress(bool colours); ///< compressed()'s
    vk::Pipeline meter(const WarpVariant& variant);
    vk::Pipeline star_meter(const WarpVariant& variant);
    /// first: from the light itself.
    vk::Pipeline bloom(bool up, bool first);
    /// range: the light went through the curve that shows everything at once.
    vk::Pipeline bloomed(bool range, vk::Format target);
    /// scale: with the colours of a scale beside its letters.
    vk::Pipeline hud(bool map, vk::Format target, bool scale = false, bool light = false);
    vk::Pipeline lookup(vk::Format target);
    vk::Pipeline scaled(vk::Format target); ///< ScaledPicture's
    /// plain: by the viewports' parts alone.
    vk::Pipeline layer(bool plain);
    vk::Pipeline finish(const FinishVariant& variant, vk::Format target);
    vk::Pipeline fade(vk::Format target);
    vk::Pipeline vignette(bool map, vk::Format target);
    vk::Pipeline pattern(bool map, int pattern, vk::Format target);

    /// The number of pipelines made so far. It grows when a recorded pass needs a new one.
    std::size_t count() const { return count_; }
    std::size_t kept() const { return made_.size(); }
    /// Releases the pipelines beyond `most` that were not used for longest, none of those that were used since the last
    /// call. Call it once a frame, when the device has finished all that was recorded.
    void release_old(std::size_t most);

    const PipelineLayouts layouts;

private:
    struct Pass;
    vk::Pipeline find_or_make(const Pass& pass);
    vk::raii::Pipeline make(const Pass& pass) const;

    /// A pipeline's shaders by their name, its specialization constants and its targets tell it from all others.
    using Key = std::tuple<std::string_view, SpecializationConstants, TargetKind>;
    Device& device_;
    struct Made {
        vk::raii::Pipeline pipeline;
        std::uint64_t used; ///< turn of the last use
    };
    std::map<Key, Made> made_;
    std::size_t count_ = 0;
    std::uint64_t turn_ = 0; ///< calls of release_old
};

} // namespace starbow
