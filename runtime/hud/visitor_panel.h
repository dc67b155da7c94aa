#pragma once
#include "hud.h"

namespace starbow {

/// A line of letters on the panel. Places and sizes are in parts of the panel's height, from its upper left corner; the
/// panel is 1 / panel_aspect wide.
struct Lettering {
    std::string text;
    double x = 0, baseline = 0;
    double size = 0; ///< of a whole line with its ascents and descents; capitals are 0.63 of it
};

/// The smallest letters of the displays for visitors and guides. On a panel 40 degrees wide, 8 degrees high, their capitals
/// are 1 degree high.
constexpr double least_lettering = 0.2;

/// One sentence about the picture in plain words: the effect that shapes it most now.
std::string plain_sentence(const Readings& readings, const Words& words);
/// The times on board and outside in whole minutes, as children count, within 4 %: "2 minutes for you are 3 outside." In six
/// of every eighteen seconds of a flight it stands in the plain sentence's place. Empty where no small numbers are as near,
/// and in all other seconds.
std::string minutes_sentence(const Readings& readings, const Words& words);

/// Speed as a part of the speed of light in percent, cut off, never rounded up: no speed is shown as 100 %.
std::string shown_percent(double beta_deficit, const Words& words);

/// The part of the dial that a speed fills: 1 - 1/D, where D = sqrt((1 + beta) / (1 - beta)) is the frequency seen straight
/// ahead over the frequency emitted. 0 at rest; 1 only at the speed of light.
double gauge_part(double beta_deficit);

/// The lines of the display for visitors, or for guides, as readings.information says.
std::vector<Lettering> lettering_of(const Typesetter& typesetter, const Readings& readings, const Words& words);

/// Writes the display for visitors, or for guides, on a panel's plate: the dial of speed, both clocks, the lines.
void write_visitor_panel(Panel& panel, const Typesetter& typesetter, const Readings& readings, const Words& words);

} // namespace starbow
