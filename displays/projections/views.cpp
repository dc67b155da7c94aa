#include "views.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// An eye's part of the output: scale and offset of viewports' fractions, and the squeeze of the eye's picture.
struct Share {
    glm::dvec2 scale{1}, offset{0}, squeeze{1};
    int canvas = 0;
};

Share share(Packing packing, Eye eye)
{
    const double second = eye == Eye::right ? 1 : 0;
    switch (packing) {
    case Packing::mono:
        return {};
    case Packing::side_by_side:
        return {{0.5, 1}, {0.5 * second, 0}};
    case Packing::side_by_side_half:
        return {{0.5, 1}, {0.5 * second, 0}, {2, 1}};
    case Packing::top_and_bottom:
        return {{1, 0.5}, {0, 0.5 * second}};
    case Packing::top_and_bottom_half:
        return {{1, 0.5}, {0, 0.5 * second}, {1, 2}};
    default:
        return {{1, 1}, {0, 0}, {1, 1}, int(second)};
    }
}

double side(Eye eye) { return eye == Eye::left ? -1 : eye == Eye::right ? 1 : 0; }

View make_view(const Layout& layout, std::size_t output, std::size_t viewport, Eye eye, const Share& share, glm::ivec2 size)
{
    Viewport own = layout.outputs[output].viewports[viewport];
    own.rect = {glm::dvec2(own.rect) * share.scale + share.offset, glm::dvec2(own.rect.z, own.rect.w) * share.scale};
    const glm::ivec4 rect = pixel_rect(own, size);
    View view{output, viewport};
    view.canvas = share.canvas;
    view.corner = {rect.x, rect.y};
    view.size = glm::max(glm::ivec2(rect.z, rect.w), 1);
    view.eye = eye;
    view.observer = own.observer;
    view.projection_given = own.projection_given;
    view.head_m = own.eye_m;
    view.picture_from_pixel = share.squeeze;
    const glm::dvec3 apart(side(eye) * 0.5 * layout.stereo.separation_m, 0, 0);
    view.picture = {own.projection, glm::ivec2(glm::dvec2(view.size) * share.squeeze), own.eye_m + apart};
    return view;
}

/// Adds a preview of an output: the same pictures on fewer pixels. It shows the left eye's picture where eyes share pixels.
void add_small(std::vector<View>& all, const Layout& layout, std::size_t output, const glm::ivec4& cell)
{
    const glm::ivec2 whole = layout.outputs[output].size;
    for (View view : views_of(layout, output, whole)) {
        if (view.canvas > 0)
            continue;
        const glm::dvec2 shrink = glm::dvec2(cell.z, cell.w) / glm::dvec2(whole);
        const glm::ivec2 low = glm::round(glm::dvec2(view.corner) * shrink);
        const glm::ivec2 high = glm::round(glm::dvec2(view.corner + view.size) * shrink);
        const glm::ivec2 large = view.size;
        view.corner = glm::ivec2(cell.x, cell.y) + low;
        view.size = glm::max(high - low, 1);
        view.picture_from_pixel *= glm::dvec2(large) / glm::dvec2(view.size);
        all.push_back(view);
    }
}

} // namespace

std::vector<int> layers_of(const Output& output)
{
    std::vector<int> layers;
    for (const Viewport& viewport : output.viewports) {
        const auto taken = [&](int layer) {
            for (std::size_t i = 0; i < layers.size(); ++i)
                if (layers[i] == layer && overlap(viewport, output.viewports[i]))
                    return true;
            return false;
        };
        int layer = 0;
        while (taken(layer))
            ++layer;
        layers.push_back(layer);
    }
    return layers;
}

int canvas_count(Packing packing) { return packing >= Packing::rows ? 2 : 1; }

std::vector<glm::ivec4> preview_cells(const Layout& layout, std::size_t preview, glm::ivec2 size)
{
    const int shown = std::max(1, int(layout.outputs.size()) - 1);
    // Finds the number of columns with the largest cells; pictures keep their shapes.
    std::vector<glm::ivec4> best;
    double most = -1;
    for (int columns = 1; columns <= shown; ++columns) {
        const int rows = (shown + columns - 1) / columns;
        constexpr int gap = 4;
        const glm::dvec2 cell = glm::max((glm::dvec2(size) - double(gap)) / glm::dvec2(columns, rows) - double(gap), 1.0);
        std::vector<glm::ivec4> cells;
        double area = 0;
        int index = 0;
        for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
            if (i == preview) {
                cells.push_back(glm::ivec4(0));
                continue;
            }
            const glm::dvec2 whole = layout.outputs[i].size;
            const double scale = std::min(cell.x / whole.x, cell.y / whole.y);
            const glm::dvec2 own = glm::max(glm::floor(whole * scale), 1.0);
            const glm::dvec2 from = glm::dvec2(index % columns, index / columns) * (cell + double(gap)) + double(gap);
            const glm::ivec2 corner = from + glm::floor((cell - own) / 2.0);
            cells.push_back({corner, glm::ivec2(own)});
            area += own.x * own.y;
            ++index;
        }
        if (area > most)
            most = area, best = cells;
    }
    return best;
}

std::vector<View> views_of(const Layout& layout, std::size_t output, glm::ivec2 size)
{
    const Output& own = layout.outputs[output];
    std::vector<View> all;
    if (own.preview) {
        const std::vector<glm::ivec4> cells = preview_cells(layout, output, size);
        for (std::size_t i = 0; i < layout.outputs.size(); ++i)
            if (i != output)
                add_small(all, layout, i, cells[i]);
        return all;
    }
    for (std::size_t i = 0; i < own.viewports.size(); ++i)
        if (own.packing == Packing::mono)
            all.push_back(make_view(layout, output, i, own.viewports[i].eye, {}, size));
        else
            for (Eye eye : {Eye::left, Eye::right})
                all.push_back(make_view(layout, output, i, eye, share(own.packing, eye), size));
    const std::vector<int> layers = layers_of(own);
    for (View& view : all)
        view.layer = layers[view.viewport];
    return all;
}

} // namespace starbow
