#include "svg.h"
#include "html.h"
#include <array>
#include <cstdio>

namespace starbow {
namespace {

std::string with(const char* name, double value) { return ' ' + attribute(name, shortest(value)); }

std::string listed(std::span<const glm::dvec2> points)
{
    std::string all;
    for (const glm::dvec2& at : points)
        all += (all.empty() ? "" : " ") + shortest(at.x) + ',' + shortest(at.y);
    return ' ' + attribute("points", all);
}

} // namespace

std::string attribute(const char* name, const std::string& value) { return std::string(name) + "=\"" + value + '"'; }

std::string shortest(double value, int decimals)
{
    std::array<char, 400> text; // the greatest double has 309 digits
    int length = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    if (decimals > 0) {
        while (text[std::size_t(length) - 1] == '0')
            --length;
        if (text[std::size_t(length) - 1] == '.')
            --length;
    }
    const std::string_view short_text(text.data(), std::size_t(length));
    return std::string(short_text == "-0" ? "0" : short_text);
}

void Svg::add(const char* name, const std::string& attributes, const std::string& more, const std::string& inside)
{
    elements_ += std::string("<") + name + attributes + (more.empty() ? "" : " ") + more;
    elements_ += inside.empty() ? "/>\n" : ">" + inside + "</" + name + ">\n";
}

void Svg::text(glm::dvec2 at, const std::string& words, const std::string& more)
{
    add("text", with("x", at.x) + with("y", at.y), more, escaped_html(words));
}

void Svg::line(glm::dvec2 a, glm::dvec2 b, const std::string& more)
{
    add("line", with("x1", a.x) + with("y1", a.y) + with("x2", b.x) + with("y2", b.y), more);
}

void Svg::rect(glm::dvec2 from, glm::dvec2 to, const std::string& more)
{
    add("rect", with("x", from.x) + with("y", from.y) + with("width", to.x - from.x) + with("height", to.y - from.y), more);
}

void Svg::circle(glm::dvec2 at, double radius, const std::string& more, const std::string& title)
{
    add("circle", with("cx", at.x) + with("cy", at.y) + with("r", radius), more,
        title.empty() ? "" : "<title>" + escaped_html(title) + "</title>");
}

void Svg::polyline(std::span<const glm::dvec2> points, const std::string& more) { add("polyline", listed(points), more); }
void Svg::polygon(std::span<const glm::dvec2> points, const std::string& more) { add("polygon", listed(points), more); }

void Svg::path(const std::string& data, const std::string& more) { add("path", ' ' + attribute("d", data), more); }

std::string Svg::drawn(glm::dvec2 size, const std::string& more) const
{
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" "
        + attribute("viewBox", "0 0 " + shortest(size.x) + ' ' + shortest(size.y)) + (more.empty() ? "" : " ") + more + ">\n"
        + elements_ + "</svg>\n";
}

std::string path_data(std::span<const glm::dvec2> points, bool closed)
{
    std::string data;
    for (const glm::dvec2& at : points)
        data += (data.empty() ? "M" : "L") + shortest(at.x) + ' ' + shortest(at.y);
    return data + (closed && !data.empty() ? "Z" : "");
}

} // namespace starbow
