#pragma once
#include "pipeline_layouts.h"
#include "resources.h"
#include "runtime/world/world.h"
#include "shaders/constants.h"
#include "shaders/shared_structs.h"
#include <array>
#include <compare>
#include <cstring>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

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

// The specialization constants of shaders/constants.h: their ids, and structs with a member for each of a list.
#define STARBOW_ID(id, type, NAME, member, usual) member = id,
#define STARBOW_MEMBER(id, type, NAME, member, usual) type member = usual;

enum class Constant : std::uint32_t {
    COEFFICIENT_CONSTANTS(STARBOW_ID) SURFACE_CONSTANTS(STARBOW_ID) VIEW_CONSTANTS_ALONE(STARBOW_ID)
        PASS_CONSTANTS(STARBOW_ID)
};

/// Counts of the basis coefficients that represent light, of the passes that write and read the cube map. with_alpha: each
/// image leaves its fourth number to the alpha of blended surfaces.
struct CoefficientCounts {
    COEFFICIENT_CONSTANTS(STARBOW_MEMBER)
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

/// A material's variant of the cube pass.
struct SurfaceVariant {
    SURFACE_CONSTANTS(STARBOW_MEMBER)
    CoefficientCounts coefficients{};
    Topology topology = Topology::triangles;
    bool mapped = false; ///< gloss, or maps with coordinates of their own: the constants of gloss hold for it alone
    auto operator<=>(const SurfaceVariant&) const = default;
};

/// A view's variant of the passes that read the cube map.
struct WarpVariant {
    VIEW_CONSTANTS(STARBOW_MEMBER)
    CoefficientCounts coefficients{};
    auto operator<=>(const WarpVariant&) const = default;
};

/// An output's variant of the finish pass. dithered: its target has 8 bits a number.
struct FinishVariant {
    DITHER_CONSTANTS(STARBOW_MEMBER)
    FINISH_CONSTANTS(STARBOW_MEMBER)
    auto operator<=>(const FinishVariant&) const = default;
};

#undef STARBOW_ID
#undef STARBOW_MEMBER

/// The images that a pass draws into.
struct TargetKind {
    Formats colours;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    auto operator<=>(const TargetKind&) const = default;
};

/// The values of a pipeline's specialization constants. On the stack, as Formats.
struct SpecializationConstants {
    struct Value {
        Constant constant{};
        std::int32_t value = 0; ///< of a bool 0 or 1

        Value() = default;
        Value(Constant given, std::int32_t its_value)
            : constant(given)
            , value(its_value)
        {
        }
    };
    std::array<Value, 32> list{};
    std::size_t count = 0;

    SpecializationConstants() = default;
    SpecializationConstants(std::initializer_list<Value> values)
    {
        for (const Value& value : values)
            list.at(count++) = value;
    }
    /// Adds one that they do not have yet.
    SpecializationConstants& add(Constant constant, std::int32_t value)
    {
        list.at(count++) = {constant, value};
        return *this;
    }
    // In any order, but fast: each draw looks its pipeline up.
    std::strong_ordering operator<=>(const SpecializationConstants& other) const
    {
        return std::memcmp(list.data(), other.list.data(), sizeof list) <=> 0;
    }
    bool operator==(const SpecializationConstants& other) const { return *this <=> other == 0; }
};

/// A pass's way to combine its light with that in its target: none replaces it, over covers it by alpha, premultiplied, add
/// adds to it.
enum class Blending { none, over, add };

/// One pass's pipeline, on any device. What is not its name, its constants or its target is the same in every pipeline of
/// that name.
struct PipelinePass {
    const char* name; ///< also for debuggers
    std::span<const std::uint32_t> vertex, fragment; ///< SPIR-V
    vk::raii::PipelineLayout PipelineLayouts::*layout;
    TargetKind target;
    SpecializationConstants constants{}; ///< the same in both stages
    bool depth = false, vertices = false, maps = false; ///< maps: beside the vertices, VertexMaps
    Topology topology = Topology::triangles;
    Blending blending = Blending::none;
};

/// A pass's name for tables: "warp".
inline std::string table_name(const PipelinePass& pass)
{
    const std::string_view name(pass.name);
    return std::string(name.substr(0, name.rfind(" pipeline")));
}

/// The constants of a pass that are not 0, by their names in the code, and its target: one text for each pipeline of a name.
std::string describe(const PipelinePass& pass);

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

    /// All pipelines that are kept.
    std::vector<std::pair<PipelinePass, vk::Pipeline>> made() const;
    /// The pipeline of a described pass. The description may come from another device's made().
    vk::Pipeline find_or_make(const PipelinePass& pass);

    const PipelineLayouts layouts;

private:
    vk::raii::Pipeline make(const PipelinePass& pass) const;

    /// A pipeline's shaders by their name, its specialization constants and its targets tell it from all others.
    using Key = std::tuple<std::string_view, SpecializationConstants, TargetKind>;
    Device& device_;
    struct Made {
        PipelinePass pass;
        vk::raii::Pipeline pipeline;
        std::uint64_t used; ///< turn of the last use
    };
    std::map<Key, Made> made_;
    std::size_t count_ = 0;
    std::uint64_t turn_ = 0; ///< calls of release_old
};

} // namespace starbow
