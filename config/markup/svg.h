#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <string>

namespace starbow {

/// Writes an SVG drawing (SVG 1.1), one element a line: x to the right, y down, in the drawing's own units, with a tenth of
/// a unit. `more` is further attributes as they stand in the file: fill="none" class="grid". Words may have any letters.
class Svg {
public:
    void text(glm::dvec2 at, const std::string& words, const std::string& more = {});
    void line(glm::dvec2 a, glm::dvec2 b, const std::string& more);
    void rect(glm::dvec2 from, glm::dvec2 to, const std::string& more);
    /// title: a browser shows it where the mouse rests.
    void circle(glm::dvec2 at, double radius, const std::string& more, const std::string& title = {});
    void polyline(std::span<const glm::dvec2> points, const std::string& more);
    void polygon(std::span<const glm::dvec2> points, const std::string& more);
    /// data: as path_data makes it, or as SVG has it.
    void path(const std::string& data, const std::string& more);
    /// An element as it stands in the file, such as a group's begin and end.
    void raw(const std::string& element) { elements_ += element + "\n"; }

    /// The whole drawing, width by height units. more: attributes of the root.
    std::string drawn(glm::dvec2 size, const std::string& more = {}) const;

private:
    void add(const char* name, const std::string& attributes, const std::string& more, const std::string& inside = {});
    std::string elements_;
};

/// The points, joined by straight lines; closed: also the last with the first.
std::string path_data(std::span<const glm::dvec2> points, bool closed = false);

/// An attribute: name="value".
std::string attribute(const char* name, const std::string& value);

/// A number with at most so many decimals, without zeros at its end.
std::string shortest(double value, int decimals = 1);

} // namespace starbow
