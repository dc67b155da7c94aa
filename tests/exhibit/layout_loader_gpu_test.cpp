// A changed layout is read and compiled beside the thread that draws. The loader itself needs no GPU.
#include "config/model/shipped.h"
#include "runtime/exhibit/layout_loader.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"

namespace starbow::layout_loader_gpu_test {
namespace {

using namespace starbow::testing;

/// A fisheye of so many pixels; its directions are a map. span: turns it into another map.
std::string fisheye(int pixels, int aperture_deg)
{
    const std::string size = std::to_string(pixels);
    return R"({ "outputs": [{ "name": "dome", "size": [)" + size + ", " + size + R"(],
        "viewports": [{ "projection": { "type": "fisheye", "aperture_deg": )"
        + std::to_string(aperture_deg) + R"( } }] }] })";
}

/// Plays the thread that draws until a result comes; returns it and the longest own time of one step.
std::pair<LayoutLoader::Result, double> await(LayoutLoader& loader, const LayoutLoader::Shown& shown)
{
    double longest_s = 0;
    std::optional<LayoutLoader::Result> result;
    const bool came = until([&] {
        longest_s = std::max(longest_s, own_seconds([&] {
            if (loader.changed())
                loader.load(shown);
            result = loader.result();
        }));
        return result.has_value();
    });
    EXPECT_TRUE(came) << "the loader has no result after a minute";
    return {std::move(result).value_or(""), longest_s};
}

TEST(LayoutLoaderTest, TheNewestChangeIsOfferedAndNoFrameWaits)
{
    setenv("STARBOW_CACHE", scratch("loader-cache").c_str(), 1);
    const auto file = write_text("loaded.json", fisheye(64, 180));
    const Layout first = load_layout(file);
    LayoutLoader loader(first);
    const LayoutLoader::Shown shown{.kept = first, .layout = first, .quality = {}, .sizes = {{96, 96}}, .has_stars = true};
    EXPECT_FALSE(loader.changed());

    write_text("loaded.json", fisheye(2500, 170));
    ASSERT_TRUE(until([&] { return loader.changed(); })) << "the changed file is not noticed after a minute";
    const auto began = std::chrono::steady_clock::now();
    const double began_work_s = processor_seconds();
    loader.load(shown);
    EXPECT_TRUE(until([&] { return processor_seconds() > began_work_s + 0.03; })) << "nothing is compiled";
    write_text("loaded.json", fisheye(2500, 160)); // while the one before is being compiled
    const auto [result, longest_s] = await(loader, shown);
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    ASSERT_TRUE(std::holds_alternative<LayoutLoader::Loaded>(result)) << std::get<std::string>(result);
    const auto& loaded = std::get<LayoutLoader::Loaded>(result);
    EXPECT_EQ(std::get<Fisheye>(loaded.layout.outputs[0].viewports[0].projection).aperture_deg, 160);
    EXPECT_EQ(loaded.prepared.sizes, std::vector{glm::ivec2(2500)}) << "the file's, for the output's size has changed";
    ASSERT_TRUE(loaded.prepared.parts.views[0][0].map);
    EXPECT_EQ(loaded.prepared.parts.inverses.size(), 1u);
    EXPECT_LT(longest_s, 0.2 * took_s) << took_s << " s for loading";

    // A wrong file, and then the right one again, drawn in the window's size.
    write_text("loaded.json", fisheye(2500, 1000));
    const auto refused = await(loader, shown).first;
    ASSERT_TRUE(std::holds_alternative<std::string>(refused));
    EXPECT_NE(std::get<std::string>(refused).find("aperture_deg: 1000"), std::string::npos)
        << std::get<std::string>(refused);
    write_text("loaded.json", fisheye(64, 150));
    const auto right = await(loader, shown).first;
    ASSERT_TRUE(std::holds_alternative<LayoutLoader::Loaded>(right)) << std::get<std::string>(right);
    EXPECT_EQ(std::get<LayoutLoader::Loaded>(right).prepared.sizes, std::vector{glm::ivec2(96)});
    unsetenv("STARBOW_CACHE");
}

} // namespace
} // namespace starbow::layout_loader_gpu_test
