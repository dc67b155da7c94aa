#include "pattern_label.h"
#include "runtime/hud/hud.h"
#include <algorithm>

namespace starbow {

Image make_label(Device& device, const Layout& layout, const View& view, glm::ivec2 sent)
{
    const Output& output = layout.outputs[view.output];
    std::string name = output.name;
    if (output.viewports.size() > 1)
        name.append(" ").append(std::to_string(view.viewport));
    std::string pixels = view.eye == Eye::left ? "left eye, " : view.eye == Eye::right ? "right eye, " : "";
    pixels += std::to_string(sent.x) + " x " + std::to_string(sent.y);
    const std::string lines[] = {name, pixels};

    const Typesetter typesetter;
    int height = std::clamp(std::min(view.size.x, view.size.y) / 12, 12, 160);
    double widest = 1;
    for (const std::string& line : lines)
        widest = std::max(widest, typesetter.width_of(line, height));
    // Labels in the middle and in the corners must not touch.
    height = std::max(10, int(height * std::min(1.0, 0.3 * view.size.x / widest)));
    widest = 1;
    for (const std::string& line : lines)
        widest = std::max(widest, typesetter.width_of(line, height));
    Panel panel;
    panel.size = {int(widest) + 2, int(2.6 * height)};
    panel.texels.assign(std::size_t(2) * panel.size.x * panel.size.y, 0);
    for (int i = 0; i < 2; ++i)
        typesetter.write(panel, lines[i], 0.5 * (panel.size.x - typesetter.width_of(lines[i], height)),
            (0.95 + 1.2 * i) * height, height, 1);
    return make_texture(device, vk::Format::eR8G8Unorm, panel.size, std::as_bytes(std::span(panel.texels)), false);
}

float shown_part(const CompiledView& view)
{
    if (!view.map)
        return 1;
    const glm::ivec2 size = view.map->size;
    auto shown = [&](int x, int y) { return view.map->at(x, y).w > 0; };
    for (int percent = 100; percent > 30; --percent) {
        const glm::ivec2 low = size * (100 - percent) / 200, high = size - 1 - low;
        bool all = true;
        for (int x = low.x; x <= high.x && all; ++x)
            all = shown(x, low.y) && shown(x, high.y);
        for (int y = low.y; y <= high.y && all; ++y)
            all = shown(low.x, y) && shown(high.x, y);
        if (all)
            return float(percent) / 100;
    }
    return 1;
}

glm::vec3 output_tint(std::size_t output)
{
    constexpr glm::vec3 tints[] = {{1, 0.05f, 0.05f}, {0.05f, 0.7f, 0.1f}, {0.1f, 0.2f, 1}, {0.8f, 0.6f, 0.05f},
        {0.6f, 0.1f, 0.8f}, {0.05f, 0.6f, 0.7f}};
    return tints[output % std::size(tints)];
}

glm::vec3 eye_tint(Eye eye)
{
    return eye == Eye::left ? glm::vec3(1, 0.08f, 0.05f) : eye == Eye::right ? glm::vec3(0.05f, 0.25f, 1) : glm::vec3(0.5f);
}

} // namespace starbow
