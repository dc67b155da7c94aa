#include "record.h"
#include "describe_record.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace starbow {
namespace {

/// True if Controls has exactly so many parts and no member of its own.
template <class... Parts> constexpr bool controls_have(Parts...)
{
    return requires { Controls{Parts{}...}; }
    &&!requires { Controls{Parts{}..., {}}; };
}
static_assert(controls_have(ControlTimes{}, Steering{}, Looking{}, Switches{}, AlignmentSteps{}, Touches{}));

/// Compiles only while these structs have exactly the members named here, whatever their sizes. A new member belongs in
/// the record, or in the digest, as well.
[[maybe_unused]] void name_every_member(const Controls& c, const Flight& s)
{
    [[maybe_unused]] const auto& [time_ns, report_ns] = static_cast<const ControlTimes&>(c);
    [[maybe_unused]] const auto& [lever, throttle_rate, push, turn, taken] = static_cast<const Steering&>(c);
    [[maybe_unused]] const auto& [look_rad, head, exposure] = static_cast<const Looking&>(c);
    [[maybe_unused]] const auto& [choose, turn_by] = static_cast<const AlignmentSteps&>(c);
    [[maybe_unused]] const auto& [key_pressed, key_held] = static_cast<const Touches&>(c); // not kept: a record is one visit
    [[maybe_unused]] const auto& [ship, flight_mode, flight_lever, coasting, lever_waits, lever_rest, frozen, time_scale,
        homeward, thrust_inhibited, rate, thrust, turn_rad_s, turn_lead_rad_s, step_wait, vignette_part, homing,
        flight_look_rad, effects, exposure_ev, flight_hud, ticks, left_ns, leaps]
        = s;
}

/// A record's line.
std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// Adds numbers to a digest, byte by byte.
struct Digester {
    std::uint64_t sum = digest(std::string_view());
    void add(std::uint64_t bits) { sum = digest({reinterpret_cast<const char*>(&bits), sizeof bits}, sum); }
    void add(std::int64_t value) { add(std::uint64_t(value)); }
    void add(bool value) { add(std::uint64_t(value)); }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const Sum& sums) { add(sums.value), add(sums.carry); }
    void add(const Sum3& sums) { add(sums.x), add(sums.y), add(sums.z); }
    void add(const glm::dvec2& v) { add(v.x), add(v.y); }
    void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }
    void add(const glm::dquat& q) { add(q.w), add(q.x), add(q.y), add(q.z); }
    void add(const Ship& ship)
    {
        add(ship.position), add(ship.time), add(ship.u), add(ship.ship_from_cockpit);
        add(ship.proper_time), add(ship.distance);
    }
};

} // namespace

glm::dquat Quaternion::read(const Place& place, const Folder&) const
{
    const glm::dvec4 v = vec4(place, {-1.001, 1.001});
    if (std::abs(glm::length(v) - 1) > 0.001)
        fail_at(place, "is not a turn; a list of four numbers whose squares add up to 1 is right");
    return glm::dquat(v[0], v[1], v[2], v[3]);
}

std::int64_t Count::read(const Place& place, const Folder&) const
{
    const double value = number(place, {0, most});
    if (value != std::floor(value))
        fail_at(place, "is not a whole number; one from 0 to " + shown(most) + " is right");
    return std::int64_t(value);
}

std::uint64_t DigestText::read(const Place& place, const Folder&) const
{
    const std::string digits = text(place);
    if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdef") != digits.npos)
        fail_at(place, "is not a digest; a text of 16 hexadecimal digits is right");
    return std::stoull(digits, nullptr, 16);
}

AlignedBox Corners::read(const Place& place, const Folder&) const
{
    const std::vector<Place> at = items(place, 6, 6, "numbers (the lowest corner, the highest)");
    AlignedBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[int(i)] = number(at[i], any_place);
        box.high[int(i)] = number(at[i + 3], any_place);
    }
    return box;
}

Json Corners::written(const AlignedBox& box) const
{
    return {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
}

Polynomial::Path Polynomial::read(const Place& place, const Folder&) const
{
    Path path;
    const std::vector<Place> all = items(place, path.size(), path.size(), "points (a polynomial's coefficients)");
    std::ranges::transform(all, path.begin(), [](const Place& one) { return vec3(one, any_place); });
    return path;
}

Json Polynomial::written(const Path& path) const
{
    Json all = Json::array();
    for (const glm::dvec3& one : path)
        all.push_back({one.x, one.y, one.z});
    return all;
}

/// range_curve.h says what the numbers are.
std::vector<double> RangeGoal::read(const Place& place, const Folder&) const
{
    constexpr std::size_t before = 4, cells = RANGE_KNOTS - 1;
    const std::vector<Place> all = items(place, before + 1, before + cells, "numbers");
    std::vector<double> goal{number(all[0], {-1e3, 1e3}), number(all[1], {-1e3, 1e3}),
        double(integer(all[2], 0, int(cells + before - all.size()))), number(all[3], {-1e3, 1e3})};
    for (std::size_t i = before; i < all.size(); ++i)
        goal.push_back(number(all[i], {0, 1, true}));
    return goal;
}

Command CommandWords::read(const Place& place, const Folder&) const
{
    std::vector<std::string> words;
    for (const Place& word : items(place, 1, 3, "words")) {
        if (!word.json->is_string())
            fail_at(word, "is not a text; a list of texts such as [\"doppler\", \"off\"] is right");
        words.push_back(word.json->get<std::string>());
    }
    try {
        return command_of(words);
    } catch (const InputError& error) {
        fail_at(place, std::string("is not a command (") + error.what() + ")");
    }
}

std::string text_of(const RecordHeader& header) { return line_of(written_briefly(header)); }
std::string text_of(const RecordEntry& entry) { return line_of(written_briefly(entry)); }
std::string text_of(const RecordCheck& check) { return line_of(written_briefly(check)); }

RecordHeader parse_record_header(const std::string& file, std::string line)
{
    const Document document = parse_document(file, std::move(line));
    const Place top = root(document);
    if (!top.json->is_object() || !find_member(top, "starbow_record"))
        fail_at(top, "is not how a record begins; a file that starbow run --record has written is right");
    const Place version = member(top, "starbow_record");
    if (number(version, {0, 1e9}) != record_version)
        fail_at(version, "is a version of records that is not known here; " + std::to_string(record_version) + " is right");
    RecordHeader header = read<RecordHeader>(top);
    header.start.scene = header.scene;
    return header;
}

std::variant<RecordEntry, RecordCheck> parse_record_line(const std::string& file, int line, std::string content)
{
    const Document document = parse_document(file, std::move(content), line);
    const Place top = root(document);
    if (top.json->is_object() && find_member(top, "digest"))
        return read<RecordCheck>(top);
    RecordEntry entry = read<RecordEntry>(top);
    entry.controls.time_ns = entry.dt_ns + entry.skipped_ns;
    return entry;
}

std::uint64_t digest(std::string_view bytes, std::uint64_t before)
{
    for (unsigned char byte : bytes)
        before = (before ^ byte) * 0x100000001b3u;
    return before;
}

std::uint64_t digest(const Flight& flight)
{
    Digester all;
    all.add(flight.ship);
    all.add(std::int64_t(flight.mode));
    all.add(flight.coasting), all.add(flight.lever_waits), all.add(flight.lever_rest.has_value());
    all.add(flight.lever_rest.value_or(0)), all.add(flight.frozen);
    all.add(std::int64_t(flight.time_scale)), all.add(flight.homeward);
    all.add(flight.lever), all.add(flight.thrust_inhibited), all.add(flight.throttle_rate), all.add(flight.thrust);
    all.add(flight.turn_rad_s), all.add(flight.turn_lead_rad_s), all.add(flight.step_wait), all.add(flight.vignette);
    all.add(flight.homing.has_value());
    if (flight.homing) {
        const Homing& homing = *flight.homing;
        all.add(std::int64_t(homing.leg)), all.add(homing.ticks), all.add(homing.elapsed), all.add(homing.from);
        all.add(homing.settling.thrust), all.add(homing.settling.turn_rad_s), all.add(homing.settling.turn_gain_rad_s2);
        all.add(homing.gain), all.add(homing.ramp_s), all.add(homing.arrived);
        all.add(homing.from_boundary);
    }
    all.add(flight.look_rad);
    for (const EffectEntry& one : all_effects)
        all.add(flight.effects[one.which]);
    all.add(double(flight.effects.comparison));
    all.add(flight.exposure_ev), all.add(flight.hud), all.add(flight.ticks), all.add(flight.left_ns);
    return all.sum;
}

std::string shown_digest(std::uint64_t digest)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest));
    return text;
}

} // namespace starbow
