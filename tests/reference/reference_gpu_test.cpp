// The live picture compared with the reference, which uses neither the cube map nor the warp pass: finer and finer cube
// maps, and worlds with bodies, clocks and a line. every_world_gpu_test.cpp has every world and every layout.
#include "live_and_rays.h"
#include "runtime/world/open_scene.h"
#include "tests/support/beside_rays.h"

namespace reference_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;

TEST(LivePicture, ComesCloserToTheReferenceWithHigherQuality)
{
    const Shot shot = shipped_shot("avenue-gamma4");
    for (const char* name : {"desk", "dome"}) {
        const Layout layout = starbow::testing::small_shipped_layout(name, 160);
        const Bytes truth = shown(reference(avenue_by_rays().input(), layout, shot, 0, {.samples = 128}));
        double before = 0;
        for (double texels : {0.5, 1.0, 2.0, 4.0}) {
            Quality quality = test_quality();
            quality.texels_per_pixel = texels, quality.max_texels_per_pixel = 200;
            OffscreenRenderer live(device(), pipelines(), avenue().world, layout, quality, false);
            const double now = psnr(live.picture(shot)[0], truth);
            std::printf("%s: %.1f texels a pixel: %.2f dB\n", name, texels, now);
            // From two texels on, the reference's noise and the cube map's four samples in a texel remain.
            EXPECT_GT(now, texels > 2 ? before - 0.3 : before + 2) << name << ", " << texels << " texels a pixel";
            before = now;
        }
        // Edges are left, those of bright columns before a black sky most of all.
        EXPECT_GT(before, 36) << name;
    }
}

TEST(LivePicture, EqualsTheReferenceWithBodiesAndALine)
{
    for (const RayCase& one : {RayCase{"alice-and-bob", 30}, {"rainbow-line", 30}})
        expect_live_equals_rays(one);
}

// A file that nobody here made stands on a ground of darker and brighter tiles, whose colours only their corners have.
TEST(LivePicture, AnOpenedFileStandsOnItsTiles)
{
    Doc doc;
    const int mesh = blobs(doc, {{{-0.6, 0, 0}, {0.9, 0.2, 0.1}}, {{0.6, 0, 0}, {0.1, 0.3, 0.9}}}, 0.5);
    Json& places = doc.json["accessors"][doc.json["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"].get<int>()];
    places["min"] = {-1.1, -0.5, -0.5}, places["max"] = {1.1, 0.5, 0.5};
    doc.json["scenes"][0]["nodes"].push_back(doc.put("nodes", {{"mesh", mesh}}));
    const auto file = starbow::testing::write_text("opened.gltf", doc.text());
    const Shot shot = open_scene(file).start;
    const BesideRays off = beside_rays(file, one_view(Planar{}, {160, 120}), shot, 16, true, 0.01);
    ASSERT_GT(off.light_off.size(), 5000u);
    // Tiles differ by 14 %. Far tiles are smaller than a pixel, and some pixels hold an edge.
    EXPECT_LT(off.light_off[off.light_off.size() * 7 / 10], 0.01);
    std::printf("an opened file: %.1f dB, light off by %.4f in the middle, %.4f at 9 of 10\n", off.db,
        off.light_off[off.light_off.size() / 2], off.light_off[off.light_off.size() * 9 / 10]);
}

} // namespace reference_gpu_test
