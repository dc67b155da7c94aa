#pragma once
// A small world's live picture beside the reference.
#include "runtime/images/picture_errors.h"
#include "runtime/reference/reference.h"
#include "small_world.h"
#include <algorithm>

namespace starbow::gpu_test {

/// The difference between the live picture and the reference.
struct BesideRays {
    double db = 0; ///< PSNR of the shown pictures
    std::vector<double> light_off; ///< by pixel, rising: the light's difference over the light
};

/// Draws a scene's file. surfaces: light_off has no pixels of the sky. least: light below it counts as that much.
inline BesideRays beside_rays(
    const std::filesystem::path& file, const Layout& layout, const Shot& shot, int samples, bool surfaces, double least)
{
    const ReferenceWorld world = open_reference_world(file);
    const GpuWorld gpu = upload(device(), pipelines(), load_world(world.scene), world.scene);
    OffscreenRenderer live = renderer(gpu, layout, true);
    const auto picture = live.picture(shot)[0];
    const Reference truth = reference(world.input(), layout, shot, 0, {.samples = samples});
    BesideRays out;
    out.db = psnr_dB({layout.outputs[0].size, picture}, {layout.outputs[0].size, shown(truth)});
    const Numbers numbers(live, shot);
    for (int i = 0; i < numbers.count(); ++i) {
        if (surfaces && std::isinf(numbers.depth(i)))
            continue;
        const dvec3 rays = truth.light[0][std::size_t(i)] / truth.exposure;
        out.light_off.push_back(glm::length(numbers.light(i) - rays) / std::max(glm::length(rays), least));
    }
    std::sort(out.light_off.begin(), out.light_off.end());
    return out;
}

/// The same of a document's world. scene: its scene file's members without gltf and unit_m: a unit is a light-second.
inline BesideRays beside_rays(
    const Doc& doc, Json scene, const Layout& layout, const Shot& shot, int samples, bool surfaces, double least)
{
    testing::write_text("inset.gltf", doc.text());
    scene["gltf"] = "inset.gltf";
    scene["unit_m"] = 299792458;
    return beside_rays(testing::write_text("inset.json", scene.dump()), layout, shot, samples, surfaces, least);
}

} // namespace starbow::gpu_test
