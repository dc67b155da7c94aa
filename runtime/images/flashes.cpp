#include "flashes.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace starbow {
namespace {

/// Fields' centres are at most so far apart.
constexpr double apart_deg = 0.75;
/// A value that is exactly large enough counts, although floats round.
constexpr float rounding = 1e-6f;
/// Darker reds are black: a byte of a screen's black is no saturated red.
constexpr float least_red = 0.003f;

using Cell = std::tuple<int, int, int>;

/// Directions in cubes of a grid, so that near ones are found at once.
class Grid {
public:
    explicit Grid(double side)
        : side_(side)
    {
    }
    Cell cell(const glm::vec3& n) const
    {
        const glm::dvec3 at = glm::floor(glm::dvec3(n) / side_);
        return {int(at.x), int(at.y), int(at.z)};
    }
    void add(const glm::vec3& n, std::uint32_t index) { cells_[cell(n)].push_back(index); }
    template <class Work> void around(const glm::vec3& n, Work&& work) const
    {
        const auto [x, y, z] = cell(n);
        for (int i = x - 1; i <= x + 1; ++i)
            for (int j = y - 1; j <= y + 1; ++j)
                for (int k = z - 1; k <= z + 1; ++k)
                    if (const auto at = cells_.find({i, j, k}); at != cells_.end())
                        for (const std::uint32_t index : at->second)
                            work(index);
    }

private:
    double side_;
    std::map<Cell, std::vector<std::uint32_t>> cells_;
};

/// The chord of an angle on the unit sphere.
double chord(double angle_deg) { return 2 * std::sin(0.5 * angle_deg * degree); }

bool is_saturated(const glm::vec3& light)
{
    const float sum = light.r + light.g + light.b;
    return light.r >= least_red && light.r >= float(saturated_red) * sum;
}

} // namespace

double relative_luminance(const glm::vec3& light) { return glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), glm::dvec3(light)); }

double redness(const glm::vec3& light) { return std::max(0.0, 320.0 * (double(light.r) - light.g - light.b)); }

FlashCounter::FlashCounter(std::vector<SeenPixel> pixels, int outputs)
    : pixels_(std::move(pixels))
{
    const double reach = chord(0.5 * flash_field_deg), apart = chord(apart_deg);
    Grid all(reach), centres(apart);
    for (std::uint32_t i = 0; i < pixels_.size(); ++i)
        all.add(pixels_[i].direction, i);
    const auto near = [&](std::uint32_t a, std::uint32_t b, double distance) {
        const glm::dvec3 way = glm::dvec3(pixels_[a].direction) - glm::dvec3(pixels_[b].direction);
        return glm::dot(way, way) <= distance * distance;
    };
    for (std::uint32_t i = 0; i < pixels_.size(); ++i) {
        bool taken = false;
        centres.around(pixels_[i].direction, [&](std::uint32_t other) { taken = taken || near(i, other, apart); });
        if (taken)
            continue;
        centres.add(pixels_[i].direction, i);
        Field field{std::uint32_t(near_.size()), 0, pixels_[i].output, i};
        all.around(pixels_[i].direction, [&](std::uint32_t other) {
            if (near(i, other, reach))
                near_.push_back(other);
        });
        field.end = std::uint32_t(near_.size());
        fields_.push_back(field);
    }
    for (std::size_t kind = 0; kind < flash_kinds; ++kind) {
        legs_[kind].resize(pixels_.size());
        counts_[kind].resize(pixels_.size());
        now_[kind].resize(std::size_t(outputs));
        worst_[kind].resize(std::size_t(outputs));
    }
}

bool FlashCounter::advance(Leg& leg, float value, bool red, FlashKind kind)
{
    const bool general = kind == FlashKind::general;
    const auto large = [&](float difference) {
        return general ? difference >= float(flash_luminance) - rounding : difference > float(flash_redness);
    };
    if (leg.way == 0) {
        const bool lowest = value <= leg.from, highest = value >= leg.to;
        leg.from = std::min(leg.from, value), leg.to = std::max(leg.to, value);
        leg.red = red || (leg.red && !lowest);
        leg.red_since = red || (leg.red_since && !highest);
        if (large(leg.to - leg.from)) {
            if (!highest)
                std::swap(leg.from, leg.to), leg.red = leg.red_since;
            leg.way = highest ? 1 : -1;
            leg.red_since = false, leg.red_end = red;
        }
    } else if (float(leg.way) * (value - leg.to) >= 0) {
        leg.to = value;
        leg.red = leg.red || leg.red_since || red;
        leg.red_since = false, leg.red_end = red;
    } else {
        leg.red_since = leg.red_since || red;
        if (large(std::abs(value - leg.to)))
            leg = {.from = leg.to,
                .to = value,
                .way = std::int8_t(-leg.way),
                .counted = false,
                .red = leg.red_end || leg.red_since,
                .red_since = false,
                .red_end = red};
    }
    const bool counts = leg.way != 0 && (general ? std::min(leg.from, leg.to) < float(flash_dark) : leg.red);
    return counts && !std::exchange(leg.counted, true);
}

void FlashCounter::take(std::int64_t time_ns, std::span<const glm::vec3> light)
{
    constexpr std::int64_t second_ns = 1'000'000'000;
    Frame frame{time_ns, {}};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const float values[flash_kinds] = {float(relative_luminance(light[i])), float(redness(light[i]))};
        const bool red = is_saturated(light[i]);
        for (std::size_t kind = 0; kind < flash_kinds; ++kind) {
            if (!begun_)
                legs_[kind][i] = {.from = values[kind], .to = values[kind], .red = red, .red_since = red};
            else if (advance(legs_[kind][i], values[kind], red, FlashKind(kind))) {
                frame.changed[kind].push_back(std::uint32_t(i));
                ++counts_[kind][i];
            }
        }
    }
    begun_ = true;
    std::array<bool, flash_kinds> differs{};
    while (!second_.empty() && second_.front().time_ns <= time_ns - second_ns) {
        for (std::size_t kind = 0; kind < flash_kinds; ++kind)
            for (const std::uint32_t i : second_.front().changed[kind])
                --counts_[kind][i], differs[kind] = true;
        second_.pop_front();
    }
    for (std::size_t kind = 0; kind < flash_kinds; ++kind)
        if (differs[kind] || !frame.changed[kind].empty())
            find_fields(FlashKind(kind), time_ns);
        else
            for (Flashes& flashes : now_[kind])
                flashes.time_ns = time_ns;
    second_.push_back(std::move(frame));
}

void FlashCounter::find_fields(FlashKind kind, std::int64_t time_ns)
{
    const std::vector<std::uint16_t>& counts = counts_[std::size_t(kind)];
    std::vector<Flashes>& now = now_[std::size_t(kind)];
    std::vector<double> areas; // of all pixels, by their changes
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] >= areas.size())
            areas.resize(counts[i] + 1u);
        areas[counts[i]] += pixels_[i].solid_angle_sr;
    }
    now.assign(now.size(), Flashes{.time_ns = time_ns});
    double beyond = 0;
    std::size_t found = 0;
    for (int changes = int(areas.size()) - 1; changes >= 2 && found < now.size(); --changes) {
        beyond += areas[std::size_t(changes)];
        if (beyond <= flash_area_sr)
            continue;
        std::vector<char> fresh(now.size());
        for (const Field& field : fields_) {
            Flashes& own = now[std::size_t(field.output)];
            if (own.changes > changes)
                continue;
            double area = 0;
            for (std::uint32_t at = field.first; at < field.end; ++at)
                if (counts[near_[at]] >= changes)
                    area += pixels_[near_[at]].solid_angle_sr;
            if (area > flash_area_sr && area > own.area_sr) {
                own = {changes, area, pixels_[field.centre].direction, time_ns};
                fresh[std::size_t(field.output)] = 1;
            }
        }
        found += std::size_t(std::count(fresh.begin(), fresh.end(), 1));
    }
    for (std::size_t output = 0; output < now.size(); ++output) {
        Flashes& worst = worst_[std::size_t(kind)][output];
        if (std::pair(now[output].changes, now[output].area_sr) > std::pair(worst.changes, worst.area_sr))
            worst = now[output];
    }
}

} // namespace starbow
