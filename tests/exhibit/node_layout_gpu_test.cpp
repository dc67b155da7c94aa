// A node's layout: it follows the master's numbers, and its own files. It needs no GPU.
#include "config/model/shipped.h"
#include "runtime/exhibit/node_layout.h"
#include "tests/support/files.h"
#include <fstream>
#include <thread>

namespace starbow::node_layout_gpu_test {
namespace {

using namespace starbow::testing;

/// Two machines' copies of one exhibit: its layout has two outputs.
ExhibitOptions copy(const std::string& node, const std::string& yaw = "-30")
{
    write_text(node + "-walls.json",
        R"({ "outputs": [
        { "name": "a", "node": "left", "size": [160, 120], // by the window
          "viewports": [ { "projection": { "type": "planar", "turn_deg": { "yaw": )"
            + yaw + R"(, "pitch": 0, "roll": 0 } } } ] },
        { "name": "b", "node": "right", "size": [160, 120],
          "viewports": [ { "projection": { "type": "planar", "turn_deg": { "yaw": 30, "pitch": 0, "roll": 0 } } } ] } ] })");
    std::filesystem::create_directories(scratch(node));
    const std::filesystem::path file = scratch(node) / std::filesystem::path("walls.json");
    std::filesystem::rename(scratch(node + "-walls.json"), file);
    ExhibitOptions options{
        .content = {.scene = shipped_file("scenes", "avenue")}, .layout = load_layout(file), .words = words_in("en")};
    options.node = node;
    return options;
}

double yaw_of(const Layout& layout) { return std::get<Planar>(layout.outputs[0].viewports[0].projection).turn.yaw_deg; }

/// The layout with its first output turned by tenths of a degree.
Layout turned(const Layout& layout, double tenths) { return adjusted(layout, adjustables(layout)[0], tenths); }

/// The state of a master with this layout.
SharedState said(const ExhibitOptions& master, const Layout& shown)
{
    return {.layout = master.layout.file.string(),
        .layout_digest = digest_of(digests_of(master.layout)),
        .turned = turned_numbers(master.layout, shown)};
}

/// Waits for the loader's next result and takes it.
void follow(NodeLayout& node)
{
    for (const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
         std::chrono::steady_clock::now() < until;) {
        if (node.loader.changed())
            node.loader.load({.kept = node.kept(), .layout = node.kept(), .quality = {}, .sizes = {}, .has_stars = false});
        if (std::optional<LayoutLoader::Result> result = node.loader.result()) {
            ASSERT_TRUE(std::holds_alternative<LayoutLoader::Loaded>(*result)) << std::get<std::string>(*result);
            return node.take(std::get<LayoutLoader::Loaded>(std::move(*result)));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    FAIL() << "no layout was loaded";
}

TEST(NodeLayoutTest, TheMastersNumbersAreShownAndKept)
{
    const ExhibitOptions master = copy("left"), options = copy("right");
    NodeLayout node(options);
    const ConfigMessage first = config_of(master, digests_of(master.layout));
    node.compare(first, false);
    EXPECT_TRUE(node.is_of(said(master, master.layout)));

    // The builder turns.
    const Layout shown = turned(master.layout, 5);
    const SharedState state = said(master, shown);
    EXPECT_FALSE(node.is_of(state)) << "not before it has taken them";
    std::optional<Layout> next = node.turned_by(state);
    ASSERT_TRUE(next);
    EXPECT_EQ(yaw_of(*next), -29.5);
    node.turn(*next, state.turned);
    EXPECT_TRUE(node.is_of(state));
    EXPECT_FALSE(node.turned_by(state)) << "nothing new";

    // He keeps it in the master's file: the node's file becomes the same, its comment with it.
    patch_file(master.layout.file, changes(master.layout, shown));
    const ExhibitOptions kept{.content = master.content, .layout = load_layout(master.layout.file), .words = master.words};
    const SharedState after = said(kept, kept.layout);
    EXPECT_FALSE(node.turned_by(after)) << "the same picture until its own file is read";
    EXPECT_FALSE(node.is_of(after));
    node.compare(config_of(master, digests_of(kept.layout)), true);
    EXPECT_EQ(read_text(options.layout.file), read_text(master.layout.file));
    EXPECT_NE(read_text(options.layout.file).find("// by the window"), std::string::npos);
    follow(node);
    EXPECT_TRUE(node.is_of(after));
    EXPECT_EQ(yaw_of(node.shown()), -29.5);
    EXPECT_EQ(layout_difference(node.config(), config_of(master, digests_of(kept.layout))), "");
}

TEST(NodeLayoutTest, ItsFileIsTheMastersOrItIsNamed)
{
    const ExhibitOptions master = copy("left", "-35"), options = copy("right");
    const ConfigMessage masters = config_of(master, digests_of(master.layout));
    NodeLayout node(options);
    try {
        node.compare(masters, false);
        FAIL() << "before it was ever in step, it is refused";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("node 'right' has a different walls.json ("), std::string::npos)
            << error.what();
    }
    // While it shows, it goes on with its last good layout, and no number is turned in a file that is another one.
    const std::string before = read_text(options.layout.file);
    node.compare(masters, true);
    EXPECT_EQ(read_text(options.layout.file), before);
    EXPECT_FALSE(node.is_of(said(master, master.layout)));
    EXPECT_FALSE(node.turned_by(said(master, turned(master.layout, 5))));
    EXPECT_EQ(yaw_of(node.shown()), -30);
    // The builder copies the file.
    std::filesystem::copy_file(master.layout.file, options.layout.file, std::filesystem::copy_options::overwrite_existing);
    follow(node);
    EXPECT_TRUE(node.is_of(said(master, master.layout)));
    EXPECT_EQ(yaw_of(node.shown()), -35);
    ASSERT_TRUE(node.turned_by(said(master, turned(master.layout, 5))));

    // Another program is refused at any time: its pictures may differ.
    ConfigMessage other = masters;
    other.files[0].second = "0";
    EXPECT_THROW(node.compare(other, true), InputError);
}

/// A builder's slip: the node's file has no machines any more. It is named, and mended while the node runs.
TEST(NodeLayoutTest, AFileWithoutMachinesIsNamedToo)
{
    const ExhibitOptions master = copy("left"), options = copy("right");
    const ConfigMessage masters = config_of(master, digests_of(master.layout));
    NodeLayout node(options);
    node.compare(masters, false);
    std::string text = read_text(options.layout.file);
    for (const std::string& member : {std::string("\"node\": \"left\", "), std::string("\"node\": \"right\", ")})
        text.erase(text.find(member), member.size());
    std::ofstream(options.layout.file) << text;
    follow(node);
    EXPECT_FALSE(node.is_of(said(master, master.layout)));
    EXPECT_NE(layout_difference(node.config(), masters), "");
    node.compare(masters, true);
    EXPECT_FALSE(node.turned_by(said(master, turned(master.layout, 5))));
    std::filesystem::copy_file(master.layout.file, options.layout.file, std::filesystem::copy_options::overwrite_existing);
    follow(node);
    EXPECT_TRUE(node.is_of(said(master, master.layout)));
}

TEST(NodeLayoutTest, AnotherLayoutIsLoadedByItsName)
{
    const ExhibitOptions options = copy("right");
    NodeLayout node(options);
    node.turned_by(said(options, options.layout));
    ExhibitOptions other = copy("left", "-40");
    const std::filesystem::path moved = scratch("other.json");
    std::filesystem::rename(other.layout.file, moved);
    other.layout = load_layout(moved);
    node.compare(config_of(other, digests_of(other.layout)), true);
    EXPECT_FALSE(node.turned_by(said(other, other.layout)));
    follow(node);
    EXPECT_TRUE(node.is_of(said(other, other.layout)));
    EXPECT_EQ(yaw_of(node.shown()), -40);
    // One that is not here: said once, and the shown one stays.
    SharedState missing = said(other, other.layout);
    missing.layout = "no-such-layout", missing.layout_digest = 1;
    EXPECT_THROW(node.turned_by(missing), InputError);
    EXPECT_FALSE(node.turned_by(missing));
    EXPECT_EQ(yaw_of(node.shown()), -40);
}

} // namespace
} // namespace starbow::node_layout_gpu_test
