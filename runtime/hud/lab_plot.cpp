#include "lab_plot.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

double beta_of(double gamma_beta) { return gamma_beta / std::hypot(1.0, gamma_beta); }

void add_spot(std::vector<PlotPoint>& points, const LabLine& line, const std::string& spot)
{
    const double D = line[spot + "_doppler"], u = line[spot + "_relative_gamma_beta"],
                 angle = line[spot + "_from_relative_motion_deg"];
    if (std::isfinite(D) && std::isfinite(angle))
        points.push_back({angle, D, doppler_theory(u, angle * degree), u});
}

} // namespace

bool straight_on(const LabLine& before, const LabLine& now)
{
    const double dtau = now["ship_time_s"] - before["ship_time_s"];
    if (!(dtau > 0))
        return false;
    // The velocity settles slowly after a key, and what it still changes shall not show in a plot. The log has 12 digits.
    constexpr double alike = 0.002, digits = 1e-10;
    const double gamma = now["gamma"];
    for (const char* axis : {"x", "y", "z"}) {
        const double u = now[std::string("gamma_beta_") + axis], was = before[std::string("gamma_beta_") + axis];
        const double at = now[std::string("place_") + axis + "_light_s"],
                     from = before[std::string("place_") + axis + "_light_s"];
        const double rounding = digits * (std::abs(at) + std::abs(from) + gamma * now["ship_time_s"]);
        if (std::abs(u - was) > alike * gamma
            || std::abs(at - from - 0.5 * (u + was) * dtau) > alike * gamma * dtau + rounding)
            return false;
    }
    return true;
}

namespace {

/// The seen rate of a clock from one line to the next, at the angle halfway.
void add_rate(std::vector<PlotPoint>& points, const LabLine& before, const LabLine& now, const std::string& mark)
{
    const auto same = [&](const std::string& column) { return before[mark + column] == now[mark + column]; };
    const double dclock = now[mark + "_clock_s"] - before[mark + "_clock_s"];
    const double dtau = now["ship_time_s"] - before["ship_time_s"];
    const double first = before[mark + "_from_relative_motion_deg"], second = now[mark + "_from_relative_motion_deg"];
    // Over a wider turn the rate halfway differs from the mean rate by more than a plot shows.
    constexpr double widest_deg = 10;
    if (same("_number") && std::isfinite(dclock) && std::abs(second - first) <= widest_deg) {
        const double u = 0.5 * (before[mark + "_relative_gamma_beta"] + now[mark + "_relative_gamma_beta"]),
                     angle = 0.5 * (first + second);
        points.push_back({angle, dclock / dtau, doppler_theory(u, angle * degree), u, true});
    }
}

void add_length(std::vector<PlotPoint>& points, const LabLine& line)
{
    const double u = line["marks_relative_gamma_beta"], rest = line["marks_rest_length_light_s"],
                 contracted = line["marks_contracted_length_light_s"], apparent = line["marks_apparent_length_light_s"],
                 angle = line["marks_from_motion_at_rest_deg"] * degree;
    // Across the motion nothing is contracted, so nothing would be measured.
    constexpr double widest = 60 * degree;
    if (!(rest > 0) || !(angle <= widest) || !std::isfinite(contracted))
        return;
    const double along = rest * std::cos(angle), across = rest * std::sin(angle);
    const double theory = contraction_theory(u), beta = beta_of(u);
    const auto part = [&](double length) { return std::sqrt(std::max(0.0, (length - across) * (length + across))) / along; };
    points.push_back({beta, part(contracted), theory, u});
    if (std::isfinite(apparent))
        points.push_back({beta, part(apparent), theory, u, true});
}

} // namespace

double doppler_theory(double gamma_beta, double theta_rad)
{
    // gamma - u cos theta, without its cancellation ahead at high speed.
    const double u = gamma_beta, half = std::sin(0.5 * theta_rad);
    return 1 / (1 / (std::hypot(1.0, u) + u) + 2 * u * half * half);
}

double contraction_theory(double gamma_beta) { return 1 / std::hypot(1.0, gamma_beta); }

void add_points(std::vector<PlotPoint>& points, Plot plot, const LabLine* before, const LabLine& now)
{
    if (now["aberration_on"] != 1)
        return;
    const bool steady = before && (*before)["aberration_on"] == 1 && straight_on(*before, now);
    switch (plot) {
    case Plot::none:
        return;
    case Plot::doppler:
        for (const char* spot : {"aim", "mark_1", "mark_2"})
            add_spot(points, now, spot);
        for (const char* mark : {"mark_1", "mark_2"})
            if (steady)
                add_rate(points, *before, now, mark);
        return;
    case Plot::length:
        return add_length(points, now);
    case Plot::clock:
        if (steady) {
            const double gamma = 0.5 * ((*before)["gamma"] + now["gamma"]), u = std::sqrt((gamma - 1) * (gamma + 1)),
                         dt = now["world_time_s"] - (*before)["world_time_s"];
            points.push_back({beta_of(u), (now["ship_time_s"] - (*before)["ship_time_s"]) / dt, contraction_theory(u), u});
        }
    }
}

std::vector<double> plot_speeds(const std::vector<PlotPoint>& points, std::size_t most)
{
    std::vector<double> speeds;
    constexpr double alike = 0.01; // in rapidity: 1 % of D at most
    for (auto point = points.rbegin(); point != points.rend() && speeds.size() < most; ++point) {
        const double rapidity = std::asinh(point->gamma_beta);
        if (std::none_of(
                speeds.begin(), speeds.end(), [&](double speed) { return std::abs(std::asinh(speed) - rapidity) < alike; }))
            speeds.push_back(point->gamma_beta);
    }
    return speeds;
}

double PlotAxes::up(double y) const
{
    return y_log ? std::log(y / y_low) / std::log(y_high / y_low) : (y - y_low) / (y_high - y_low);
}

PlotAxes plot_axes(Plot plot, const std::vector<PlotPoint>& points, const std::vector<double>& speeds)
{
    PlotAxes axes;
    for (int i = 0; i <= 5; ++i)
        axes.x_ticks.push_back(0.2 * i), axes.y_ticks.push_back(0.2 * i);
    if (plot == Plot::length) {
        // What is seen may be longer than at rest.
        double highest = 1;
        for (const PlotPoint& point : points)
            highest = std::max(highest, point.y);
        const double step = highest <= 1.2 ? 0.2
            : highest <= 3                 ? 0.5
            : highest <= 6                 ? 1
                                           : std::pow(10, std::ceil(std::log10(highest)) - 1);
        axes.y_high = std::min(std::ceil(highest / step + 0.25), 10.0) * step;
        axes.y_ticks.clear();
        for (double y = 0; y <= axes.y_high + 0.01 * step; y += step)
            axes.y_ticks.push_back(y);
    }
    if (plot != Plot::doppler) {
        axes.y_high = std::max(axes.y_high, 1.1);
        return axes;
    }
    axes.x_high = 180, axes.x_ticks = {0, 30, 60, 90, 120, 150, 180}, axes.y_log = true;
    double high = 2;
    for (double speed : speeds)
        high = std::max(high, 1.1 * doppler_theory(speed, 0));
    for (const PlotPoint& point : points)
        if (point.y > 0)
            high = std::max({high, 1.1 * point.y, 1.1 / point.y});
    high = std::min(high, 1e40); // a foreign log may hold the smallest number of all
    // As far below 1 as above: straight behind, D is 1 over what it is ahead.
    axes.y_high = high, axes.y_low = 1 / high, axes.y_ticks.clear();
    const double decades = 2 * std::log10(high);
    const int every = std::max(1, int(std::ceil(decades / 8)));
    for (int k = -40; k <= 40; ++k)
        for (int digit : {1, 2, 5})
            if (const double y = digit * std::pow(10.0, k);
                y >= axes.y_low && y <= axes.y_high && (decades < 4 || (digit == 1 && k % every == 0)))
                axes.y_ticks.push_back(y);
    return axes;
}

std::vector<glm::dvec2> theory_curve(Plot plot, double gamma_beta)
{
    std::vector<glm::dvec2> curve;
    constexpr int pieces = 256;
    for (int i = 0; i <= pieces; ++i) {
        const double part = double(i) / pieces;
        if (plot == Plot::doppler) {
            // Close steps straight ahead, where D falls within 1 / gamma.
            const double angle = 180 * part * part;
            curve.emplace_back(angle, doppler_theory(gamma_beta, angle * degree));
        } else {
            const double beta = std::sin(0.5 * glm::pi<double>() * part); // close steps near 1, where the curve is steep
            curve.emplace_back(beta, std::cos(0.5 * glm::pi<double>() * part));
        }
    }
    return curve;
}

Deviation deviation_of(const std::vector<PlotPoint>& points, bool by_eye)
{
    Deviation all;
    double squares = 0; // Welford
    for (const PlotPoint& point : points)
        if (point.by_eye == by_eye) {
            const double off = point.deviation() - all.mean;
            all.mean += off / double(++all.count);
            squares += off * (point.deviation() - all.mean);
        }
    all.spread = all.count > 1 ? std::sqrt(squares / double(all.count - 1)) : 0;
    return all;
}

namespace {

/// The part of a panel that a plot is drawn in, pixels from the top left.
struct Field {
    Panel& panel;
    PlotAxes axes;
    double left, right, top, bottom;

    glm::dvec2 place(const glm::dvec2& value) const
    {
        return {left + (right - left) * axes.across(value.x), bottom - (bottom - top) * axes.up(value.y)};
    }
    bool holds(const glm::dvec2& at) const
    {
        return at.x > left - 1 && at.x < right + 1 && at.y > top - 1 && at.y < bottom + 1;
    }

    /// Draws where `far`, a signed distance in pixels from what is drawn, is negative; edges are one pixel soft.
    template <class Far> void fill(glm::dvec2 low, glm::dvec2 high, double strength, const Far& far)
    {
        for (int y = std::max(0, int(low.y) - 2); y <= std::min(panel.size.y - 1, int(high.y) + 2); ++y)
            for (int x = std::max(0, int(low.x) - 2); x <= std::min(panel.size.x - 1, int(high.x) + 2); ++x) {
                const double covered = std::clamp(0.5 - far(glm::dvec2(x + 0.5, y + 0.5)), 0.0, 1.0);
                std::uint8_t& texel = panel.texels[2 * (std::size_t(y) * panel.size.x + std::size_t(x))];
                texel = std::max(texel, std::uint8_t(255 * strength * covered));
            }
    }
    void line(const glm::dvec2& a, const glm::dvec2& b, double wide, double strength)
    {
        const glm::dvec2 way = b - a;
        const double square = glm::dot(way, way);
        fill(glm::min(a, b) - wide, glm::max(a, b) + wide, strength, [&](const glm::dvec2& at) {
            const double part = square > 0 ? std::clamp(glm::dot(at - a, way) / square, 0.0, 1.0) : 0;
            return glm::distance(at, a + part * way) - 0.5 * wide;
        });
    }
    void curve(const std::vector<glm::dvec2>& values, double wide, double strength)
    {
        for (std::size_t i = 1; i < values.size(); ++i) {
            const glm::dvec2 a = place(values[i - 1]), b = place(values[i]);
            if (holds(a) && holds(b))
                line(a, b, wide, strength);
        }
    }
    void disc(const glm::dvec2& at, double radius, double strength)
    {
        fill(at - radius, at + radius, strength, [&](const glm::dvec2& p) { return glm::distance(p, at) - radius; });
    }
    void ring(const glm::dvec2& at, double radius, double wide, double strength)
    {
        fill(at - radius - wide, at + radius + wide, strength,
            [&](const glm::dvec2& p) { return std::abs(glm::distance(p, at) - radius) - 0.5 * wide; });
    }
};

std::string tick(double value, const Words& words)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), std::abs(value) >= 1e5 || (value > 0 && value < 1e-4) ? "%.0e" : "%.6g", value);
    return words.number(text.data());
}

} // namespace

Panel draw_lab_plot(const Typesetter& typesetter, const Words& words, Plot plot, const std::vector<PlotPoint>& points,
    double gamma_beta, int width)
{
    const int height = int(width * plot_aspect);
    Panel panel = plate({width, height}, 0.024 * width);
    if (plot == Plot::none)
        return panel;
    const PlotWords& keys = plot_words[std::size_t(plot)];
    constexpr std::size_t most_curves = 4;
    std::vector<double> speeds = plot == Plot::doppler ? plot_speeds(points, most_curves) : std::vector<double>();
    std::vector<double> drawn = speeds;
    drawn.push_back(gamma_beta);
    const PlotAxes axes = plot_axes(plot, points, drawn);
    Field field{panel, axes, 0.13 * width, 0.95 * width, 0.20 * height, 0.765 * height};
    const int size = std::max(7, int(0.034 * width));
    const auto centred = [&](const std::string& text, double x, double baseline, double strength) {
        typesetter.write(panel, text, x - 0.5 * typesetter.width_of(text, size), baseline, size, strength);
    };
    const auto within = [&](const std::string& text, double x, double baseline, int letters, double room, double strength) {
        while (letters > 6 && typesetter.width_of(text, letters) > room)
            --letters;
        typesetter.write(panel, text, x, baseline, letters, strength);
    };

    // Axes, with a line at each number.
    const double hair = std::max(1.0, 0.0016 * width);
    for (double x : axes.x_ticks) {
        const double at = field.place({x, axes.y_low}).x;
        field.line({at, field.top}, {at, field.bottom}, hair, 0.16);
        centred(tick(x, words), at, field.bottom + 1.15 * size, 0.8);
    }
    for (double y : axes.y_ticks) {
        const double at = field.place({axes.x_low, y}).y;
        field.line({field.left, at}, {field.right, at}, hair, y == 1 ? 0.32 : 0.16);
        const std::string number = tick(y, words);
        typesetter.write(
            panel, number, field.left - 0.4 * size - typesetter.width_of(number, size), at + 0.36 * size, size, 0.8);
    }
    within(words(keys.title), 0.035 * width, 0.085 * height, int(0.044 * width), 0.93 * width, 1);
    within(words(keys.y), 0.035 * width, 0.148 * height, size, 0.60 * width, 0.8);
    const std::string x_name = words(keys.x);
    typesetter.write(panel, x_name, field.right - typesetter.width_of(x_name, size), 0.885 * height, size, 0.8);

    // The theory, and over it the points.
    const double wide = std::max(1.2, 0.0034 * width), radius = std::max(1.8, 0.0075 * width);
    const auto draw_sign = [&](const glm::dvec2& at, bool by_eye) {
        if (by_eye)
            field.ring(at, 1.5 * radius, 0.5 * radius, 1);
        else
            field.disc(at, radius, 1);
    };
    if (plot == Plot::doppler) {
        for (double speed : speeds)
            field.curve(theory_curve(plot, speed), wide, 0.45);
        field.curve(theory_curve(plot, gamma_beta), wide, 0.6);
    } else {
        field.curve(theory_curve(plot, 0), wide, 0.6);
    }
    // Beads on a string: of points that would cover each other the latest is drawn, from the latest on.
    const double apart = 3 * radius;
    const int cells = int(width / apart) + 2;
    std::array<std::vector<bool>, 2> taken = {std::vector<bool>(std::size_t(cells) * cells), {}};
    taken[1] = taken[0];
    std::array<long, 2> count{};
    for (auto point = points.rbegin(); point != points.rend(); ++point) {
        ++count[point->by_eye];
        const glm::dvec2 at = field.place({point->x, point->y});
        if (!field.holds(at))
            continue;
        const std::size_t cell = std::size_t(at.y / apart) * std::size_t(cells) + std::size_t(at.x / apart);
        if (taken[point->by_eye][cell])
            continue;
        taken[point->by_eye][cell] = true;
        draw_sign(at, point->by_eye);
    }

    // What the signs mean, and at which speed the theory is drawn.
    if (points.empty())
        within(words("plot.empty"), field.left + 0.03 * width, 0.5 * (field.top + field.bottom), int(0.04 * width),
            field.right - field.left - 0.06 * width, 0.9);
    std::vector<std::string> legend = {words(keys.read, {{"count", std::to_string(count[false])}})};
    if (keys.by_eye)
        legend.push_back(words(keys.by_eye, {{"count", std::to_string(count[true])}}));
    legend.push_back(plot == Plot::doppler ? words("plot.theory_at", {{"beta", shown_number(beta_of(gamma_beta), 3, words)}})
                                           : words("plot.theory"));
    int letters = size;
    const auto legend_width = [&] {
        double all = 0.04 * width * double(legend.size());
        for (const std::string& text : legend)
            all += typesetter.width_of(text, letters) + letters;
        return all;
    };
    while (letters > 6 && legend_width() > 0.955 * width)
        --letters;
    double x = 0.045 * width;
    const double baseline = 0.955 * height;
    for (std::size_t i = 0; i < legend.size(); ++i) {
        const glm::dvec2 at(x, baseline - 0.34 * letters);
        if (i + 1 == legend.size())
            field.line(at - glm::dvec2(0.012 * width, 0), at + glm::dvec2(0.015 * width, 0), wide, 0.7);
        else
            draw_sign(at, i == 1);
        x += 0.025 * width;
        typesetter.write(panel, legend[i], x, baseline, letters, 0.85);
        x += typesetter.width_of(legend[i], letters) + 0.015 * width + letters;
    }
    return panel;
}

} // namespace starbow
