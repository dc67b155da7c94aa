// Small glTF files that ask for much memory are refused before they get it.
#include "tests/support/gltf_fixture.h"

namespace starbow::gltf_test::world_limits_test {
namespace {

using WorldLimitsTest = GltfTest;

TEST_F(WorldLimitsTest, SmallFilesCannotAllocateMuch)
{
    // A hundred meshes with a million sparse elements each.
    Doc doc = triangle_doc();
    int indices = doc.view({0}), values = doc.view(Bytes(16, 0));
    Json accessor = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 999'999},
        {"sparse",
            {{"count", 1}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                {"values", {{"bufferView", values}}}}}};
    int last = doc.accessor<std::uint8_t>({0, 1, 2}, "SCALAR");
    for (int i = 0; i < 100; ++i)
        doc.show({{"attributes", {{"POSITION", doc.put("accessors", accessor)}}}, {"indices", last}});
    EXPECT_NE(complaint(doc).find("sparse accessors unfold to more bytes than are allowed"), std::string::npos);

    // Long lists of degenerate triangles.
    doc = triangle_doc();
    int same = doc.accessor(Bytes(999'999, 0), "SCALAR");
    for (int i = 0; i < 100; ++i)
        doc.show({{"attributes", {{"POSITION", 0}}}, {"indices", same}});
    EXPECT_NE(complaint(doc).find("brings the world above 16000000 triangles"), std::string::npos);

    doc = triangle_doc();
    doc.json["materials"] = std::vector<Json>(70'000, Json::object());
    EXPECT_TRUE(complaint(doc).starts_with("/materials: has 70000 entries; at most 65536"));

    // One long list of triangles that a hundred meshes show.
    doc = triangle_doc();
    int zeros = doc.put("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 999'999}});
    for (int i = 0; i < 100; ++i)
        doc.show({{"attributes", {{"POSITION", zeros}}}});
    EXPECT_NE(complaint(doc).find("brings the world above 16000000 vertices"), std::string::npos);
}

} // namespace
} // namespace starbow::gltf_test::world_limits_test
