#include "displays/warp/parts.h"
#include "tests/support/warp_fixture.h"
#include <atomic>
#include <iostream>
#include <map>

#if defined(STARBOW_SANITIZED)
// Not every compiler's package has the header with this function.
extern "C" int __sanitizer_install_malloc_and_free_hooks(
    void (*)(const volatile void*, std::size_t), void (*)(const volatile void*));
#endif

namespace starbow::warp_test::warp_fuzz_test {
namespace {

constexpr std::size_t mib = std::size_t(1) << 20;
std::atomic<std::size_t> largest = 0; ///< largest block of memory allocated

#if defined(STARBOW_SANITIZED)
void note_block(const volatile void*, std::size_t size)
{
    if (size > largest)
        largest = size;
}
void ignore_block(const volatile void*) { }
void watch_memory()
{
    static const int hooks = __sanitizer_install_malloc_and_free_hooks(note_block, ignore_block);
    (void)hooks;
}
#else
void watch_memory() { } // only the sanitizer has hooks
#endif

/// A file's content, or the files of an archive.
using Parts = std::vector<std::pair<std::string, std::string>>;

struct Seed {
    std::string name;
    Parts parts;
};

std::vector<Seed> seeds()
{
    std::vector<Seed> all;
    // Small files, so that damage meets every field.
    for (const auto& [name, text] : {std::pair("a.data", bourke), {"a.csv", csv}, {"a.simcad", simcad}, {"a.ol", scalable},
             {"a.txt", skyskan}, {"a.obj", obj}, {"a.mesh", headset}})
        all.push_back({name, {{name, text}}});
    all.push_back({"frustum", {{"frustum", "x;y;z;heading;pitch;bank;left;right;bottom;top\n0;0;0;45;10;0;58;59;-7;70\n"}}});
    all.push_back({"a.pfm", {{"a.pfm", pfm(4, 3, identity_map(4, 3))}}});
    all.push_back({"b.pfm", {{"b.pfm", pfm(4, 3, identity_map(4, 3), false)}}});
    std::vector<float> offsets(36);
    for (std::size_t i = 0; i < offsets.size(); ++i)
        offsets[i] = 0.01f * float(i % 5) - 0.02f;
    all.push_back({"offsets.pfm", {{"offsets.pfm", pfm(4, 3, offsets)}}});
    for (std::uint32_t version : {1u, 2u}) {
        std::string bytes = "SGC" + std::string(1, char(version));
        const auto word = [&](std::uint32_t value) {
            for (int shift = 0; shift < 32; shift += 8)
                bytes += char(value >> shift);
        };
        const auto number = [&](float value) { word(std::bit_cast<std::uint32_t>(value)); };
        word(0);
        for (float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 30.f, -30.f, -40.f, 40.f})
            number(v);
        word(version == 1 ? 3 : 5);
        word(version == 1 ? 2 : 6);
        for (int i = 0; i < 6; ++i)
            for (float v : {float(i % 3) / 2, float(i / 3), 0.f, float(i % 3) / 2, float(1 - i / 3), 0.f})
                number(v);
        word(6);
        for (std::uint32_t i : {0u, 3u, 1u, 4u, 2u, 5u})
            word(i);
        all.push_back({"a.sgc", {{"a.sgc", bytes}}});
    }
    const std::string flat = mpcdi_xml("3d", "<buffer id=\"b\">" + region_xml("r", frustum_xml) + "</buffer>",
        fileset_xml("r", "r.pfm",
            "<alphaMap><path>a.png</path><gammaEmbedded>2</gammaEmbedded></alphaMap><betaMap><path>a.png</path></betaMap>"));
    std::vector<unsigned char> picture(5 * 4 * 3);
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] = static_cast<unsigned char>(i * 37);
    const Parts parts{{"mpcdi.xml", flat}, {"r.pfm", pfm(4, 3, identity_map(4, 3))}, {"a.png", png(5, 4, 3, picture)}};
    all.push_back({"a.mpcdi", parts}); // each file inside is damaged
    all.push_back({"b.mpcdi", {{"b.mpcdi", zipped(parts)}}}); // the archive itself is damaged
    const std::string frame = "<coordinateFrame><yawx>0</yawx><yawy>-1</yawy><yawz>0</yawz><pitchx>1</pitchx><pitchy>0</"
                              "pitchy><pitchz>0</pitchz>"
                              "<rollx>0</rollx><rolly>0</rolly><rollz>-1</rollz></coordinateFrame>";
    std::string files = fileset_xml("r", "r.pfm");
    files.insert(files.find("<interpolation>"), "<geometricUnit>m</geometricUnit>");
    all.push_back({"c.mpcdi",
        {{"mpcdi.xml", mpcdi_xml("a3", "<buffer id=\"b\">" + region_xml("r", frame) + "</buffer>", files)},
            {"r.pfm", pfm(4, 3, identity_map(4, 3))}}});
    return all;
}

void damage(std::string& bytes, std::mt19937& random)
{
    static const std::vector<std::string> pieces{"1e999", "-1", "0", "1e308", "1e-320", "nan", "inf", "\n", "\r\n", " ", ";",
        "/", "[", "]", "<", ">", "&", "\"", "=", "99999999999999999999", "0.5", "16384", "65536", "4294967295", "v ", "f ",
        "vt ", std::string(4, '\0'), std::string(4, '\xff'), std::string("\0\0\xc0\x7f", 4), std::string("\0\0\x80\x7f", 4),
        std::string("\xff\xff\xff\x7f", 4)};
    for (unsigned faults = 1 + random() % 3; faults > 0; --faults) {
        const std::size_t at = random() % (bytes.size() + 1),
                          length = std::min<std::size_t>(random() % 16, bytes.size() - at);
        switch (random() % 7) {
        case 0:
            bytes.erase(at, length);
            break;
        case 1:
            bytes.insert(at, bytes.substr(at, length));
            break;
        case 2:
            bytes.insert(at, pieces[random() % pieces.size()]);
            break;
        case 3: {
            const std::string& piece = pieces[random() % pieces.size()];
            bytes.replace(at, std::min(piece.size(), bytes.size() - at), piece);
            break;
        }
        case 4:
            if (at < bytes.size())
                bytes[at] = char(random());
            break;
        case 5:
            if (at < bytes.size())
                bytes[at] = char(bytes[at] ^ 1 << random() % 8);
            break;
        default: {
            const std::size_t digit = bytes.find_first_of("0123456789", at);
            if (digit != bytes.npos)
                bytes.replace(digit, 1 + random() % 2, pieces[random() % 7]);
        }
        }
    }
}

WarpMesh read_seed(const Seed& seed, const Parts& parts, const FloatMapForm& form)
{
    if (seed.name == "frustum") {
        WarpMesh mesh = read("a.csv", csv);
        mesh.frustum = read_frustum({seed.name, parts[0].second}).planar;
        return mesh;
    }
    if (parts.size() == 1)
        return read_warp({seed.name, parts[0].second}, {.form = form});
    // Reads the files of an archive without the time that packing takes.
    std::size_t size = 0;
    for (const auto& [name, bytes] : parts)
        size += bytes.size();
    const std::string content(size, '\0');
    const WarpFile file{seed.name, content};
    return mesh_of_mpcdi(
        file, "mpcdi.xml", parts[0].second,
        [&](const std::string& path, std::size_t most) {
            for (const auto& [name, bytes] : parts)
                if (name == path && bytes.size() <= most)
                    return bytes;
            refuse(file, path, "is not in the archive; a file that is there is right");
        },
        "", form);
}

void expect_valid(const WarpMesh& mesh, bool sampled = false)
{
    if (!sampled && mesh.triangles.size() < 10000)
        if (const WarpMesh grid = gridded(mesh, {12, 9}); !grid.triangles.empty()) // otherwise it lies between the vertices
            expect_valid(grid, true);
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_TRUE(mesh.grid == glm::ivec2(0) || std::size_t(mesh.grid.x) * std::size_t(mesh.grid.y) == mesh.vertices.size());
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t i : triangle)
            ASSERT_LT(i, mesh.vertices.size());
    for (const WarpVertex& v : mesh.vertices) {
        ASSERT_TRUE(std::isfinite(v.at.x) && std::isfinite(v.at.y) && std::isfinite(v.intensity) && v.intensity >= 0);
        for (const glm::dvec3& sees : v.sees)
            ASSERT_TRUE(std::isfinite(sees.x) && std::isfinite(sees.y) && std::isfinite(sees.z));
    }
    if (mesh.frustum) {
        const Sides s = mesh.frustum->sides.value();
        ASSERT_LT(s.left_deg, s.right_deg);
        ASSERT_LT(s.down_deg, s.up_deg);
        ASSERT_TRUE(std::isfinite(mesh.frustum->turn.yaw_deg + mesh.frustum->turn.pitch_deg + mesh.frustum->turn.roll_deg));
    }
    for (const auto* mask : {&mesh.alpha, &mesh.beta})
        if (*mask) {
            ASSERT_EQ((*mask)->values.size(),
                std::size_t((*mask)->size.x) * std::size_t((*mask)->size.y) * std::size_t((*mask)->channels));
        }
    const WarpRaster raster(mesh, {16, 9});
    std::vector<WarpSample> row(16);
    for (int y = 0; y < 9; ++y)
        raster.row(y, row);
}

/// STARBOW_FUZZ_COUNT sets the number of mutations, STARBOW_FUZZ_SEED the seed. A seed's mutations are always the same.
TEST(WarpFuzzTest, DamagedFilesLoadOrAreRefused)
{
    const char* seed_text = std::getenv("STARBOW_FUZZ_SEED");
    std::mt19937 random(seed_text ? unsigned(std::atol(seed_text)) : 20081111u);
    const std::vector<Seed> all = seeds();
    std::map<std::string, std::array<int, 2>> outcomes; // refused, loaded
    watch_memory();
    largest = 0;
    const int count = fuzz_count();
    for (int n = 0; n < count; ++n) {
        const Seed& seed = all[random() % all.size()];
        Parts parts = seed.parts;
        damage(parts[random() % parts.size()].second, random);
        SCOPED_TRACE(seed.name + ", mutation " + std::to_string(n));
        const bool map = seed.name.ends_with(".pfm") || seed.name.ends_with(".mpcdi"), offsets = seed.name == "offsets.pfm";
        const auto sometimes = [&](bool at_all) { return random() % 2 && at_all; };
        const FloatMapForm form{.first_row_on_top = sometimes(map),
            .v_up = sometimes(seed.name.ends_with(".pfm") && !offsets),
            .edge_to_edge = sometimes(seed.name.ends_with(".pfm") && !offsets),
            .offsets = offsets};
        try {
            const WarpMesh mesh = read_seed(seed, parts, form);
            expect_valid(mesh);
            ++outcomes[seed.name][1];
        } catch (const InputError& error) {
            const std::string line = error.what();
            ASSERT_TRUE(line.starts_with(seed.name + ": ")) << line;
            ASSERT_EQ(line.find_first_of("\n\r"), line.npos) << line;
            ++outcomes[seed.name][0];
        } catch (const std::exception& error) {
            FAIL() << "neither loaded nor refused: " << error.what();
        }
        if (::testing::Test::HasFatalFailure())
            return;
        ASSERT_LE(largest, 64 * mib);
    }
    for (const auto& [name, results] : outcomes) {
        if (count >= 3000) { // otherwise nearly all damage would fail at the first check
            EXPECT_GT(results[0], 5) << name;
            EXPECT_GT(results[1], 5) << name;
        }
        std::cout << name << ": " << results[1] << " loaded, " << results[0] << " refused\n";
    }
#if defined(STARBOW_SANITIZED)
    EXPECT_GT(largest, 0u);
    std::cout << "the largest block of memory: " << largest << " bytes\n";
#endif
}

/// Files just below a mebibyte announce much, and must not allocate a block above 64 MiB.
TEST(WarpFuzzTest, AnnouncedSizesAllocateLittle)
{
    watch_memory();
    const auto filled = [](std::string head, const std::string& piece) {
        while (head.size() + piece.size() < mib)
            head += piece;
        return head;
    };
    std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf";
    std::vector<std::pair<std::string, std::string>> files{{"a.data", filled("2\n16384 6\n", "0 0 0 0 0\n")},
        {"a.data", filled("2\n321 320\n", "0 0 0 0 0\n")}, {"a.csv", filled("x;y;u;v;column;row\n", "0;0;0;0;0;0\n")},
        {"a.obj", filled(corners, " 1 2 3")}, {"a.obj", filled("", "v 0 0 0\n")}, {"a.obj", filled("", "z\n")},
        {"a.txt", filled("Dome Azimuth=0\nDome Elevation=0\nHorizontal FOV=9\n360 360\n", "0 0 0 0\n")},
        {"a.txt", filled("", "a=\n")}, {"a.ol", filled("OPENMESH Version 1.1\n", "0 0 0 0 0\n")},
        {"a.ol", filled("OPENMESH Version 1.1\n0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n", "[ 0 1 2 ]\n")},
        {"a.simcad", filled("<GeometryFile>", "<a/>")}, {"a.pfm", filled("PF\n295 295\n-1\n", std::string(12, '\0'))},
        {"a.mesh", filled("starbow headset mesh 1\n250 250\n", "0 0 0 0 0 0 0 0\n")}};
    std::string map = "PF\n780 780\n-1\n";
    map.resize(map.size() + 12 * 780 * 780);
    const std::string xml = mpcdi_xml("2d", "<buffer id=\"b\">" + region_xml("r", "") + "</buffer>",
        fileset_xml("r", "r.pfm", "<alphaMap><path>a.png</path></alphaMap>"));
    files.push_back({"a.mpcdi",
        zipped({{"mpcdi.xml", xml}, {"r.pfm", map},
            {"a.png", png(4000, 1500, 3, std::vector<unsigned char>(18'000'000, 7))}})});
    files.push_back({"a.mpcdi", zipped({{"mpcdi.xml", filled("<MPCDI>", "<a/>")}})});
    for (const auto& [name, bytes] : files) {
        SCOPED_TRACE(name + " " + bytes.substr(0, 40));
        ASSERT_LT(bytes.size(), mib);
        largest = 0;
        try {
            read(name, bytes);
        } catch (const InputError&) {
        }
        EXPECT_LE(largest, 64 * mib);
    }
}

} // namespace
} // namespace starbow::warp_test::warp_fuzz_test
