#pragma once
#include "config/markup/svg.h"
#include <string>

namespace starbow {

/// The most groups whose colours and marks differ.
constexpr std::size_t most_groups = 56;

/// A group's mark at a place of a drawing; hollow, and around a filled one, for what was seen.
void draw_group_mark(Svg& svg, std::size_t group, bool by_eye, glm::dvec2 at);
/// The same as a small drawing in a line of text.
std::string group_mark(std::size_t group, bool by_eye);
/// The shapes of all marks, which show nothing here: once on a page, before its drawings.
std::string group_mark_shapes();

/// A number in C's format.
std::string figure(double value, const char* form);

} // namespace starbow
