// Quality files and ladders: the shipped ones, each member, and wrong files. The editors' schema must agree with the reader.
#include "config/json/error.h"
#include "config/model/quality.h"
#include "config/model/shipped.h"
#include "tests/support/files.h"
#include "tests/support/schema_check.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace quality_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

json schema_json() { return json::parse(read_text(source_dir() / "config/schema/quality.schema.json")); }

bool schema_accepts(const json& quality) { return starbow::testing::schema_accepts("quality", quality); }

template <class Load> std::string message_of(Load&& load)
{
    try {
        load();
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

const char* const all_members
    = R"({ "texels_per_pixel": 1.5, "max_texels_per_pixel": 2.5, "cube_samples": 8, "lod_error_texels": 0.5, "lod_shading_texels": 8, "image_cost_texels": 5000,
    "pixel_rays": 3, "clip_levels": 7, "mips": false, "half_floats": false, "matrices": false, "frames_per_cube": 4,
    "spectra": "fine", "stereo": "reprojected" })";

} // namespace

TEST(QualityTest, ShippedQualitiesAreRead)
{
    for (const char* name : {"draft", "balanced", "fine"}) {
        SCOPED_TRACE(name);
        const auto file = shipped_file("qualities", name);
        EXPECT_TRUE(schema_accepts(json::parse(read_text(file), nullptr, true, true)));
        EXPECT_NO_THROW(load_quality(file));
    }
    const std::vector<PresetLevel> ladder = load_ladder(shipped_file("qualities", "ladder"));
    EXPECT_GE(ladder.size(), 3u);
}

TEST(QualityTest, EveryMemberIsReadAndWrittenAgain)
{
    EXPECT_TRUE(schema_accepts(json::parse(all_members)));
    const Quality q = load_quality(write_text("quality.json", all_members));
    EXPECT_EQ(q.texels_per_pixel, 1.5);
    EXPECT_EQ(q.max_texels_per_pixel, 2.5);
    EXPECT_EQ(q.cube_samples, 8);
    EXPECT_EQ(q.lod_error_texels, 0.5);
    EXPECT_EQ(q.lod_shading_texels, 8);
    EXPECT_EQ(q.image_cost_texels, 5000);
    EXPECT_EQ(q.pixel_rays, 3);
    EXPECT_EQ(q.clip_levels, 7);
    EXPECT_FALSE(q.mips || q.half_floats || q.matrices);
    EXPECT_EQ(q.frames_per_cube, 4);
    EXPECT_EQ(q.spectra, SpectralLevel::fine);
    EXPECT_EQ(q.stereo, StereoMethod::reprojected);
    EXPECT_TRUE(schema_accepts(json::parse(quality_text(q))));
    EXPECT_EQ(load_quality(write_text("again.json", quality_text(q))), q);
    // Each member alone makes a difference, and is listed as one.
    const json members = json::parse(all_members);
    for (const auto& [name, value] : members.items()) {
        const Quality one = load_quality(write_text("one.json", json{{name, value}}.dump()));
        EXPECT_NE(one, Quality{}) << name;
        EXPECT_NE(differences(one, {}), "") << name;
    }
    EXPECT_EQ(differences(q, q), "");
}

TEST(QualityTest, TheSchemasDefaultsAreTheReaders)
{
    json defaults = json::object();
    const json schema = schema_json();
    for (const auto& [name, node] : schema.at("properties").items())
        if (node.contains("default"))
            defaults[name] = node.at("default");
    EXPECT_EQ(defaults.size(), json::parse(all_members).size());
    EXPECT_EQ(load_quality(write_text("defaults.json", defaults.dump())), Quality{});
}

TEST(QualityTest, SamplesAreThoseThatDevicesHave)
{
    for (const int count : {0, 3, 16})
        EXPECT_EQ(message_of([&] {
            load_quality(write_text("q.json", json{{"cube_samples", count}}.dump()));
        }),
            scratch("q.json").string() + ":1: /cube_samples: " + std::to_string(count)
                + " is not a number of samples that devices have; 1, 2, 4 or 8 is right");
}

TEST(QualityTest, ALadderRisesAndIsWrittenAgain)
{
    std::vector<PresetLevel> ladder = {{{.texels_per_pixel = 0.5}, 10, 0.2, 1.5}, {{.cube_samples = 4}, 25, 0.05, 0.25}};
    const std::vector<PresetLevel> again = load_ladder(write_text("ladder.json", ladder_text(ladder)));
    ASSERT_EQ(again.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again[i].quality, ladder[i].quality);
        EXPECT_EQ(again[i].ms, ladder[i].ms);
        EXPECT_EQ(again[i].flip, ladder[i].flip);
        EXPECT_EQ(again[i].edges_px, ladder[i].edges_px);
    }
    for (const auto& [text, problem] :
        std::vector<std::pair<std::string, std::string>>{
            {R"({ "levels": [{ "ms": 2, "quality": {} }, { "ms": 2, "quality": {} }] })", "/levels/1/ms: 2 is no more than"},
            {R"({ "levels": [{ "ms": 1, "quality": {} }, { "ms": 2, "quality": { "spectra": "fine" } }] })",
                "/levels/1/quality: "},
            {R"({ "levels": [{ "ms": 1, "quality": {} }, { "ms": 2, "quality": { "stereo": "shared" } }] })",
                "/levels/1/quality: "},
            {R"({ "levels": [{ "ms": 1, "quality": {} }, { "ms": 2, "quality": { "matrices": false } }] })",
                "/levels/1/quality: "}}) {
        SCOPED_TRACE(text);
        const std::string why = message_of([&] { load_ladder(write_text("ladder.json", text)); });
        EXPECT_NE(why.find(problem), why.npos) << why;
    }
}

TEST(QualityTest, AQualityReplacesTheStereoMethodUnlessTheBaselineTurns)
{
    Layout layout;
    EXPECT_EQ(with_stereo(layout, {}).stereo.method, layout.stereo.method);
    EXPECT_EQ(with_stereo(layout, {.stereo = StereoMethod::shared}).stereo.method, StereoMethod::shared);
    layout.stereo.method = StereoMethod::reprojected;
    layout.stereo.turning = true;
    EXPECT_EQ(with_stereo(layout, {.stereo = StereoMethod::shared}).stereo.method, StereoMethod::reprojected);
}

} // namespace quality_test
