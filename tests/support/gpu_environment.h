#pragma once
// Shared by all tests that need a GPU: one device with the validation layers on for the whole run, worlds on it, and the
// channels of pictures by name.
#include "config/model/one_view.h"
#include "effects.h"
#include "files.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "shots.h"
#include "speeds.h"
#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace starbow::gpu_test {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

/// The avenue on a device with validation layers; it opens before the first test. Any message of the layers fails the run.
class GpuEnvironment : public ::testing::Environment {
public:
    void SetUp() override;
    void TearDown() override;
    static void expect_no_complaints(const Device& device);

    static inline std::unique_ptr<RenderContext> context;
};

inline RenderContext& avenue() { return *GpuEnvironment::context; }
inline Device& device() { return GpuEnvironment::context->device; }
inline Pipelines& pipelines() { return GpuEnvironment::context->pipelines; }

/// The avenue under an empty sky, as long as this object lives.
struct WithoutStars {
    WithoutStars();
    ~WithoutStars();
};

/// The quality in which tests measure shapes and numbers; their bounds belong to it. It has smooth edges and one ray a
/// pixel.
Quality test_quality();

OffscreenRenderer renderer(const GpuWorld& world, const Layout& layout, bool measured = true);

using starbow::testing::effects_of, starbow::testing::shot_at, starbow::testing::u_of_beta, starbow::testing::u_of_gamma;

/// One output's EXR channels by name.
struct Numbers {
    ivec2 size;
    Channels channels;

    Numbers(OffscreenRenderer& renderer, const Shot& shot, std::size_t output = 0)
        : size(renderer.layout().outputs[output].size)
        , channels(renderer.numbers(shot, output))
    {
    }
    const std::vector<float>& channel(const std::string& name) const;
    int count() const { return size.x * size.y; }
    dvec2 centre(int i) const { return {i % size.x + 0.5, i / size.x + 0.5}; }
    dvec3 light(int i) const { return {channels[0].second[i], channels[1].second[i], channels[2].second[i]}; }
    dvec3 camera(int i) const { return {channels[3].second[i], channels[4].second[i], channels[5].second[i]}; }
    dvec3 world(int i) const { return {channels[6].second[i], channels[7].second[i], channels[8].second[i]}; }
    double D(int i) const { return channels[9].second[i]; }
    double depth(int i) const { return channels[10].second[i]; }
    bool shown(int i) const { return !std::isnan(channels[9].second[i]); }
};

/// Angle between directions of any length, accurate for small angles.
inline double between(const dvec3& a, const dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

} // namespace starbow::gpu_test
