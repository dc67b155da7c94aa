// Direction maps are compiled once for each content, and kept in memory and in a folder, whose files may be damaged.
#include "displays/compile/compiled_view.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"

namespace compiled_view_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

using glm::ivec2;

Layout one(const Projection& projection, ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = projection}};
    return layout;
}

std::shared_ptr<const DirectionMap> map_of(MapStore& store, const Layout& layout)
{
    return compile_output(store, layout, 0, layout.outputs[0].size).front().map;
}

/// Smaller maps are not kept on disk.
constexpr ivec2 large(600, 500);

std::filesystem::path fresh_folder(const std::string& name)
{
    const auto folder = scratch(name);
    std::filesystem::remove_all(folder);
    return folder;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.push_back(entry.path());
    return files;
}

} // namespace

TEST(CompiledTest, FlatViewsNeedNoMap)
{
    MapStore store{std::filesystem::path()};
    const auto views = compile_output(store, one(Planar{60}, {64, 48}), 0, {64, 48});
    EXPECT_TRUE(views.front().matrix);
    EXPECT_FALSE(views.front().map);
    EXPECT_TRUE(views.front().cones->flat());
}

TEST(CompiledTest, EqualContentSharesOneMap)
{
    MapStore store{std::filesystem::path()};
    const Layout layout = one(Fisheye{180, 20}, {64, 64});
    const auto held = map_of(store, layout);
    EXPECT_EQ(map_of(store, layout), held);
    Layout renamed = layout;
    renamed.outputs[0].name = "another";
    renamed.outputs[0].colour.gamma = 2.2;
    EXPECT_EQ(map_of(store, renamed), held) << "a name or a colour changes no direction";
    MapStore other{std::filesystem::path()};
    EXPECT_NE(map_of(other, layout), held);
    EXPECT_EQ(map_of(other, layout)->texels, held->texels);
}

// Each parameter of a projection is changed alone, and must give another map.
TEST(CompiledTest, EveryParameterMakesAnotherMap)
{
    MapStore store{std::filesystem::path()};
    SphericalMirror mirror{{0, 0.3, -0.4}, Planar{40, {}, {180, 0, 0}}, {0, 0, 0.5}, 0.3, {0, 0, 0}, 3, 10, 180};
    const auto changed = [](auto base, auto change) {
        change(base);
        return Projection(base);
    };
    const Fisheye f{180, 20};
    const Cylinder c{};
    const Equirectangular e{};
    const CubeFaces cube{};
    const Lens l{};
    std::vector<Projection> all = {f, changed(f, [](auto& p) { p.aperture_deg += 1e-9; }),
        changed(f, [](auto& p) { p.tilt_deg += 1e-9; }), changed(f, [](auto& p) { p.rotation_deg = 1e-9; }),
        changed(f, [](auto& p) { p.mapping = FisheyeMapping::equisolid; }), changed(f, [](auto& p) { p.centre.x += 1e-9; }),
        changed(f, [](auto& p) { p.centre.y += 1e-9; }), changed(f, [](auto& p) { p.diameter += 1e-9; }), c,
        changed(c, [](auto& p) { p.sides.left_deg += 1e-9; }), changed(c, [](auto& p) { p.sides.right_deg -= 1e-9; }),
        changed(c, [](auto& p) { p.sides.down_deg += 1e-9; }), changed(c, [](auto& p) { p.sides.up_deg -= 1e-9; }),
        changed(c, [](auto& p) { p.turn.yaw_deg = 1e-9; }), changed(c, [](auto& p) { p.turn.pitch_deg = 1e-9; }),
        changed(c, [](auto& p) { p.turn.roll_deg = 1e-9; }), e, changed(e, [](auto& p) { p.sides.up_deg -= 1e-9; }),
        changed(e, [](auto& p) { p.turn.yaw_deg = 1e-9; }), cube,
        changed(cube, [](auto& p) { p.arrangement = CubeFaces::Arrangement::cross; }),
        changed(cube, [](auto& p) { p.turn.yaw_deg = 1e-9; }), mirror,
        changed(mirror, [](auto& p) { p.projector_m.x += 1e-9; }),
        changed(mirror, [](auto& p) { p.projector.fov_y_deg += 1e-9; }),
        changed(mirror, [](auto& p) { p.mirror_m.z += 1e-9; }), changed(mirror, [](auto& p) { p.mirror_radius_m += 1e-9; }),
        changed(mirror, [](auto& p) { p.dome_m.y += 1e-9; }), changed(mirror, [](auto& p) { p.dome_radius_m += 1e-9; }),
        changed(mirror, [](auto& p) { p.dome_tilt_deg += 1e-9; }),
        changed(mirror, [](auto& p) { p.dome_aperture_deg -= 1e-9; }), l,
        changed(l, [](auto& p) { p.form = Lens::Form::panotools; }), changed(l, [](auto& p) { p.fov_y_deg += 1e-9; }),
        changed(l, [](auto& p) { p.turn.yaw_deg = 1e-9; })};
    for (int channel = 0; channel < 3; ++channel) {
        all.push_back(changed(l, [&](auto& p) { p.colours[channel].centre.x += 1e-9; }));
        for (int k = 0; k < 4; ++k)
            all.push_back(changed(l, [&](auto& p) { p.colours[channel].k[k] = 1e-9; }));
    }
    std::vector<std::shared_ptr<const DirectionMap>> held;
    for (const Projection& projection : all) {
        held.push_back(map_of(store, one(projection, {16, 12})));
        for (std::size_t i = 0; i + 1 < held.size(); ++i)
            EXPECT_NE(held[i], held.back()) << i << " and " << held.size() - 1;
    }
    // The size in pixels counts, and for a mirror the eye's place.
    EXPECT_NE(map_of(store, one(f, {12, 16})), held.front());
    Layout moved = one(mirror, {16, 12});
    const auto from_middle = map_of(store, moved);
    moved.outputs[0].viewports[0].eye_m.x = 1e-9;
    EXPECT_NE(map_of(store, moved), from_middle);
}

TEST(CompiledTest, AWarpFileIsIdentifiedByItsContent)
{
    MapStore store{std::filesystem::path()};
    const std::string text = "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n";
    Layout layout = one(Planar{60}, {32, 24});
    layout.outputs[0].viewports[0].warp = Warp{write_text("content.data", text)};
    const auto before = map_of(store, layout);
    write_text("content.data", text);
    EXPECT_EQ(map_of(store, layout), before);
    write_text("content.data", "2\n2 2\n-1 -1 0 0 1\n1 -1 0.5 0 1\n-1 1 0 1 1\n1 1 0.5 1 1\n");
    const auto after = map_of(store, layout);
    EXPECT_NE(after, before);
    EXPECT_NE(after->texels, before->texels);
}

TEST(CompiledTest, TheFolderKeepsMapsAcrossStarts)
{
    const auto folder = fresh_folder("maps");
    const Layout a = one(Fisheye{180, 20}, large), b = one(Fisheye{170, 20}, large);
    std::shared_ptr<const DirectionMap> of_a, of_b;
    {
        MapStore store(folder);
        of_a = map_of(store, a);
        ASSERT_EQ(files_in(folder).size(), 1u);
        of_b = map_of(store, b);
        ASSERT_EQ(files_in(folder).size(), 2u);
    }
    {
        MapStore again(folder);
        EXPECT_EQ(map_of(again, a)->texels, of_a->texels);
        EXPECT_EQ(files_in(folder).size(), 2u);
    }
    // The files were read, not written again; one in another's place is compiled and written again.
    const auto files = files_in(folder);
    std::filesystem::create_hard_link(files[0], scratch("linked"));
    MapStore read(folder);
    EXPECT_EQ(map_of(read, a)->texels, of_a->texels);
    EXPECT_EQ(map_of(read, b)->texels, of_b->texels);
    EXPECT_EQ(std::filesystem::hard_link_count(files[0]), 2u);
    std::filesystem::rename(files[1], files[0]);
    MapStore exchanged(folder);
    EXPECT_EQ(map_of(exchanged, a)->texels, of_a->texels);
    EXPECT_EQ(map_of(exchanged, b)->texels, of_b->texels);
    EXPECT_EQ(std::filesystem::hard_link_count(scratch("linked")), 1u);
    EXPECT_EQ(files_in(folder).size(), 2u);
}

// Many maps may have been read in the same tick of the file system's clock. All of them count, and all may be deleted.
TEST(CompiledTest, TheFoldersLimitCountsMapsOfEqualTimes)
{
    const auto folder = fresh_folder("full");
    const auto then = std::filesystem::file_time_type::clock::now() - std::chrono::hours(24);
    for (int i = 0; i < 10; ++i) {
        const auto file = folder / (std::to_string(i) + ".map");
        std::filesystem::create_directories(folder);
        std::ofstream(file) << std::string(1 << 20, 'x');
        std::filesystem::last_write_time(file, then);
    }
    // The new map takes 600 x 600 x 16 bytes, 5.5 MiB, and two of the others fit beside it.
    MapStore store(folder, std::uintmax_t(8) << 20);
    map_of(store, one(Fisheye{180, 20}, {600, 600}));
    std::uintmax_t bytes = 0;
    for (const auto& file : files_in(folder))
        bytes += std::filesystem::file_size(file);
    EXPECT_LE(bytes, std::uintmax_t(8) << 20);
    EXPECT_EQ(files_in(folder).size(), 3u);
}

// Files that killed processes left go. Files that another exhibit may be writing, and foreign ones, stay.
TEST(CompiledTest, UnfinishedFilesOfDeadProcessesAreRemoved)
{
    const auto folder = fresh_folder("orphans");
    std::filesystem::create_directories(folder);
    const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(3);
    for (const char* name : {"0123456789abcdef.map.4711.part", "fresh.map.4712.part", "notes.txt"})
        std::ofstream(folder / name) << "content";
    for (const char* name : {"0123456789abcdef.map.4711.part", "notes.txt"})
        std::filesystem::last_write_time(folder / name, old);
    MapStore store(folder);
    map_of(store, one(Fisheye{180, 20}, large));
    EXPECT_FALSE(std::filesystem::exists(folder / "0123456789abcdef.map.4711.part"));
    EXPECT_TRUE(std::filesystem::exists(folder / "fresh.map.4712.part"));
    EXPECT_TRUE(std::filesystem::exists(folder / "notes.txt"));
}

TEST(CompiledTest, SmallMapsAndThoseOfAlignmentAreNotWritten)
{
    const auto folder = fresh_folder("unwritten");
    MapStore store(folder);
    map_of(store, one(Fisheye{180, 20}, {64, 64}));
    store.keep(false);
    map_of(store, one(Fisheye{180, 20}, large));
    EXPECT_FALSE(std::filesystem::exists(folder) && !files_in(folder).empty());
}

TEST(CompiledTest, DamagedFilesAreCompiledAgain)
{
    const auto folder = fresh_folder("damaged");
    const Layout layout = one(Fisheye{180, 20}, large);
    std::shared_ptr<const DirectionMap> right;
    {
        MapStore store(folder);
        right = map_of(store, layout);
    }
    const auto file = files_in(folder).at(0);
    const std::string whole = read_text(file);
    EXPECT_GT(whole.size(), right->texels.size() * sizeof(glm::vec4));
    std::mt19937 random(5);
    std::vector<std::pair<std::string, std::string>> damages
        = {{"empty", ""}, {"cut", whole.substr(0, whole.size() / 2)}, {"one byte short", whole.substr(0, whole.size() - 1)},
            {"header alone", whole.substr(0, 32)}, {"text", std::string(whole.size(), 'x')}};
    std::string zeros = whole;
    std::fill(
        zeros.begin() + std::ptrdiff_t(whole.size() / 2), zeros.begin() + std::ptrdiff_t(whole.size() / 2) + 512, '\0');
    damages.emplace_back("a sector of zeros", zeros);
    for (int i = 0; i < 24; ++i) {
        // Half of the damages are in the header.
        std::string flipped = whole;
        const std::size_t at = i % 2 ? random() % 32 : random() % whole.size();
        flipped[at] = char(flipped[at] ^ 1 << random() % 8);
        damages.emplace_back("bit at " + std::to_string(at), flipped);
    }
    for (const auto& [damage, content] : damages) {
        write_bytes(file, content);
        MapStore store(folder);
        const auto map = map_of(store, layout);
        EXPECT_TRUE(map->texels == right->texels && map->intensity == right->intensity) << damage;
        EXPECT_TRUE(read_text(file) == whole) << damage << ": the file must be written anew";
    }
}

TEST(CompiledTest, MapsCompileWithoutAUsableFolder)
{
    const auto blocked = write_text("a file", "in the way") / "folder";
    MapStore store(blocked);
    EXPECT_TRUE(map_of(store, one(Fisheye{180, 20}, large)));
}

// The time that an exhibit waits at its first start.
TEST(CompiledTest, ADomeOf4096PixelsIsCompiledInSeconds)
{
    const Layout layout = one(Fisheye{180, 15}, {4096, 4096});
    const View view = views_of(layout, 0, {4096, 4096}).front();
    const double began_s = processor_seconds();
    const DirectionMap map = compile_direction_map(view);
    const double compiled_s = processor_seconds();
    const ConeHierarchy cones(map);
    const double done_s = processor_seconds();
    // The least that any algorithm does: each pixel's direction and angle, once.
    const PictureRays rays(view.picture);
    double sum = 0;
    for (int y = 0; y < 4096; ++y)
        for (int x = 0; x < 4096; ++x) {
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) * view.picture_from_pixel;
            if (auto seen = rays.direction(at, Channel::green))
                sum += seen->y + rays.pixel_angle(at, Channel::green);
        }
    const double least_s = processor_seconds() - done_s;
    EXPECT_GT(sum, 0);
    std::printf("  4096 x 4096 by one processor: directions in %.2f s, blocks in %.2f s, of which each pixel once %.2f s\n",
        compiled_s - began_s, done_s - compiled_s, least_s);
    EXPECT_NEAR(map.at(2048, 2048).y, std::cos(glm::radians(15.0)), 1e-3);
    EXPECT_EQ(cones.size(), map.size);
    // Measured: 3.4 times. A slower algorithm takes more on any machine, whatever else runs there.
    EXPECT_LT(done_s - began_s, 10 * least_s);
}

} // namespace compiled_view_test
