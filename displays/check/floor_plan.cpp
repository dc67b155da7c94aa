#include "floor_plan.h"
#include "config/markup/svg.h"
#include "config/model/angles.h"
#include "config/model/turn.h"
#include "displays/projections/views.h"
#include "displays/projections/wall.h"
#include "floor_plan_table.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

/// Colours that are distinct for people with any colour vision (Okabe and Ito 2008), then repeated.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#a07800", "#3a9bd9", "#7a4fa3", "#555555"};
const char* colour_of(int output) { return colours[std::size_t(output) % colours.size()]; }

constexpr double margin = 40, map_width = 1000, map_left = margin + 46, column_left = map_left + map_width + 54,
                 column_width = 460, page_width = column_left + column_width + margin;

struct Box {
    glm::dvec2 from, to;
};

bool meet(const Box& a, const Box& b)
{
    return a.from.x < b.to.x && b.from.x < a.to.x && a.from.y < b.to.y && b.from.y < a.to.y;
}

std::size_t letters(const std::string& text)
{
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; })); // of UTF-8
}

/// An upper estimate of a text's width in fonts without serifs.
double width_of(const std::string& text, double size) { return double(letters(text)) * size * 0.56; }
double bold_width(const std::string& text, double size) { return double(letters(text)) * size * 0.69; }

std::string shortened(const std::string& text, std::size_t most)
{
    return text.size() <= most ? text : text.substr(0, most - 1) + "…"; // names are ASCII
}

/// Breaks a text into lines of at most `width`, between words, and within words that are too long.
std::vector<std::string> wrapped(const std::string& text, double width, double size)
{
    const auto fits = [&](const std::string& line) { return width_of(line, size) <= width; };
    std::vector<std::string> lines{""};
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        std::string word = text.substr(at, end - at);
        at = end + 1;
        if (!lines.back().empty() && !fits(lines.back() + " " + word))
            lines.emplace_back();
        else if (!lines.back().empty())
            lines.back() += ' ';
        for (char c : word) {
            if (!fits(lines.back() + c) && (c & 0xc0) != 0x80)
                lines.emplace_back();
            lines.back() += c;
        }
    }
    return lines;
}

void write(Svg& svg, glm::dvec2 at, const std::string& words, double size = 13, const std::string& more = {})
{
    svg.text(at, words, attribute("font-size", shortest(size)) + ' ' + more);
}

void rect(Svg& svg, const Box& box, const std::string& more) { svg.rect(box.from, box.to, more); }

void heading(Svg& svg, glm::dvec2 at, const std::string& words) { write(svg, at, words, 17, "font-weight=\"bold\""); }

/// Writes a label centred at `at`, on a light ground that hides what is below.
void label(Svg& svg, glm::dvec2 at, const std::string& words, double size, const std::string& colour)
{
    const glm::dvec2 half(bold_width(words, size) / 2 + 3, size * 0.72);
    svg.rect(at - half, at + half, "rx=\"3\" fill=\"white\" fill-opacity=\"0.8\"");
    write(svg, at + glm::dvec2(0, size * 0.36), words, size,
        "font-weight=\"bold\" text-anchor=\"middle\" " + attribute("fill", colour));
}

Box around(glm::dvec2 at, const std::string& words, double size)
{
    const glm::dvec2 half(bold_width(words, size) / 2 + 4, size * 0.8);
    return {at - half, at + half};
}

/// A map of the sky: straight ahead is in the middle, and degrees have the same length across and up.
class Map {
public:
    Map(Svg& svg, const Layout& layout, const std::vector<Coverage>& all, const std::optional<HudPlacement>& hud, Eye eye,
        double top, int number)
        : svg_(svg)
        , layout_(layout)
        , hud_(hud)
        , top_(top)
        , number_(number)
    {
        for (const Coverage& coverage : all)
            if (coverage.eye == eye)
                shown_.push_back(&coverage);
    }

    static constexpr double scale = map_width / 360, height = 180 * scale;

    void draw()
    {
        const std::string clip = "map" + std::to_string(number_);
        const Box whole{at({-180, 90}), at({180, -90})};
        svg_.raw("<clipPath " + attribute("id", clip) + '>');
        rect(svg_, whole, "");
        svg_.raw("</clipPath>");
        rect(svg_, whole, "fill=\"#fbfbf8\"");
        graticule();
        svg_.raw("<g clip-path=\"url(#" + clip + ")\">");
        for (const Coverage* coverage : shown_)
            region(*coverage);
        if (hud_)
            hud(*hud_);
        svg_.raw("</g>");
        rect(svg_, whole, "fill=\"none\" stroke=\"#444\"");
        for (const Coverage* coverage : shown_)
            name(*coverage);
    }

private:
    glm::dvec2 at(glm::dvec2 deg) const { return {map_left + (deg.x + 180) * scale, top_ + (90 - deg.y) * scale}; }

    void graticule()
    {
        const char *thin = "stroke=\"#d8d8d2\"", *thick = "stroke=\"#a8a8a0\"";
        for (int azimuth = -180; azimuth <= 180; azimuth += 30) {
            svg_.line(at({azimuth, 90}), at({azimuth, -90}), azimuth % 90 == 0 ? thick : thin);
            const char* word = azimuth == 0 ? " ahead" : azimuth == 90 ? " right" : azimuth == -90 ? " left" : "";
            write(svg_, at({azimuth, -90}) + glm::dvec2(0, 17), short_number(azimuth) + "°" + word, 12,
                "text-anchor=\"middle\"");
        }
        for (int elevation = -90; elevation <= 90; elevation += 30) {
            svg_.line(at({-180, elevation}), at({180, elevation}), elevation == 0 ? thick : thin);
            write(svg_, at({-180, elevation}) + glm::dvec2(-7, 4), short_number(elevation) + "°", 12, "text-anchor=\"end\"");
        }
        svg_.line(at({0, 0}) - glm::dvec2(7, 0), at({0, 0}) + glm::dvec2(7, 0), "stroke=\"#444\" stroke-width=\"1.5\"");
        svg_.line(at({0, 0}) - glm::dvec2(0, 7), at({0, 0}) + glm::dvec2(0, 7), "stroke=\"#444\" stroke-width=\"1.5\"");
    }

    void region(const Coverage& coverage)
    {
        const char* colour = colour_of(coverage.output);
        if (coverage.outlines.empty())
            return;
        std::string inside, border;
        for (const auto& outline : coverage.outlines) {
            std::vector<glm::dvec2> points;
            for (const glm::dvec2& deg : outline)
                points.push_back(at(deg));
            inside += path_data(points, true);
            // Along the map's edge the shown part continues at the other side: no line there.
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const std::size_t next = (i + 1) % outline.size();
                const auto edge
                    = [](double x, double y, double of) { return std::abs(x) > of - 0.26 && std::abs(y) > of - 0.26; };
                if (!edge(outline[i].x, outline[next].x, 180) && !edge(outline[i].y, outline[next].y, 90))
                    border += path_data(std::array{points[i], points[next]});
            }
        }
        svg_.path(inside, "class=\"shown\" fill-opacity=\"0.26\" fill-rule=\"evenodd\" " + attribute("fill", colour));
        svg_.path(border, "fill=\"none\" stroke-width=\"1.8\" stroke-linejoin=\"round\" " + attribute("stroke", colour));
    }

    void hud(const HudPlacement& hud)
    {
        const glm::dvec2 middle(hud.azimuth_deg, hud.elevation_deg), half(hud.width_deg / 2, 0);
        svg_.line(at(middle - half), at(middle + half), "stroke=\"#222\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"");
        const glm::dvec2 below = at(middle) + glm::dvec2(0, 13);
        label(svg_, below, "head-up display", 11, "#222");
        taken_.push_back(around(below, "head-up display", 11));
        taken_.push_back({at({0, 0}) - 8., at({0, 0}) + 8.}); // the cross straight ahead
    }

    bool shows(const Coverage& coverage, glm::dvec2 place) const
    {
        const glm::dvec2 deg((place.x - map_left) / scale - 180, 90 - (place.y - top_) / scale);
        const glm::ivec2 cell(glm::floor((deg + glm::dvec2(180, 90)) * double(lattice)));
        return cell.x >= 0 && cell.y >= 0 && cell.x < lattice_columns && cell.y < lattice_rows
            && coverage.cells[std::size_t(cell.y) * lattice_columns + cell.x];
    }

    /// Places the name in the shown part: apart from other names, where few other views are shown, and near the middle.
    void name(const Coverage& coverage)
    {
        const std::string words = shortened(viewport_name(layout_, coverage.output, coverage.viewport), 20);
        const char* colour = colour_of(coverage.output);
        constexpr double size = 13;
        std::vector<glm::dvec2> candidates; // degrees
        glm::dvec3 sum(0);
        for (int row = 1; row < lattice_rows; row += 3)
            for (int column = 1; column < lattice_columns; column += 3)
                if (const glm::dvec2 deg = lattice_point(column, row); shows(coverage, at(deg))) {
                    candidates.push_back(deg);
                    sum += direction_of(deg) * std::cos(glm::radians(deg.y));
                }
        if (candidates.empty() && coverage.looks) { // the part is too small for the lattice
            const glm::dvec2 spot = at(azimuth_elevation_deg(*coverage.looks));
            svg_.circle(spot, 4, "fill=\"none\" stroke-width=\"1.8\" " + attribute("stroke", colour));
            label(svg_, spot + glm::dvec2(0, spot.y > top_ + 40 ? -18 : 18), words, size, colour);
        }
        const glm::dvec3 middle = glm::length(sum) > 0 ? glm::normalize(sum) : glm::dvec3(0, 0, -1);
        double best = -1e9;
        glm::dvec2 found(0);
        for (const glm::dvec2& deg : candidates) {
            const Box box = around(at(deg), words, size);
            if (box.from.x < map_left + 8 || box.from.y < top_ + 8 || box.to.x > map_left + map_width - 8
                || box.to.y > top_ + height - 8)
                continue;
            double score = -std::acos(glm::dot(direction_of(deg), middle)) * 4 - std::abs(deg.x) / 100;
            for (double x : {0., 0.5, 1.})
                for (double y : {0., 0.5, 1.}) {
                    const glm::dvec2 probe = glm::mix(box.from, box.to, glm::dvec2(x, y));
                    score += shows(coverage, probe) ? 10 : 0;
                    for (const Coverage* other : shown_)
                        score -= other != &coverage && shows(*other, probe) ? 1 : 0;
                }
            for (const Box& other : taken_)
                score -= meet(box, other) ? 200 : 0;
            if (score > best) {
                best = score;
                found = at(deg);
            }
        }
        if (best == -1e9)
            return;
        taken_.push_back(around(found, words, size));
        label(svg_, found, words, size, colour);
    }

    Svg& svg_;
    const Layout& layout_;
    const std::optional<HudPlacement>& hud_;
    double top_;
    int number_;
    std::vector<const Coverage*> shown_;
    std::vector<Box> taken_;
};

/// A part of an output that shows an eye's picture, as fractions of the output.
struct Part {
    Box box;
    Eye eye;
};

std::vector<Part> parts(Packing packing)
{
    switch (packing) {
    case Packing::side_by_side:
    case Packing::side_by_side_half:
        return {{{{0, 0}, {0.5, 1}}, Eye::left}, {{{0.5, 0}, {1, 1}}, Eye::right}};
    case Packing::top_and_bottom:
    case Packing::top_and_bottom_half:
        return {{{{0, 0}, {1, 0.5}}, Eye::left}, {{{0, 0.5}, {1, 1}}, Eye::right}};
    default:
        return {{{{0, 0}, {1, 1}}, Eye::middle}};
    }
}

const char* eye_letter(Eye eye) { return eye == Eye::left ? "L" : eye == Eye::right ? "R" : ""; }

/// Draws one output as a rectangle with its viewports into `box`; returns its lower end.
double draw_output(Svg& svg, const Layout& layout, int number, const Box& box)
{
    const Output& output = layout.outputs[number];
    const char* colour = colour_of(number);
    const double room = box.to.x - box.from.x;
    write(svg, box.from + glm::dvec2(0, 14), shortened(output.name, std::size_t(room / 9)), 14,
        "font-weight=\"bold\" " + attribute("fill", colour));
    std::string words = std::to_string(output.size.x) + " x " + std::to_string(output.size.y);
    if (output.resizable)
        words += ", resizable";
    if (output.packing != Packing::mono)
        words += ", " + packing_words(output.packing);
    if (output.preview)
        words += ", the operator's preview";
    double y = box.from.y + 20;
    for (const std::string& line : wrapped(words, room, 12))
        write(svg, {box.from.x, y += 14}, line, 12, "fill=\"#444\"");
    y += 8;
    const double scale = std::min(room / output.size.x, (box.to.y - y) / output.size.y);
    const glm::dvec2 corner(box.from.x, y), size = glm::max(glm::dvec2(output.size) * scale, glm::dvec2(2));
    rect(svg, {corner, corner + size}, "fill=\"#f0f0ec\" stroke=\"#444\"");
    const std::vector<int> layers = layers_of(output);
    for (const Part& part : parts(output.packing))
        for (std::size_t v = 0; v < output.viewports.size(); ++v) {
            const Viewport& viewport = output.viewports[v];
            if (part.eye != Eye::middle && viewport.eye != Eye::middle && viewport.eye != part.eye)
                continue;
            const glm::dvec2 from(viewport.rect.x, viewport.rect.y), extent(viewport.rect.z, viewport.rect.w);
            const auto in = [&](glm::dvec2 at) { return corner + size * glm::mix(part.box.from, part.box.to, at); };
            const Box shown{in(from), in(from + extent)};
            rect(svg, shown,
                attribute("fill", colour) + ' ' + attribute("stroke", colour)
                    + " fill-opacity=\"0.26\" stroke-width=\"1.5\"");
            const Eye eye = part.eye == Eye::middle ? viewport.eye : part.eye;
            std::string name;
            if (output.viewports.size() > 1)
                name.append("/").append(std::to_string(v));
            if (eye != Eye::middle)
                name.append(name.empty() ? "" : " ").append(eye_letter(eye));
            const glm::dvec2 room_in = shown.to - shown.from;
            const glm::dvec2 middle = (shown.from + shown.to) / 2. + glm::dvec2(0, 28 * layers[v]); // names over each other
            const glm::ivec4 pixels = pixel_rect(viewport, output.size);
            const glm::dvec2 of = part.box.to - part.box.from;
            const std::string extent_words = std::to_string(int(std::round(pixels.z * of.x))) + " x "
                + std::to_string(int(std::round(pixels.w * of.y)));
            const bool several = output.viewports.size() > 1 || part.eye != Eye::middle;
            const bool sizes = several && width_of(extent_words, 11) < room_in.x - 4 && room_in.y > 34;
            if (!name.empty() && width_of(name, 13) < room_in.x - 2 && room_in.y > 15)
                write(svg, middle + glm::dvec2(0, sizes ? -2 : 4), name, 13, "font-weight=\"bold\" text-anchor=\"middle\"");
            if (sizes)
                write(svg, middle + glm::dvec2(0, name.empty() ? 4 : 13), extent_words, 11, "text-anchor=\"middle\"");
        }
    return y + size.y;
}

double draw_outputs(Svg& svg, const Layout& layout, double top)
{
    heading(svg, {column_left, top + 14}, "Outputs");
    const int count = int(layout.outputs.size()), columns = count <= 2 ? 1 : count <= 6 ? 2 : 3;
    const double gap = 24, width = (column_width - gap * (columns - 1)) / columns;
    const double tallest = columns == 1 ? (count == 1 ? 380 : 300) : columns == 2 ? 210 : 150;
    double y = top + 26;
    for (int first = 0; first < count; first += columns) {
        double lowest = y;
        for (int i = first; i < std::min(first + columns, count); ++i) {
            const double left = column_left + (i - first) * (width + gap);
            lowest = std::max(lowest, draw_output(svg, layout, i, {{left, y}, {left + width, y + tallest}}));
        }
        y = lowest + 22;
    }
    return y;
}

/// Draws the room from above; ahead is up.
class Room {
public:
    Room(const Layout& layout, Svg& svg)
        : layout_(layout)
        , svg_(svg)
    {
        each([&](const Output&, int, const Viewport& viewport) {
            note(viewport.eye_m);
            placed_ |= viewport.eye_m != glm::dvec3(0);
            if (const Wall* wall = std::get_if<Wall>(&viewport.projection)) {
                placed_ = true;
                for (const glm::dvec3& corner : corners(*wall))
                    note(corner);
            }
            if (const SphericalMirror* mirror = std::get_if<SphericalMirror>(&viewport.projection)) {
                placed_ = true;
                note(mirror->projector_m);
                for (double side : {-1., 1.}) {
                    note(mirror->mirror_m + side * mirror->mirror_radius_m);
                    note(mirror->dome_m + side * mirror->dome_radius_m);
                }
            }
        });
    }

    double draw(double top)
    {
        if (!placed_)
            return top;
        heading(svg_, {column_left, top + 14}, "The room from above, ahead is up");
        const double pad = 34, tallest = 420;
        const glm::dvec2 extent = glm::max(high_ - low_, glm::dvec2(0.1));
        scale_ = std::min((column_width - 2 * pad) / extent.x, (tallest - 2 * pad) / extent.y);
        const glm::dvec2 size(column_width, extent.y * scale_ + 2 * pad + 24);
        const glm::dvec2 corner(column_left, top + 26);
        origin_ = corner + glm::dvec2(column_width / 2 - (low_.x + high_.x) / 2 * scale_, pad - low_.y * scale_);
        frame_ = {corner, corner + size};
        rect(svg_, frame_, "fill=\"#fbfbf8\" stroke=\"#444\"");
        for (bool upright : {false, true})
            each([&](const Output&, int number, const Viewport& viewport) { things(viewport, number, upright); });
        eyes();
        each([&](const Output& output, int number, const Viewport& viewport) {
            const int v = int(&viewport - output.viewports.data());
            if (const Wall* wall = std::get_if<Wall>(&viewport.projection)) {
                const auto all = corners(*wall);
                name(at((all[0] + all[2]) / 2.), shortened(viewport_name(layout_, number, v), 20), colour_of(number));
            }
        });
        bar({corner.x + 14, corner.y + size.y - 14});
        return corner.y + size.y + 22;
    }

private:
    template <typename Do> void each(Do what)
    {
        for (std::size_t o = 0; o < layout_.outputs.size(); ++o)
            for (const Viewport& viewport : layout_.outputs[o].viewports)
                what(layout_.outputs[o], int(o), viewport);
    }

    static std::array<glm::dvec3, 4> corners(const Wall& wall) { return fitted_corners(wall).at; }

    void note(const glm::dvec3& place)
    {
        low_ = glm::min(low_, {place.x, place.z});
        high_ = glm::max(high_, {place.x, place.z});
    }

    glm::dvec2 at(const glm::dvec3& place) const { return origin_ + glm::dvec2(place.x, place.z) * scale_; }

    /// Draws floors and ceilings first, so that walls stay visible beside them.
    void things(const Viewport& viewport, int number, bool upright)
    {
        const char* colour = colour_of(number);
        if (const Wall* wall = std::get_if<Wall>(&viewport.projection)) {
            const auto all = corners(*wall);
            const glm::dvec3 normal = glm::normalize(glm::cross(all[1] - all[0], all[3] - all[0]));
            if ((std::abs(normal.y) < 0.7) != upright)
                return;
            std::vector<glm::dvec2> points;
            for (const glm::dvec3& corner : all)
                points.push_back(at(corner));
            svg_.path(path_data(points, true),
                "class=\"wall\" fill-opacity=\"0.12\" stroke-width=\"3\" stroke-linejoin=\"round\" "
                    + attribute("fill", colour) + ' ' + attribute("stroke", colour));
        }
        if (const SphericalMirror* mirror = std::get_if<SphericalMirror>(&viewport.projection); mirror && upright) {
            svg_.circle(at(mirror->dome_m), mirror->dome_radius_m * scale_,
                "fill=\"none\" stroke=\"#888\" stroke-width=\"2\" stroke-dasharray=\"6 4\"");
            svg_.circle(at(mirror->mirror_m), mirror->mirror_radius_m * scale_,
                "fill=\"#ddd\" stroke-width=\"2\" " + attribute("stroke", colour));
            const glm::dvec3 ahead = cockpit_from_picture(mirror->projector.turn) * glm::dvec3(0, 0, -1);
            const glm::dvec2 lens = at(mirror->projector_m), way(ahead.x, ahead.z);
            svg_.line(lens, lens + way * 26., "stroke-width=\"2\" " + attribute("stroke", colour));
            rect(svg_, {lens - 5., lens + 5.}, attribute("fill", colour));
            name(lens + glm::dvec2(0, 17), "projector", colour);
            name(at(mirror->mirror_m), "mirror", colour);
        }
    }

    void eyes()
    {
        std::vector<glm::dvec3> places;
        each([&](const Output&, int, const Viewport& viewport) {
            if (std::find(places.begin(), places.end(), viewport.eye_m) == places.end())
                places.push_back(viewport.eye_m);
        });
        for (const glm::dvec3& place : places) {
            const glm::dvec2 eye = at(place);
            // The visitor, who looks ahead.
            svg_.polygon(
                std::array{eye - glm::dvec2(0, 8), eye + glm::dvec2(-6, 3), eye + glm::dvec2(6, 3)}, "fill=\"#222\"");
            taken_.push_back({eye - 10., eye + 10.});
        }
        for (const glm::dvec3& place : places)
            name(at(place) + glm::dvec2(0, 18), places.size() == 1 ? "eye at height " + metres(place.y) : "eye", "#222");
    }

    static std::string metres(double m)
    {
        char text[32];
        std::snprintf(text, sizeof text, "%s%.3f m", m < 0 ? "−" : "", std::abs(m));
        return text;
    }

    /// Puts a label at the place, or at the nearest free one above or below it.
    void name(glm::dvec2 place, const std::string& words, const char* colour)
    {
        const double half = bold_width(words, 12) / 2 + 6;
        place.x = std::clamp(place.x, frame_.from.x + half, std::max(frame_.from.x + half, frame_.to.x - half));
        for (int i = 0; i < 24; ++i) {
            const glm::dvec2 tried = place + glm::dvec2(0, (i % 2 ? 1 : -1) * ((i + 1) / 2) * 9);
            const Box box = around(tried, words, 12);
            if (box.from.y < frame_.from.y || box.to.y > frame_.to.y)
                continue;
            if (std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return meet(box, other); })) {
                place = tried;
                break;
            }
        }
        taken_.push_back(around(place, words, 12));
        label(svg_, place, words, 12, colour);
    }

    void bar(glm::dvec2 corner)
    {
        double length = std::pow(10, std::floor(std::log10(120 / scale_)));
        for (double times : {5., 2.})
            if (length * times * scale_ <= 120) {
                length *= times;
                break;
            }
        svg_.line(corner, corner + glm::dvec2(length * scale_, 0), "stroke=\"#222\" stroke-width=\"3\"");
        char words[32];
        std::snprintf(words, sizeof words, "%g m", length);
        write(svg_, corner + glm::dvec2(length * scale_ + 8, 4), words, 12);
    }

    const Layout& layout_;
    Svg& svg_;
    bool placed_ = false;
    glm::dvec2 low_{0}, high_{0}; ///< x and z in metres
    double scale_ = 1;
    glm::dvec2 origin_{0};
    Box frame_{};
    std::vector<Box> taken_;
};

double draw_table(Svg& svg, const Layout& layout, const std::vector<Coverage>& coverages, double top)
{
    struct Column {
        const char* title;
        double width;
        std::string FloorPlanRow::*words;
    };
    const Column columns[]{{"Viewport", 215, &FloorPlanRow::name}, {"Projection", 435, &FloorPlanRow::projection},
        {"Spans", 405, &FloorPlanRow::spans}, {"Of the sky", 95, &FloorPlanRow::sky}, {"Pixels", 120, &FloorPlanRow::pixels},
        {"Pixels per degree", 285, &FloorPlanRow::per_degree}};
    constexpr double size = 13, step = 18;
    const double right = page_width - margin;
    double x = margin;
    for (const Column& column : columns) {
        write(svg, {x, top + 14}, column.title, 14, "font-weight=\"bold\"");
        x += column.width;
    }
    double y = top + 24;
    const std::vector<FloorPlanRow> rows = floor_plan_rows(layout, coverages);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        svg.line({margin, y}, {right, y}, "stroke=\"#c8c8c2\"");
        x = margin;
        std::size_t most = 1;
        for (const Column& column : columns) {
            const bool named = column.words == &FloorPlanRow::name;
            const auto lines = wrapped(rows[i].*column.words, column.width - (named ? 34 : 16), size);
            if (named)
                rect(svg, {{x, y + 6}, {x + 13, y + 19}},
                    attribute("fill", colour_of(rows[i].output)) + " fill-opacity=\"0.6\"");
            for (std::size_t n = 0; n < lines.size(); ++n)
                write(svg, {x + (named ? 20 : 0), y + step * double(n + 1)}, lines[n], size);
            most = std::max(most, lines.size());
            x += column.width;
        }
        y += step * double(most) + 8;
    }
    svg.line({margin, y}, {right, y}, "stroke=\"#c8c8c2\"");
    return y + 22;
}

double draw_overlaps(Svg& svg, const Layout& layout, const std::vector<Coverage>& coverages, double top)
{
    const std::vector<std::string> lines = overlap_lines(layout, coverages);
    if (coverages.size() < 2)
        return top;
    heading(svg, {margin, top + 14}, lines.empty() ? "No two viewports overlap" : "What they share");
    constexpr std::size_t most = 60;
    double y = top + 20;
    const std::size_t count = std::min(lines.size(), most), half = (count + 1) / 2;
    const double width = (page_width - 2 * margin) / 2;
    double lowest = y;
    for (std::size_t i = 0; i < count; ++i) {
        if (i == half)
            y = top + 20;
        for (const std::string& line : wrapped(lines[i], width - 20, 13))
            write(svg, {margin + (i < half ? 0 : width), y += 18}, line, 13);
        lowest = std::max(lowest, y);
    }
    if (lines.size() > most)
        write(svg, {margin, lowest += 18}, "and " + std::to_string(lines.size() - most) + " more", 13);
    return lowest + 22;
}

} // namespace

std::string draw_floor_plan(
    const Layout& layout, const std::vector<Coverage>& coverages, const std::optional<HudPlacement>& hud)
{
    Svg svg;
    svg.raw("<rect width=\"100%\" height=\"100%\" fill=\"white\"/>");
    write(svg, {margin, margin + 20}, layout.name.empty() ? "Layout" : layout.name, 26, "font-weight=\"bold\"");
    const bool two_eyes = !coverages.empty() && coverages.front().eye != Eye::middle;
    double left = margin + 44;
    int number = 0;
    for (Eye eye : two_eyes ? std::vector{Eye::left, Eye::right} : std::vector{Eye::middle}) {
        heading(svg, {map_left, left + 14},
            std::string("What the viewports show")
                + (eye == Eye::left         ? " the left eye"
                        : eye == Eye::right ? " the right eye"
                                            : ""));
        Map(svg, layout, coverages, hud, eye, left + 26, number++).draw();
        left += 26 + Map::height + 40;
    }
    double right = draw_outputs(svg, layout, margin + 44);
    right = Room(layout, svg).draw(right);
    double y = std::max(left, right) + 6;
    y = draw_table(svg, layout, coverages, y);
    y = draw_overlaps(svg, layout, coverages, y) + margin - 22;

    const glm::dvec2 size(page_width, y);
    return svg.drawn(size,
        attribute("width", shortest(size.x)) + ' ' + attribute("height", shortest(size.y))
            + " font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" fill=\"#111\"");
}

} // namespace starbow
