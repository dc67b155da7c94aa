#include "lab_class.h"
#include "config/json/csv.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include "lab_log.h"
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace starbow {
namespace {

/// Okabe and Ito, Color Universal Design, 2008: told apart by people with any kind of colour vision. Their yellow is too
/// pale for a white page.
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

std::string figure(double value, const char* form)
{
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), form, value);
    return text.data();
}

/// A mark at a place; hollow, and around a filled one, for what was seen.
void mark(Svg& svg, std::size_t group, bool by_eye, glm::dvec2 at)
{
    svg.raw("<use href=\"#m" + std::to_string(shape_of(group)) + "\" transform=\"translate(" + shortest(at.x) + ' '
        + shortest(at.y) + (by_eye ? ")scale(1.4)\" " : ")\" ")
        + (by_eye ? "fill=\"none\" stroke=\"" : "stroke=\"#fff\" stroke-width=\"0.6\" fill=\"") + colour_of(group)
        + (by_eye ? "\" stroke-width=\"1.2\"/>" : "\"/>"));
}

std::string key_mark(std::size_t group, bool by_eye)
{
    Svg svg;
    mark(svg, group, by_eye, {8, 8});
    return svg.drawn({16, 16}, "class=\"key\"");
}

std::string key_theory()
{
    Svg svg;
    svg.line({0, 8}, {16, 8}, "class=\"theory\"");
    return svg.drawn({16, 16}, "class=\"key\"");
}

/// The shapes of all marks, which show nothing here.
std::string mark_shapes()
{
    Svg svg;
    svg.raw("<defs>");
    for (std::size_t i = 0; i < shape_count; ++i)
        svg.path(shapes[i], attribute("id", "m" + std::to_string(i)));
    svg.raw("</defs>");
    return svg.drawn({0, 0}, "width=\"0\" height=\"0\" style=\"position:absolute;width:0\"");
}

std::string drawing(const LabClass& all, Plot plot, const Words& words)
{
    constexpr double width = 860, height = 500, left = 70, right = 800, top = 40, bottom = 440;
    std::vector<PlotPoint> points;
    for (const LabGroup& group : all.groups)
        points.insert(points.end(), group.points[std::size_t(plot)].begin(), group.points[std::size_t(plot)].end());
    constexpr std::size_t most_curves = 6;
    const std::vector<double> speeds = plot == Plot::doppler ? plot_speeds(points, most_curves) : std::vector<double>{0};
    const PlotAxes axes = plot_axes(plot, points, speeds);
    const auto x_of = [&](double x) { return left + (right - left) * axes.across(x); };
    const auto y_of = [&](double y) { return bottom - (bottom - top) * axes.up(y); };
    const PlotWords& keys = plot_words[std::size_t(plot)];

    Svg svg;
    for (double x : axes.x_ticks) {
        svg.line({x_of(x), top}, {x_of(x), bottom}, "class=\"grid\"");
        svg.text({x_of(x), bottom + 20}, words.number(figure(x, "%.6g")), "text-anchor=\"middle\"");
    }
    for (double y : axes.y_ticks) {
        svg.line({left, y_of(y)}, {right, y_of(y)}, "class=\"grid\"");
        svg.text({left - 8, y_of(y) + 5}, words.number(figure(y, "%.6g")), "text-anchor=\"end\"");
    }
    svg.text({right, bottom + 48}, words(keys.x), "text-anchor=\"end\"");
    svg.text({left - 50, top - 18}, words(keys.y));
    std::vector<double> labelled;
    for (double speed : speeds) {
        std::vector<glm::dvec2> curve = theory_curve(plot, speed);
        for (glm::dvec2& at : curve)
            at = {x_of(at.x), y_of(at.y)};
        svg.path(path_data(curve), "class=\"theory\"");
        const double y = curve.back().y;
        if (plot != Plot::doppler
            || std::any_of(labelled.begin(), labelled.end(), [&](double other) { return std::abs(y - other) < 15; }))
            continue;
        labelled.push_back(y);
        svg.text({right + 4, y + 4}, "β " + words.number(figure(speed / std::hypot(1.0, speed), "%.3g")), "class=\"speed\"");
    }
    // A mark on the same place as another of its group would only make the page larger.
    for (std::size_t i = 0; i < all.groups.size(); ++i) {
        std::set<std::array<long, 3>> drawn;
        for (const PlotPoint& point : all.groups[i].points[std::size_t(plot)]) {
            const double x = x_of(point.x), y = y_of(point.y);
            if (point.y > 0 && x >= left - 1 && x <= right + 1 && y >= top - 1 && y <= bottom + 1
                && drawn.insert({std::lround(x), std::lround(y), point.by_eye}).second)
                mark(svg, i, point.by_eye, {x, y});
        }
    }
    return svg.drawn({width, height}, "role=\"img\" " + attribute("aria-label", escaped_html(words(keys.title))));
}

/// A mean with its sign, and a spread, in percent.
std::string percent(double part, bool sign, const Words& words)
{
    std::string text = words.number(figure(100 * part, sign ? "%+.3f" : "%.3f"));
    if (text.find_first_of("123456789") == text.npos)
        text.erase(0, text.find('0')); // nothing has no sign
    if (text.starts_with('-'))
        text.replace(0, 1, "−");
    return text + " %";
}

std::string table(const LabClass& all, Plot plot, const Words& words)
{
    std::ostringstream out;
    out << "<table>\n<tr><th>" << words("class.group") << "</th><th></th><th>" << words("class.count") << "</th><th>"
        << words("class.mean") << "</th><th>" << words("class.spread") << "</th></tr>\n";
    for (std::size_t i = 0; i < all.groups.size(); ++i)
        for (const bool by_eye : {false, true}) {
            const Deviation deviation = deviation_of(all.groups[i].points[std::size_t(plot)], by_eye);
            if (deviation.count == 0)
                continue;
            out << "<tr><td>" << key_mark(i, by_eye) << ' ' << escaped_html(all.groups[i].name) << "</td><td>"
                << words(by_eye ? "class.by_eye"_key : "class.read"_key) << "</td><td>" << deviation.count << "</td><td>"
                << percent(deviation.mean, true, words) << "</td><td>"
                << (deviation.count > 1 ? percent(deviation.spread, false, words) : "—") << "</td></tr>\n";
        }
    out << "</table>\n";
    return out.str();
}

} // namespace

std::string class_header() { return "group," + log_header(); }

void add_group(LabClass& all, const std::string& name, std::string_view bytes, const std::string& file,
    const std::function<void(double)>& progress)
{
    const auto texts = lab_texts(bytes, file);
    if (texts.empty())
        throw InputError(one_line(file)
            + ":1: has the names of a log and no line of measurements; a log in which K has written at least one is right");
    LabGroup group{.name = name, .lines = long(texts.size())};
    const std::string begin = csv_cell(name) + ",";
    std::string csv;
    LabLine before;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        LabLine now = read_lab_line(texts[i].second, file, texts[i].first);
        for (std::size_t plot = 1; plot < plot_names.size(); ++plot)
            add_points(group.points[plot], Plot(plot), i > 0 ? &before : nullptr, now);
        csv.append(begin).append(texts[i].second).append("\r\n");
        before = std::move(now);
        if (progress && i % 4096 == 0)
            progress(double(texts[i].second.data() - bytes.data()) / double(bytes.size()));
    }
    if (all.csv.empty())
        all.csv = class_header() + "\r\n";
    all.csv += csv;
    all.groups.push_back(std::move(group));
}

std::string class_page(const LabClass& all, const Words& words)
{
    std::ostringstream out;
    out << page_begin(words.language, words("class.title"),
        "text{font-size:14px}svg.key{width:1.1em;height:1.1em;vertical-align:-.2em}.grid{stroke:#ddd;fill:none}"
        ".theory{stroke:#777;stroke-width:1.5;fill:none}.speed{font-size:12px;fill:#555}"
        ".legend span{margin-right:1.5em;white-space:nowrap}")
        << mark_shapes() << "<h1>" << escaped_html(words("class.title")) << "</h1>\n<p class=\"legend\">";
    for (std::size_t i = 0; i < all.groups.size(); ++i)
        out << "<span>" << key_mark(i, false) << ' ' << escaped_html(all.groups[i].name) << " (" << words("class.lines")
            << ": " << all.groups[i].lines << ")</span> ";
    out << "<span>" << key_theory() << ' ' << words("class.theory") << "</span></p>\n<p>"
        << escaped_html(words("class.explain")) << "</p>\n";
    for (std::size_t plot = 1; plot < plot_names.size(); ++plot)
        out << "<h2>" << escaped_html(words(plot_words[plot].title)) << "</h2>\n"
            << drawing(all, Plot(plot), words) << table(all, Plot(plot), words);
    out << "</body></html>\n";
    return out.str();
}

} // namespace starbow
