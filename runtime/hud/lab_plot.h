#pragma once
#include "hud.h"
#include "lab_table.h"
#include <array>

namespace starbow {

/// The plots of the log, in the order of the key that steps through them.
enum class Plot { none, doppler, length, clock };
constexpr std::array<const char*, 4> plot_names = {"none", "doppler", "length", "clock"};

/// The theory's curves. gamma_beta: proper velocity between the ship and the thing, c = 1, from 0.
/// D, frequency seen over frequency emitted, at the seen angle theta from the motion: 1 / (gamma (1 - beta cos theta)).
double doppler_theory(double gamma_beta, double theta_rad);
/// A thing's length along the motion over the same at rest, 1 / gamma; and so much time passes on a moving clock in a
/// second of the frame that it moves in.
double contraction_theory(double gamma_beta);

/// One measurement in a plot.
struct PlotPoint {
    double x = 0; ///< doppler: the angle from the motion as seen, degrees; the others: beta
    double y = 0; ///< doppler: D; length: along the motion over at rest; clock: the ship's time over the world's
    double theory = 0; ///< the theory's y there
    double gamma_beta = 0; ///< between the ship and what was measured
    /// false: what the instruments read. true, doppler: the rate at which a marked clock's reading grew, over the clock on
    /// board, from one line to the next; length: the apparent length over the length at rest, as the eye sees it.
    bool by_eye = false;

    double deviation() const { return y / theory - 1; }
};

/// True if the ship flew straight on between two lines of one flight: at one velocity within 0.2 %, and from place to place
/// as this velocity and the clock on board say. Lines before and after a stop, or of two flights, do not fit.
bool straight_on(const LabLine& before, const LabLine& now);

/// Appends the points that a line of the log adds to a plot. before: the line before, or null. Only lines with aberration
/// on count, because only these are measured in a flight's picture.
void add_points(std::vector<PlotPoint>& points, Plot plot, const LabLine* before, const LabLine& now);

/// The proper velocities of the latest points, each once, the latest first, at most `most`: for curves of D. Speeds whose
/// curves differ by less than 1 % count as one.
std::vector<double> plot_speeds(const std::vector<PlotPoint>& points, std::size_t most);

/// A plot's frame: the ends of its axes and the numbers along them, in the axes' units. y of doppler is logarithmic.
struct PlotAxes {
    double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
    bool y_log = false;
    std::vector<double> x_ticks, y_ticks;

    /// The place of a value between the axes' ends, from 0 to 1; beyond them for values beyond.
    double across(double x) const { return (x - x_low) / (x_high - x_low); }
    double up(double y) const;
};
/// speeds: for the curves of D, whose ends shall be within.
PlotAxes plot_axes(Plot plot, const std::vector<PlotPoint>& points, const std::vector<double>& speeds);

/// The theory's curve at a proper velocity (of doppler; the others have one for all), as points x, y from left to right.
std::vector<glm::dvec2> theory_curve(Plot plot, double gamma_beta);

/// Mean and spread of the relative deviations from theory, of the points that are by_eye or that are not.
struct Deviation {
    long count = 0;
    double mean = 0; ///< mean of y / theory - 1
    double spread = 0; ///< standard deviation (of a sample); 0 for one point
};
Deviation deviation_of(const std::vector<PlotPoint>& points, bool by_eye);

/// The texts of a plot. by_eye: none where nothing is seen by eye.
struct PlotWords {
    Key title, x, y, read, by_eye;
};
constexpr std::array<PlotWords, plot_names.size()> plot_words = {{
    {},
    {"plot.doppler", "plot.doppler_x", "plot.doppler_y", "plot.doppler_read", "plot.doppler_by_eye"},
    {"plot.length", "plot.beta", "plot.length_y", "plot.length_read", "plot.length_by_eye"},
    {"plot.clock", "plot.beta", "plot.clock_y", "plot.clock_read", {}},
}};

/// Height of the plot's panel over its width.
constexpr double plot_aspect = 0.62;

/// Draws a plot, `width` pixels across. gamma_beta: the ship's now; its curve of D is always there.
Panel draw_lab_plot(const Typesetter& typesetter, const Words& words, Plot plot, const std::vector<PlotPoint>& points,
    double gamma_beta, int width);

} // namespace starbow
