#include "floor_plan_table.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

std::string degrees(double deg) { return short_number(deg) + "°"; }
std::string range(double from, double to) { return degrees(from) + " to " + degrees(to); }

std::string printed(const char* format, double number)
{
    char text[64];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string words(const Turn& turn)
{
    std::string all;
    const auto add = [&](double deg, const char* way, const char* other) {
        if (deg != 0)
            all += (all.empty() ? ", turned " : ", ") + degrees(std::abs(deg)) + (deg > 0 ? way : other);
    };
    add(turn.yaw_deg, " right", " left");
    add(turn.pitch_deg, " up", " down");
    add(turn.roll_deg, " clockwise", " counterclockwise");
    return all;
}

std::string words(const Sides& sides)
{
    return range(sides.left_deg, sides.right_deg) + " across, " + range(sides.down_deg, sides.up_deg) + " high";
}

std::string words(const Planar& planar)
{
    return "window, " + (planar.sides ? words(*planar.sides) : degrees(planar.fov_y_deg) + " high") + words(planar.turn);
}

std::string words(const Wall& wall)
{
    if (wall.upper_right_m)
        return "picture on a wall, " + printed("%.3f and ", glm::distance(wall.lower_left_m, wall.lower_right_m))
            + printed("%.3f m wide", glm::distance(wall.upper_left_m, *wall.upper_right_m));
    return "wall, " + printed("%.3f x ", glm::distance(wall.lower_left_m, wall.lower_right_m))
        + printed("%.3f m", glm::distance(wall.lower_left_m, wall.upper_left_m));
}

std::string words(const Fisheye& fisheye)
{
    const char* mappings[]{"equidistant", "equisolid", "stereographic", "orthographic"};
    std::string all
        = std::string("fisheye (") + mappings[int(fisheye.mapping)] + "), " + degrees(fisheye.aperture_deg) + " across";
    if (fisheye.tilt_deg != 0)
        all += ", tilted " + degrees(fisheye.tilt_deg);
    if (fisheye.rotation_deg != 0)
        all += ", rotated " + degrees(fisheye.rotation_deg);
    if (fisheye.diameter != 1 || fisheye.centre != glm::dvec2(0.5))
        all += ", circle of " + printed("%.3g", fisheye.diameter) + " at " + printed("%.3g, ", fisheye.centre.x)
            + printed("%.3g", fisheye.centre.y);
    return all;
}

std::string words(const Cylinder& cylinder) { return "cylinder, " + words(cylinder.sides) + words(cylinder.turn); }

std::string words(const Equirectangular& equirectangular)
{
    return "equirectangular, " + words(equirectangular.sides) + words(equirectangular.turn);
}

std::string words(const CubeFaces& cube)
{
    return (cube.arrangement == CubeFaces::Arrangement::row ? "cube faces in a row" : "cube faces in a cross")
        + words(cube.turn);
}

std::string words(const SphericalMirror& mirror)
{
    return "spherical mirror, radius " + printed("%.3f m, ", mirror.mirror_radius_m) + "in a dome of "
        + degrees(mirror.dome_aperture_deg) + ", radius " + printed("%.3f m", mirror.dome_radius_m)
        + (mirror.dome_tilt_deg != 0 ? ", tilted " + degrees(mirror.dome_tilt_deg) : "");
}

std::string words(const Lens& lens)
{
    return std::string("headset lens (") + (lens.form == Lens::Form::vive ? "vive" : "panotools") + "), flat picture "
        + degrees(lens.fov_y_deg) + " high" + words(lens.turn);
}

std::string projection_words(const Viewport& viewport)
{
    std::string all = "the warp file's own";
    if (viewport.projection_given || !viewport.warp)
        all = std::visit([](const auto& projection) { return words(projection); }, viewport.projection);
    return all + (viewport.warp ? "; bent by " + viewport.warp->file.filename().string() : "");
}

std::string eye_words(Eye eye) { return eye == Eye::left ? ", left eye" : eye == Eye::right ? ", right eye" : ""; }

const std::string both_eyes = ", both eyes";

std::string percent(double part) { return short_number(100 * part) + " %"; }

} // namespace

std::string short_number(double number)
{
    const double tenths = std::round(number * 10) / 10;
    const std::string digits = printed(tenths == std::round(tenths) ? "%.0f" : "%.1f", std::abs(tenths));
    return tenths < 0 ? "−" + digits : digits;
}

std::string viewport_name(const Layout& layout, int output, int viewport)
{
    const Output& of = layout.outputs[output];
    return of.viewports.size() > 1 ? of.name + "/" + std::to_string(viewport) : of.name;
}

std::string packing_words(Packing packing)
{
    constexpr std::array words{"", "side by side", "side by side, half", "top and bottom", "top and bottom, half",
        "eyes by rows", "eyes by columns", "checkerboard", "anaglyph, red and cyan", "anaglyph (Dubois)",
        "anaglyph, amber and blue"};
    return words[std::size_t(packing)];
}

std::vector<FloorPlanRow> floor_plan_rows(const Layout& layout, const std::vector<Coverage>& coverages)
{
    std::vector<FloorPlanRow> rows;
    for (const Coverage& c : coverages) {
        const Viewport& viewport = layout.outputs[c.output].viewports[c.viewport];
        const std::string name = viewport_name(layout, c.output, c.viewport);
        FloorPlanRow row;
        row.output = c.output;
        row.name = name + eye_words(c.eye);
        row.projection = projection_words(viewport);
        row.pixels = std::to_string(c.size.x) + " x " + std::to_string(c.size.y);
        row.sky = percent(c.share);
        if (c.most > 0)
            row.per_degree = (c.middle > 0 ? short_number(c.middle) + " in the middle, " : "") + short_number(c.least)
                + " to " + short_number(c.most);
        if (c.outlines.empty())
            row.spans = c.most > 0 ? "too little to measure" : "nothing";
        else
            row.spans = (c.azimuths ? "azimuth " + range(c.azimuths->x, c.azimuths->y) : "all around") + ", elevation "
                + range(c.elevations.x, c.elevations.y);
        const auto alike = std::find_if(rows.begin(), rows.end(), [&](const FloorPlanRow& other) {
            return other.name == name + eye_words(Eye::left) && c.eye == Eye::right && other.spans == row.spans
                && other.sky == row.sky && other.per_degree == row.per_degree;
        });
        if (alike != rows.end())
            alike->name = name + both_eyes;
        else
            rows.push_back(row);
    }
    return rows;
}

std::vector<std::string> overlap_lines(const Layout& layout, const std::vector<Coverage>& coverages)
{
    struct Pair {
        double part;
        std::string line;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < coverages.size(); ++i)
        for (std::size_t j = i + 1; j < coverages.size(); ++j) {
            const Coverage &a = coverages[i], &b = coverages[j];
            if (a.eye != b.eye || a.observer != b.observer)
                continue;
            const double of_a = shared_part(a, b), of_b = shared_part(b, a);
            const std::string first = viewport_name(layout, a.output, a.viewport),
                              second = viewport_name(layout, b.output, b.viewport);
            if (std::max(of_a, of_b) <= 1e-3)
                continue;
            const auto line = [&](const std::string& eyes) {
                return first + " and " + second + eyes + ": " + percent(of_a) + " of " + first + ", " + percent(of_b)
                    + " of " + second;
            };
            const auto alike = std::find_if(pairs.begin(), pairs.end(),
                [&](const Pair& other) { return a.eye == Eye::right && other.line == line(eye_words(Eye::left)); });
            if (alike != pairs.end())
                alike->line = line(both_eyes);
            else
                pairs.push_back({std::max(of_a, of_b), line(eye_words(a.eye))});
        }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.part > b.part; });
    std::vector<std::string> lines;
    for (const Pair& pair : pairs)
        lines.push_back(pair.line);
    return lines;
}

} // namespace starbow
