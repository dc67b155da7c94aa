#include "still_measurement.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace starbow {
namespace {

[[noreturn]] void refuse(const std::string& part, const std::string& problem)
{
    throw InputError("--measure " + one_line(part) + " " + problem);
}

/// Removes a number from the beginning of `text` and returns it; the second result is true if "deg" followed.
std::pair<double, bool> take_number(const std::string& part, std::string_view& text)
{
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || !std::isfinite(value))
        refuse(part,
            "is not a point; X,Y in pixels or Adeg,Bdeg from straight ahead, such as 400,300 or 12deg,-3.5deg, is right");
    text.remove_prefix(std::size_t(read.ptr - text.data()));
    const bool degrees = text.starts_with("deg");
    text.remove_prefix(degrees ? 3 : 0);
    return {value, degrees};
}

Point parse_point(std::string part, glm::ivec2 size)
{
    std::erase(part, ' ');
    std::string_view text = part;
    const auto [x, x_degrees] = take_number(part, text);
    if (!text.starts_with(','))
        refuse(part, "has one number; two with a comma between them are right");
    text.remove_prefix(1);
    const auto [y, y_degrees] = take_number(part, text);
    if (!text.empty() || x_degrees != y_degrees)
        refuse(part,
            "is not a point; X,Y in pixels or Adeg,Bdeg from straight ahead, such as 400,300 or 12deg,-3.5deg, is right");
    if (x_degrees)
        return direction_of({x, y});
    if (x < 0 || y < 0 || x >= size.x || y >= size.y)
        refuse(part,
            "lies outside the picture; from 0,0 to below " + std::to_string(size.x) + "," + std::to_string(size.y)
                + " is right");
    return glm::dvec2(x, y);
}

std::string describe(const SpotReading& reading, const Measured& measured, const Words& english)
{
    Measured one = measured;
    one.aim = reading;
    one.pair.reset();
    const auto fields = reading_fields(one, english);
    std::string line;
    for (std::size_t i = 0; i < 6; ++i)
        if (!fields[i].first.empty())
            line.append(i == 0 ? "" : ", ").append(fields[i].first).append(" ").append(fields[i].second);
    return line;
}

} // namespace

std::vector<Point> parse_points(const std::string& text, const Layout& layout)
{
    std::vector<Point> points;
    for (std::size_t from = 0; !text.empty() && from <= text.size();) {
        const std::size_t to = std::min(text.find(';', from), text.size());
        points.push_back(parse_point(text.substr(from, to - from), layout.outputs[0].size));
        from = to + 1;
    }
    constexpr std::size_t most = 64;
    if (points.size() > most)
        throw InputError(
            "--measure has " + std::to_string(points.size()) + " points; at most " + std::to_string(most) + " are right");
    return points;
}

StillMeasurement measure_still(OffscreenRenderer& renderer, const GpuWorld& world, const Shot& shot,
    const std::vector<Point>& points, const std::string& overlay, const std::string& why, const Words& words, bool by_eye)
{
    StillMeasurement measurement;
    const auto which = [](const auto& names, const std::string& name) {
        return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const Overlay over = Overlay(which(overlay_names, overlay));
    const Why page = Why(which(why_names, why));
    if (points.empty() && over == Overlay::off && page == Why::none)
        return measurement;
    FrameRenderer& frame = renderer.frame();
    Measuring what{.probes = {{glm::dvec3(0, 0, -1)}}};
    for (const Point& point : points)
        if (const auto* pixel = std::get_if<glm::dvec2>(&point)) {
            const auto direction = frame.views().direction(0, *pixel);
            if (!direction)
                throw InputError("--measure " + shown(pixel->x) + "," + shown(pixel->y)
                    + " is a place where the picture shows nothing; one that shows the world is right");
            what.probes.push_back({*direction, frame.views().view_at(0, *pixel)});
        } else {
            what.probes.push_back({std::get<glm::dvec3>(point)});
        }
    frame.measure(what);
    const std::vector<Probed> probed = renderer.probed(shot);
    const auto spot_of = [&](std::size_t i) {
        const MeasuringObserver& observer = frame.observer(i);
        Probed one = probed[i];
        // Exact, unlike the picture's pixel.
        one.ray = ray_from_ship(observer, observer.ship_from_cockpit * what.probes[i].direction);
        return spot_at(observer, one, world.world);
    };
    std::array<std::optional<Spot>, 2> marks;
    for (std::size_t i = 1; i < std::min<std::size_t>(probed.size(), 3); ++i)
        marks[i - 1] = snapped(spot_of(i), world.world);
    const Ship ship = ship_at(shot);
    const Words english = words_in("en");
    if (shot.effects.comparison != Comparison::none)
        measurement.lines.push_back(
            english(shot.effects.comparison == Comparison::galilean ? "light.galilean"_key : "light.no_light_delay"_key));
    for (std::size_t i = 0; i < probed.size(); ++i) {
        const Measured measured
            = measured_of(frame.head(i), ship, world.scene, world.world, shot.effects, spot_of(i), probed[i].light, marks);
        measurement.points.push_back(measured);
        if (by_eye)
            continue;
        measurement.lines.push_back(
            (i == 0 ? "ahead: " : "point " + std::to_string(i) + ": ") + describe(measured.aim, measured, english));
    }
    if (measurement.points[0].pair && !by_eye) {
        // The pair's numbers are those of the observer who sees both, the visitor's where two observers see one each.
        const bool one_view = what.probes[1].view == what.probes[2].view;
        const auto fields = reading_fields(measurement.points[one_view ? 1 : 0], english);
        std::string line;
        for (std::size_t i = 6; i < 9; ++i)
            if (!fields[i].first.empty())
                line.append(line.empty() ? "" : ", ").append(fields[i].first).append(" ").append(fields[i].second);
        measurement.lines.push_back(line);
    }
    const OverlayScale scale = overlay_scale(world.world, frame.observer().place, world.scene.seconds_per_time_unit());
    what.over = {over == Overlay::off && page != Why::none ? Overlay::aim : over, marks, scale};
    if (over != Overlay::off || page != Why::none) {
        const bool at_point = over == Overlay::spectrum || over == Overlay::photometer;
        measurement.panel = std::make_shared<Panel>(
            draw_lab_panel(Typesetter(), words, measurement.points[at_point && !points.empty() ? 1 : 0],
                {over, scale, page, by_eye}, frame.views().lab_panel_width(lab_aspect(over, page))));
        what.panel = measurement.panel.get();
        what.scale = scale_place(over, page);
    }
    frame.measure(what);
    return measurement;
}

} // namespace starbow
