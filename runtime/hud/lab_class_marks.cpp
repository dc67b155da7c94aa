#include "lab_class_marks.h"
#include <array>
#include <cstdio>

namespace starbow {
namespace {

/// The palette of Okabe and Ito, Color Universal Design, 2008, whose colours differ for every kind of colour vision. Its
/// yellow is left out: it is too pale for a white page.
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"};

/// The outlines of the marks, as SVG paths around 0, about 5 pixels to each side. Colour and mark differ between neighbours,
/// so that a print without colours shows the groups as well.
constexpr const char* shapes[] = {"M-5 0A5 5 0 1 0 5 0A5 5 0 1 0 -5 0Z", "M-4.5 -4.5H4.5V4.5H-4.5Z", "M0 -6L5.6 4H-5.6Z",
    "M0 -6.2L6.2 0L0 6.2L-6.2 0Z", "M0 6L5.6 -4H-5.6Z", "M-1.9 -5.6H1.9V-1.9H5.6V1.9H1.9V5.6H-1.9V1.9H-5.6V-1.9H-1.9Z",
    "M0 -6.5L1.8 -2.2L6.4 -2L2.8 0.9L4 5.4L0 2.9L-4 5.4L-2.8 0.9L-6.4 -2L-1.8 -2.2Z",
    "M-6 -3.2L-3.2 -6L0 -2.8L3.2 -6L6 -3.2L2.8 0L6 3.2L3.2 6L0 2.8L-3.2 6L-6 3.2L-2.8 0Z"};
constexpr std::size_t colour_count = std::size(colours), shape_count = std::size(shapes);
static_assert(colour_count * shape_count == most_groups); // 7 and 8 have no common divisor: each pair comes once

const char* colour_of(std::size_t group) { return colours[group % colour_count]; }
std::size_t shape_of(std::size_t group) { return group % shape_count; }

} // namespace

std::string figure(double value, const char* form)
{
    std::array<char, 400> text;
    std::snprintf(text.data(), text.size(), form, value);
    return text.data();
}

void draw_group_mark(Svg& svg, std::size_t group, bool by_eye, glm::dvec2 at)
{
    svg.raw("<use href=\"#m" + std::to_string(shape_of(group)) + "\" transform=\"translate(" + shortest(at.x) + ' '
        + shortest(at.y) + (by_eye ? ")scale(1.4)\" " : ")\" ")
        + (by_eye ? "fill=\"none\" stroke=\"" : "stroke=\"#fff\" stroke-width=\"0.6\" fill=\"") + colour_of(group)
        + (by_eye ? "\" stroke-width=\"1.2\"/>" : "\"/>"));
}

std::string group_mark(std::size_t group, bool by_eye)
{
    Svg svg;
    draw_group_mark(svg, group, by_eye, {8, 8});
    return svg.drawn({16, 16}, "class=\"key\"");
}

std::string group_mark_shapes()
{
    Svg svg;
    svg.raw("<defs>");
    for (std::size_t i = 0; i < shape_count; ++i)
        svg.path(shapes[i], attribute("id", "m" + std::to_string(i)));
    svg.raw("</defs>");
    return svg.drawn({0, 0}, "width=\"0\" height=\"0\" style=\"position:absolute;width:0\"");
}

} // namespace starbow
