#include "lab_class_readings.h"
#include "config/json/csv.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include "lab_class_marks.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace starbow {
namespace {

/// The quantities that any group has read, in the worksheet's order.
std::vector<std::string> quantities_of(std::span<const LabGroup> groups)
{
    std::set<std::string> met;
    for (const LabGroup& group : groups)
        for (const StudentReading& reading : group.readings)
            met.insert(reading.of);
    std::vector<std::string> all(met.begin(), met.end());
    std::ranges::sort(all, {}, reading_order);
    return all;
}

std::vector<StudentReading> readings_of(const LabGroup& group, const std::string& quantity)
{
    std::vector<StudentReading> those;
    std::ranges::copy_if(
        group.readings, std::back_inserter(those), [&](const StudentReading& one) { return one.of == quantity; });
    return those;
}

/// A number with three figures, with the sign of people.
std::string shown_figure(double value, const Words& words, const char* form = "%.3g")
{
    std::string text = words.number(figure(value, form));
    if (text.starts_with('-'))
        text.replace(0, 1, "−");
    return text;
}

std::string shown_probability(double probability, const Words& words)
{
    constexpr double least = 0.001;
    return probability < least ? "< " + shown_figure(least, words) : shown_figure(probability, words, "%.3f");
}

std::string shown_lines(const std::vector<long>& lines)
{
    std::string text;
    for (const long line : lines)
        text += (text.empty() ? "" : ", ") + std::to_string(line);
    return text.empty() ? "—" : text;
}

/// A deviation that chance makes in less than one of a hundred classes is worth a talk, and so is one that is too small.
Key verdict_on(double probability)
{
    constexpr double rare = 0.01;
    return probability < rare ? "class.too_far"_key : probability > 1 - rare ? "class.too_close"_key : "class.agrees"_key;
}

std::string cell(const std::string& html) { return "<td>" + html + "</td>"; }

std::string group_table(std::span<const LabGroup> groups, const Words& words)
{
    std::string rows;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const ReadingStatistics all = statistics_of(groups[i].readings);
        if (all.count > 0)
            rows += "<tr>" + cell(group_mark(i, false) + ' ' + escaped_html(groups[i].name))
                + cell(std::to_string(all.count)) + cell(shown_figure(all.chi_square / double(all.count), words, "%.2f"))
                + cell(shown_probability(all.probability, words)) + cell(std::to_string(all.outliers.size()))
                + "<td class=\"says\">" + escaped_html(words(verdict_on(all.probability))) + "</td></tr>\n";
    }
    std::string head = table_row({words("class.group"), words("class.readings_count"), words("class.chi_square"),
                                     words("class.probability"), words("class.outliers"), words("class.verdict")},
        "th");
    head.insert(head.rfind("<th>") + 3, " class=\"says\"");
    return "<table class=\"groups\">\n" + head + rows + "</table>\n";
}

std::string quantity_row(
    const std::string& label, std::size_t group, const std::string& name, const ReadingStatistics& all, const Words& words)
{
    const auto of_several = [&](double value) { return all.count > 1 ? shown_figure(value, words) : "—"; };
    return "<tr>" + cell(escaped_html(label)) + cell(group_mark(group, false) + ' ' + escaped_html(name))
        + cell(std::to_string(all.count)) + cell(shown_figure(all.mean, words, "%+.3g")) + cell(of_several(all.spread))
        + cell(of_several(all.standard_error)) + cell(shown_figure(all.chi_square / double(all.count), words, "%.2f"))
        + cell(shown_probability(all.probability, words)) + cell(shown_lines(all.outliers)) + "</tr>\n";
}

std::string quantity_table(std::span<const LabGroup> groups, const std::vector<std::string>& quantities, const Words& words)
{
    std::string rows;
    for (const std::string& quantity : quantities) {
        std::string label = reading_label(quantity, words); // once: on its first line
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const std::vector<StudentReading> those = readings_of(groups[i], quantity);
            if (those.empty())
                continue;
            rows += quantity_row(label, i, groups[i].name, statistics_of(those), words);
            label.clear();
        }
    }
    return "<table class=\"readings\">\n"
        + table_row({words("class.quantity"), words("class.group"), words("class.readings_count"), words("class.deviation"),
                        words("class.spread"), words("class.standard_error"), words("class.chi_square"),
                        words("class.probability"), words("class.outlier_lines")},
            "th")
        + rows + "</table>\n";
}

/// Deviations in uncertainties over the quantities; what is further away stands at the edge.
std::string picture(std::span<const LabGroup> groups, const std::vector<std::string>& quantities, const Words& words)
{
    constexpr double width = 860, left = 50, right = 850, top = 30, bottom = 290, highest = 5;
    const auto y_of
        = [&](double z) { return 0.5 * (top + bottom) - 0.5 * (bottom - top) * std::clamp(z, -highest, highest) / highest; };
    const double column = (right - left) / double(quantities.size());
    Svg svg;
    std::size_t longest = 0; // bytes of a label, which is turned by 40 degrees
    for (const double sure : {1., 2.})
        svg.rect({left, y_of(sure)}, {right, y_of(-sure)}, "class=\"sure\"");
    for (int z = -int(highest); z <= int(highest); ++z) {
        svg.line({left, y_of(z)}, {right, y_of(z)}, z == 0 ? "class=\"zero\"" : "class=\"grid\"");
        svg.text({left - 8, y_of(z) + 5}, shown_figure(z, words), "text-anchor=\"end\"");
    }
    svg.text({left - 40, top - 12}, words("class.z"));
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        const double middle = left + (double(q) + 0.5) * column;
        const std::string place = shortest(middle) + ' ' + shortest(bottom + 16);
        std::string label = reading_label(quantities[q], words);
        label = label.substr(0, label.find(':'));
        longest = std::max(longest, label.size());
        svg.text({middle, bottom + 16}, label, "text-anchor=\"end\" transform=\"rotate(-40 " + place + ")\"");
        for (std::size_t i = 0; i < groups.size(); ++i)
            for (const StudentReading& reading : readings_of(groups[i], quantities[q]))
                draw_group_mark(svg, i, std::abs(reading.sigmas()) > outlier_sigmas,
                    {middle + 0.7 * column * ((double(i) + 0.5) / double(groups.size()) - 0.5), y_of(reading.sigmas())});
    }
    return svg.drawn({width, bottom + 25 + 5 * double(longest)},
        "role=\"img\" " + attribute("aria-label", escaped_html(words("class.z"))));
}

} // namespace

std::string readings_section(std::span<const LabGroup> groups, const Words& words)
{
    const std::vector<std::string> quantities = quantities_of(groups);
    const std::string begin = "<h2>" + escaped_html(words("class.readings")) + "</h2>\n<p>";
    if (quantities.empty())
        return begin + escaped_html(words("class.no_readings")) + "</p>\n";
    return begin + escaped_html(words("class.readings_explain")) + "</p>\n" + group_table(groups, words)
        + picture(groups, quantities, words) + "<p>" + escaped_html(words("class.picture_explain")) + "</p>\n"
        + quantity_table(groups, quantities, words);
}

std::string readings_csv(std::span<const LabGroup> groups)
{
    std::string csv;
    for (const LabGroup& group : groups)
        for (const StudentReading& reading : group.readings) {
            csv += csv_cell(group.name) + ',' + reading.of + ',' + std::to_string(reading.line);
            for (const double value : {reading.value, reading.uncertainty, reading.theory, reading.sigmas()})
                csv += ',' + figure(value, "%.12g");
            csv += "\r\n";
        }
    return csv.empty() ? csv : std::string(class_csv_begin) + "of,line,reading,uncertainty,theory,sigmas\r\n" + csv;
}

} // namespace starbow
