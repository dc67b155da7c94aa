#include "composition.h"
#include "displays/compile/rows.h"
#include <algorithm>

namespace starbow {
namespace {

constexpr std::uint8_t no_layer = 255;

/// The views of one canvas at one pixel, from the highest order down; of one order the later in the layout first.
class Stack {
public:
    Stack(const Layout& layout, std::span<const ViewShade> views, int canvas)
    {
        for (const ViewShade& shade : views) {
            const View& view = shade.view().view;
            if (view.canvas == canvas)
                all_.push_back({&shade, layout.outputs[view.output].viewports[view.viewport].order});
        }
        std::reverse(all_.begin(), all_.end());
        std::stable_sort(all_.begin(), all_.end(), [](const Entry& a, const Entry& b) { return a.order > b.order; });
    }

    struct Pixel {
        std::vector<glm::vec4> shares; ///< by layer
        glm::vec3 black{0};
        std::uint8_t foremost = no_layer;
    };

    /// pixel.shares must have an entry for each layer.
    void compose(glm::ivec2 at, bool bare, Pixel& pixel) const
    {
        std::fill(pixel.shares.begin(), pixel.shares.end(), glm::vec4(0));
        pixel.black = glm::vec3(0);
        pixel.foremost = no_layer;
        glm::vec3 left(1); // that the higher orders leave
        float part_left = 1, parts = 0, most = 0;
        for (std::size_t i = 0; i < all_.size();) {
            glm::vec3 taken(0);
            float part_taken = 0;
            for (const int order = all_[i].order; i < all_.size() && all_[i].order == order; ++i) {
                const ViewShade& shade = *all_[i].shade;
                const View& view = shade.view().view;
                const glm::ivec2 p = at - view.corner;
                if (p.x < 0 || p.y < 0 || p.x >= view.size.x || p.y >= view.size.y)
                    continue;
                pixel.black += left * shade.lift(p.x, p.y);
                glm::vec3 shown;
                for (int c = 0; c < 3; ++c)
                    shown[c] = shade.shows(p.x, p.y, c);
                if (shown == glm::vec3(0))
                    continue;
                const glm::vec3 own = shown * shade.mask(p.x, p.y);
                const float part = part_left * (own.r + own.g + own.b) / 3;
                pixel.shares[std::size_t(view.layer)] = glm::vec4(left * own * shade.brightness(p.x, p.y), part);
                if (pixel.foremost == no_layer || part > most)
                    pixel.foremost = std::uint8_t(view.layer), most = part;
                taken += own, part_taken += (own.r + own.g + own.b) / 3, parts += part;
            }
            left *= 1.0f - glm::min(taken, 1.0f);
            part_left *= 1 - std::min(part_taken, 1.0f);
        }
        if (pixel.foremost == no_layer)
            return;
        if (parts > 0)
            for (glm::vec4& share : pixel.shares)
                share.a /= parts;
        else
            pixel.shares[pixel.foremost].a = 1; // every mask is black here
        if (bare)
            for (glm::vec4& share : pixel.shares)
                share = glm::vec4(share.a);
    }

private:
    struct Entry {
        const ViewShade* shade;
        int order;
    };
    std::vector<Entry> all_;
};

} // namespace

Shade composed(const Layout& layout, glm::ivec2 size, std::span<const ViewShade> views, bool bare)
{
    Shade out;
    out.size = size;
    int canvases = 1;
    bool lifted = false;
    for (const ViewShade& shade : views) {
        out.layers = std::max(out.layers, shade.view().view.layer + 1);
        canvases = std::max(canvases, shade.view().view.canvas + 1);
        lifted |= shade.has_lift() && !bare;
    }
    const std::size_t pixels = std::size_t(size.x) * std::size_t(size.y), layers = std::size_t(out.layers);
    out.shares.assign(std::size_t(canvases) * layers, std::vector<glm::vec4>(pixels));
    out.foremost.assign(pixels, no_layer);
    if (lifted)
        out.black.assign(pixels, glm::vec3(0));
    for (int canvas = 0; canvas < canvases; ++canvas) {
        const Stack stack(layout, views, canvas);
        by_rows(size.y, [&](int first, int end) {
            Stack::Pixel pixel{std::vector<glm::vec4>(layers)};
            for (int y = first; y < end; ++y)
                for (int x = 0; x < size.x; ++x) {
                    stack.compose({x, y}, bare, pixel);
                    const std::size_t at = std::size_t(y) * std::size_t(size.x) + std::size_t(x);
                    for (std::size_t layer = 0; layer < layers; ++layer)
                        out.shares[std::size_t(canvas) * layers + layer][at] = pixel.shares[layer];
                    if (canvas > 0)
                        continue; // the first canvas represents both
                    out.foremost[at] = pixel.foremost;
                    if (lifted)
                        out.black[at] = pixel.black;
                }
        });
    }
    return out;
}

} // namespace starbow
