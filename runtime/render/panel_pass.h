#pragma once
#include "displays/compile/compiled_view.h"
#include "pipelines.h"
#include "runtime/hud/hud.h"
#include "runtime/hud/small_picture.h"
#include "shaders/shared_structs.h"
#include <span>

namespace starbow {

/// Draws a panel of text into every view, at infinity in the cockpit. Holds the panel's picture.
class PanelPass {
public:
    PanelPass(Device& device, Pipelines& pipelines, std::size_t views);

    /// The panel's place: its axes from the cockpit's (hud_place.h), and half its extent on the plane z = 1.
    struct Place {
        glm::dmat3 panel_from_cockpit{1};
        glm::dvec2 half{1};
    };
    /// map, nearest: a view's direction map and its sampler. The device must have finished the frame before.
    void prepare(const Panel& panel, const Place& place);
    /// The same for a picture, which a frame around it sets off.
    void prepare(const SmallPicture& picture, const Place& place);
    /// The same for a picture of light. It must be in eShaderReadOnlyOptimal when it is drawn.
    void prepare(const Image& picture, const Place& place);
    void prepare_view(std::size_t view, const Image& map, vk::Sampler nearest);

    void upload(vk::CommandBuffer commands); ///< before the first view
    /// Draws into the rendering under way. constants: the view's, with rows that lead to the panel's axes. scale:
    /// rectangle of the false colours on the panel, lower left and upper right corner, 0 to 1; an empty one draws none.
    /// box: the pixels that the panel may cover; an empty one draws nothing.
    void draw(vk::CommandBuffer commands, std::size_t view, bool map, shared::ViewPush constants, glm::ivec2 corner,
        glm::ivec2 size, const vk::Rect2D& box, const glm::vec4& scale, vk::Format target);

    const Place& place() const { return place_; }
    vk::DeviceSize memory() const { return picture_.bytes; }

private:
    void hold(vk::Format format, glm::ivec2 size, std::span<const std::uint8_t> texels, const Place& place);
    const Image& shown() const { return light_ ? *light_ : picture_; }

    Device& device_;
    Pipelines& pipelines_;
    Place place_;
    Image picture_;
    const Image* light_ = nullptr; ///< the picture of light; null: picture_ is drawn
    Buffer texels_;
    bool new_ = false;
    vk::raii::Sampler linear_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_;
};

/// Letters, a small picture or a picture of light, laid over every view.
struct Callout {
    const Panel* letters = nullptr; ///< or null
    const SmallPicture* small = nullptr; ///< or null
    const Image* picture = nullptr; ///< of light, or null
    PanelPass::Place place{};
};

} // namespace starbow
