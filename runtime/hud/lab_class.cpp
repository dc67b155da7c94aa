#include "lab_class.h"
#include "config/json/csv.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include "lab_class_marks.h"
#include "lab_class_readings.h"
#include "lab_log.h"
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace starbow {
namespace {

std::string key_theory()
{
    Svg svg;
    svg.line({0, 8}, {16, 8}, "class=\"theory\"");
    return svg.drawn({16, 16}, "class=\"key\"");
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
                draw_group_mark(svg, i, point.by_eye, {x, y});
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

/// The groups' deviations of what was seen; empty where no group has any. Filled points would only repeat the formula.
std::string table(const LabClass& all, Plot plot, const Words& words)
{
    std::string rows;
    for (std::size_t i = 0; i < all.groups.size(); ++i) {
        const Deviation deviation = deviation_of(all.groups[i].points[std::size_t(plot)], true);
        if (deviation.count > 0)
            rows += "<tr><td>" + group_mark(i, true) + ' ' + escaped_html(all.groups[i].name) + "</td><td>"
                + std::to_string(deviation.count) + "</td><td>" + percent(deviation.mean, true, words) + "</td><td>"
                + (deviation.count > 1 ? percent(deviation.spread, false, words) : "—") + "</td></tr>\n";
    }
    if (rows.empty())
        return rows;
    return std::string("<table class=\"seen ") + plot_names[std::size_t(plot)] + "\">\n"
        + table_row({words("class.group"), words("class.count"), words("class.mean"), words("class.spread")}, "th") + rows
        + "</table>\n";
}

} // namespace

/// Cells that a line of an older version lacks.
static std::size_t missing_cells(std::string_view line)
{
    static const auto right = std::ranges::count(log_header(), ',');
    return std::size_t(right - std::ranges::count(line, ','));
}

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
        csv.append(begin).append(texts[i].second).append(missing_cells(texts[i].second), ',').append("\r\n");
        if (std::optional<StudentReading> reading = reading_of(now))
            group.readings.push_back(std::move(*reading));
        before = std::move(now);
        if (progress && i % 4096 == 0)
            progress(double(texts[i].second.data() - bytes.data()) / double(bytes.size()));
    }
    if (all.csv.empty())
        all.csv = class_header() + "\r\n";
    all.csv += csv;
    all.groups.push_back(std::move(group));
}

void add_readings(LabClass& all, const std::string& name, std::string_view bytes, const std::string& file)
{
    LabGroup group{.name = name, .readings = read_reading_list(bytes, file)};
    if (group.readings.empty())
        throw InputError(one_line(file) + ": has no reading; a list with at least one number and its uncertainty is right");
    group.lines = long(group.readings.size());
    all.groups.push_back(std::move(group));
}

std::string class_page(const LabClass& all, const Words& words)
{
    std::ostringstream out;
    out << page_begin(words.language, words("class.title"),
        "text{font-size:14px}svg.key{width:1.1em;height:1.1em;vertical-align:-.2em}.grid{stroke:#ddd;fill:none}"
        ".theory{stroke:#777;stroke-width:1.5;fill:none}.speed{font-size:12px;fill:#555}"
        ".legend span{margin-right:1.5em;white-space:nowrap}"
        ".sure{fill:#0072b2;opacity:.12}.zero{stroke:#333}table{font-size:.9em}"
        ".says{text-align:left;white-space:normal}td,th{white-space:nowrap}table.readings th{white-space:normal}"
        "@media print{body{margin:0;max-width:none}table,svg{break-inside:avoid}}")
        << group_mark_shapes() << "<h1>" << escaped_html(words("class.title")) << "</h1>\n<p class=\"legend\">";
    for (std::size_t i = 0; i < all.groups.size(); ++i)
        out << "<span>" << group_mark(i, false) << ' ' << escaped_html(all.groups[i].name) << " (" << words("class.lines")
            << ": " << all.groups[i].lines << ")</span> ";
    out << "</p>\n" << readings_section(all.groups, words);
    if (all.csv.empty()) // lists of readings alone
        return out.str() + "</body></html>\n";
    out << "<h2>" << escaped_html(words("class.plots")) << "</h2>\n<p>" << key_theory() << ' ' << words("class.theory")
        << "</p>\n<p>" << escaped_html(words("class.explain")) << "</p>\n";
    for (std::size_t plot = 1; plot < plot_names.size(); ++plot)
        out << "<h3>" << escaped_html(words(plot_words[plot].title)) << "</h3>\n"
            << drawing(all, Plot(plot), words) << table(all, Plot(plot), words);
    out << "</body></html>\n";
    return out.str();
}

} // namespace starbow
