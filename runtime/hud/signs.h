#pragma once
#include "config/model/flying.h"
#include "config/model/words.h"
#include "hud.h"
#include "instruments.h"
#include <optional>
#include <span>

namespace starbow {

/// A few words at a thing in the picture, with an arrow that points at it.
struct Sign {
    enum class Kind { behind, clock } kind = Kind::behind;
    std::size_t thing = 0; ///< of `behind`: index of the box; of `clock`: index of the instance
    glm::dvec3 towards{0, 0, -1}; ///< the thing's middle as seen, unit, cockpit axes
    double light_s = 0; ///< the age of the light that is seen, by the world's time
    double eyes_apart_s = 0; ///< between the moments at which two eyes see it, by the world's time
};

/// The sign for a picture: at a thing that the ship has passed and that is seen ahead all the same, or at a clock whose
/// light is old. Only where aberration is on and nothing is compared: elsewhere the words would be wrong. things: boxes
/// that rest in the world. eyes_apart: along the cockpit's x axis, scene units; 0 for one eye. before: the sign of the frame
/// before, which is kept as long as it is true.
std::optional<Sign> sign_for(const Shot& shot, std::span<const AlignedBox> things, const World& world,
    double seconds_per_time_unit, double eyes_apart, const std::optional<Sign>& before);

/// The sign's lines.
std::vector<std::string> lines_of(const Sign& sign, const Words& words);

/// A sign's plate with its arrow below, whose tip is at the middle of the panel's lower edge. degree_px: pixels to a
/// degree.
Panel draw_sign(const Typesetter& typesetter, const std::vector<std::string>& lines, double degree_px);

/// A plate with one line. degree_px: as above.
Panel draw_name(const Typesetter& typesetter, const std::string& name, double degree_px);

/// A plate with a few words in large letters, in lines as wide as the head-up display at most. width: the display's, pixels.
Panel draw_title(const Typesetter& typesetter, const std::string& title, int width);

/// The height of a title's letters as a part of the head-up display's width: on a screen of 1.5 m, whose display is 0.65 m
/// wide, 55 mm, which is 0.6 degrees from 5 m.
constexpr double title_letters = 0.085;

/// The height of a sign's letters, degrees: capitals are 1 degree high.
constexpr double sign_letters_deg = 1.6;

} // namespace starbow
