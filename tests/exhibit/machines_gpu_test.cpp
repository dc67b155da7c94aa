// Several machines show what one would: each draws its own outputs of the same instants, which it has from their bytes.
#include "config/model/shipped.h"
#include "runtime/exhibit/picture_setup.h"
#include "runtime/machines/page_bytes.h"
#include "runtime/machines/shared_state.h"
#include "tests/support/gpu_environment.h"
#include <cstring>

namespace starbow::gpu_test::machines_gpu_test {
namespace {

/// One machine: it draws the outputs of one node, or all.
class Machine {
public:
    Machine(const GpuWorld& world, const Layout& layout, std::string node)
        : layout_(layout)
        , node_(std::move(node))
        , words_(words_in("en"))
        , frame_(device(), pipelines(), world, layout, test_quality())
        , pictures_([] {
            return Thumbnails{{"scene/clocks", {{2, 1}, {250, 20, 20, 20, 250, 20}}}};
        })
    {
        frame_.only(node_);
        frame_.repeatable(true);
        for (const Output& output : layout.outputs)
            images_.push_back(make_image(device(),
                {vk::Format::eR8G8B8A8Srgb, {std::uint32_t(output.size.x), std::uint32_t(output.size.y)},
                    vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc}));
    }

    bool shows(std::size_t output) const { return node_.empty() || layout_.outputs[output].node == node_; }

    /// The pictures of its outputs; of others, empty ones.
    std::vector<std::vector<std::byte>> draw(const PictureState& now)
    {
        using Stage = vk::PipelineStageFlagBits2;
        using Access = vk::AccessFlagBits2;
        std::vector<Target> targets;
        for (std::size_t i = 0; i < images_.size(); ++i) {
            const Image& image = images_[i];
            targets.push_back(shows(i) ? Target{*image.image, *image.view, image.extent, image.format} : Target{});
        }
        const Panel* panel = pictures_.set_up(now, words_, frame_);
        device().now([&](vk::CommandBuffer commands) {
            for (const Image& image : images_)
                transition(commands, image, vk::ImageLayout::eUndefined, Stage::eNone, {},
                    vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
            frame_.draw(commands, now.shot, panel, targets);
            for (const Image& image : images_)
                transition(commands, image, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                    Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer,
                    Access::eTransferRead);
        });
        std::vector<std::vector<std::byte>> pictures;
        for (std::size_t i = 0; i < images_.size(); ++i)
            pictures.push_back(shows(i) ? read_back(device(), images_[i], 4) : std::vector<std::byte>());
        return pictures;
    }

    FrameRenderer& frame() { return frame_; }
    /// The layout with a builder's changes.
    void adopt(const Layout& layout) { frame_.adopt(layout); }

private:
    Layout layout_;
    std::string node_;
    Words words_;
    FrameRenderer frame_;
    PictureSetup pictures_;
    std::vector<Image> images_;
};

/// A shipped layout, small, with a node for each output.
Layout layout_of(const std::string& name)
{
    Layout layout = load_layout(shipped_file("layouts", name));
    for (Output& output : layout.outputs) {
        const double scale = 320.0 / std::max(output.size.x, output.size.y);
        output.size = glm::max(glm::ivec2(glm::dvec2(output.size) * scale) / 2 * 2, 2);
        output.node = "node-" + output.name;
    }
    return layout;
}

/// Instants of one flight: at rest with a text, at speed with a head that moves, at gamma 100 with an inset, a
/// pattern, a fade.
std::vector<PictureState> states(const Shot& start)
{
    const auto at = [&](double gamma) {
        PictureState now{.shot = start};
        now.shot.u = start.ship_from_cockpit * dvec3(0, 0, -u_of_gamma(gamma));
        now.shot.time += gamma;
        now.meters = true;
        return now;
    };
    std::vector<PictureState> all;
    PictureState& rest = all.emplace_back(at(1));
    rest.hud = HudText{1, readings(Ship(), avenue().world.scene, {})};
    rest.hud->readings.caption = Caption{"You rest", {"go", "stay"}, 1};
    PictureState& fast = all.emplace_back(at(4));
    fast.head = {{0.1, 0.05, -0.02}, glm::dquat(0.995, 0.0, 0.0998, 0.0)};
    fast.hud = HudText{2, readings(Ship(), avenue().world.scene, {})};
    fast.sign = ShownSign{{"behind you"}, glm::normalize(dvec3(0.2, 0.1, -1))};
    fast.pointer = ShownPointer{glm::normalize(dvec3(-0.2, 0.1, -1)), 0.75};
    PictureState& faster = all.emplace_back(at(100));
    faster.inset = InsetPicture{.kind = InsetView::at_rest, .name = "at rest"};
    faster.shot.exposure_ev = -3, faster.fade = 0.25;
    PictureState& measured = all.emplace_back(at(2));
    measured.instruments = Instruments{.overlay = Overlay::grid};
    measured.vignette_part = 0.7;
    all.emplace_back(at(1)).pattern = Pattern::names;
    return all;
}

/// The part of the cube maps' texels that are drawn.
double drawn_part(const FrameRenderer& frame)
{
    double drawn = 0, all = 0;
    for (const CubeMapPlan& plan : frame.plans())
        for (const PlannedImage& image : plan.images) {
            const double texels = double(image.size.x) * image.size.y;
            all += texels, drawn += image.needed ? texels : 0;
        }
    return drawn / all;
}

void expect_union(const GpuWorld& world, const Layout& layout, const std::vector<PictureState>& all, const std::string& name)
{
    Machine whole(world, layout, "");
    std::vector<std::unique_ptr<Machine>> nodes;
    for (const std::string& node : nodes_of(layout))
        nodes.push_back(std::make_unique<Machine>(world, layout, node));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto wanted = whole.draw(all[i]);
        const std::vector<std::uint8_t> bytes = bytes_of({.scene = "avenue", .picture = all[i]});
        bool all_there = true;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            if (k == 1 && i == 1) {
                all_there = false;
                continue; // this one was away for a frame
            }
            const auto seen = nodes[k]->draw(shared_state_of(bytes).picture);
            for (std::size_t output = 0; output < seen.size(); ++output)
                if (nodes[k]->shows(output)) {
                    EXPECT_EQ(seen[output], wanted[output])
                        << name << ", " << layout.outputs[output].name << ", picture " << i;
                }
        }
        // One exposure: the master's, from the samples of all.
        FrameRenderer& master = nodes[0]->frame();
        for (std::size_t k = 1; k < nodes.size(); ++k)
            master.add_samples(nodes[k]->frame().own_samples());
        if (all_there) {
            EXPECT_EQ(master.metered(), whole.frame().metered()) << name << ", picture " << i;
            EXPECT_TRUE(all[i].pattern != Pattern::none || master.metered()) << name;
        }
        if (name == "cave5" && i == 0) {
            double least = 1;
            for (const auto& node : nodes)
                least = std::min(least, drawn_part(node->frame()));
            EXPECT_LT(least, 0.7) << "each wall draws its own part of the world";
            EXPECT_EQ(drawn_part(whole.frame()), 1);
        }
    }
    EXPECT_NE(whole.draw(all[0]), whole.draw(all[1])) << name; // else equality would say nothing
}

} // namespace

TEST(Machines, TogetherTheyShowWhatOneWould)
{
    const Shot start = load_shot(shipped_file("shots", "avenue-rest"));
    for (const char* name : {"desk", "wall3", "dome2", "cave5", "passive-pair", "stereo", "mirror"})
        expect_union(avenue().world, layout_of(name), states(start), name);
}

/// A builder turns numbers at the master: the nodes have them by the state's bytes, in the same frame.
TEST(Machines, TheSameWhileABuilderTurnsNumbers)
{
    const Shot start = load_shot(shipped_file("shots", "avenue-rest"));
    for (const char* name : {"desk", "dome2", "cave5", "mirror"}) {
        const Layout layout = layout_of(name);
        Layout turned = layout;
        const std::vector<Adjustable> all = adjustables(layout);
        for (std::size_t i = 0; i < all.size(); i += 2)
            turned = adjusted(turned, all[i], 7);
        Machine whole(avenue().world, layout, "");
        std::vector<std::unique_ptr<Machine>> nodes;
        for (const std::string& node : nodes_of(layout))
            nodes.push_back(std::make_unique<Machine>(avenue().world, layout, node));
        const PictureState now = states(start)[1];
        const auto before = whole.draw(now);
        whole.adopt(turned);
        const auto wanted = whole.draw(now);
        EXPECT_NE(wanted, before) << name;
        const auto bytes = bytes_of({.scene = "avenue", .turned = turned_numbers(layout, turned), .picture = now});
        for (const auto& node : nodes) {
            node->draw(now); // in the file's layout
            const SharedState shared = shared_state_of(bytes);
            node->adopt(with_turned(layout, shared.turned));
            const auto seen = node->draw(shared.picture);
            for (std::size_t output = 0; output < seen.size(); ++output)
                if (node->shows(output)) {
                    EXPECT_EQ(seen[output], wanted[output]) << name << ", " << layout.outputs[output].name;
                }
        }
    }
}

/// The instruments' page is a message of its own, which the state names.
TEST(Machines, TheSameWithThePageOfTheInstruments)
{
    const Shot start = load_shot(shipped_file("shots", "avenue-rest"));
    const Layout layout = layout_of("dome2");
    Panel panel = plate({360, 240}, 20);
    for (std::size_t i = 0; i < panel.texels.size(); i += 7)
        panel.texels[i] = 255;
    PictureState now = states(start)[0];
    Instruments& on = now.instruments.emplace();
    on.panel_number = 5, on.scale_place = {0.2f, 0.3f, 0.5f, 0.1f};
    Machine whole(avenue().world, layout, "");
    const auto without = whole.draw(now);
    on.panel = &panel;
    const auto wanted = whole.draw(now);
    EXPECT_NE(wanted, without);
    const PageMessage page = page_of(panel, 5);
    const auto bytes = bytes_of({.scene = "avenue", .picture = now});
    for (const std::string& name : nodes_of(layout)) {
        Machine node(avenue().world, layout, name);
        SharedState shared = shared_state_of(bytes);
        EXPECT_EQ(shared.picture.instruments->panel_number, page.number);
        const Panel come = panel_of(page);
        shared.picture.instruments->panel = &come;
        const auto seen = node.draw(shared.picture);
        for (std::size_t output = 0; output < seen.size(); ++output)
            if (node.shows(output)) {
                EXPECT_EQ(seen[output], wanted[output]) << layout.outputs[output].name;
            }
    }
}

/// Each machine has the menu's small pictures from its own disk, a moment after the first one is wanted.
TEST(Machines, TheSameWithAMenusSmallPicture)
{
    const Shot start = load_shot(shipped_file("shots", "avenue-rest"));
    for (const char* name : {"desk", "dome2"}) {
        const Layout layout = layout_of(name);
        PictureState without = states(start)[0], now = without;
        Caption& menu = now.hud->readings.caption.value();
        menu.menu = true, menu.picture = "scene/nowhere";
        Machine whole(avenue().world, layout, "");
        without = now;
        menu.picture = "scene/clocks";
        const auto bare = whole.draw(without);
        auto wanted = whole.draw(now);
        for (int i = 0; i < 200 && wanted == bare; ++i)
            wanted = whole.draw(now);
        EXPECT_NE(wanted, bare) << name;
        EXPECT_EQ(whole.draw(without), bare) << name;
        const auto bytes = bytes_of({.scene = "avenue", .picture = now});
        for (const std::string& one : nodes_of(layout)) {
            Machine node(avenue().world, layout, one);
            const PictureState come = shared_state_of(bytes).picture;
            for (std::size_t output = 0; output < wanted.size(); ++output)
                if (node.shows(output)) {
                    auto seen = node.draw(come);
                    for (int i = 0; i < 200 && seen[output] != wanted[output]; ++i)
                        seen = node.draw(come);
                    EXPECT_EQ(seen[output], wanted[output]) << layout.outputs[output].name;
                }
        }
    }
}

TEST(Machines, TheSameWithMovingBodies)
{
    const Shot start = load_shot(shipped_file("shots", "clocks-passing"));
    const GpuWorld world = upload_scene(avenue(), load_scene(shipped_file("scenes", "clocks")));
    expect_union(world, layout_of("dome2"), states(start), "clocks");
}

} // namespace starbow::gpu_test::machines_gpu_test
