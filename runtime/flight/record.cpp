#include "record.h"
#include "config/model/describe_shot.h"
#include "config/model/rules_reader.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;

/// True if Controls has exactly so many parts and no member of its own.
template <class... Parts> constexpr bool controls_have(Parts...)
{
    return requires { Controls{Parts{}...}; }
    &&!requires { Controls{Parts{}..., {}}; };
}
static_assert(controls_have(ControlTimes{}, Steering{}, Looking{}, Switches{}, AlignmentSteps{}, Touches{}));

/// Compiles only while these structs have exactly the members named here, whatever their sizes. A new member belongs in
/// the record, or in the digest, as well.
[[maybe_unused]] void name_every_member(const Controls& c, const Flying& f, const Exposing& e, const Flight& s)
{
    [[maybe_unused]] const auto& [time_ns, report_ns] = static_cast<const ControlTimes&>(c);
    [[maybe_unused]] const auto& [lever, throttle_rate, push, turn, taken] = static_cast<const Steering&>(c);
    [[maybe_unused]] const auto& [look_rad, head, exposure] = static_cast<const Looking&>(c);
    [[maybe_unused]] const auto& [choose, turn_by] = static_cast<const AlignmentSteps&>(c);
    [[maybe_unused]] const auto& [key_pressed, key_held] = static_cast<const Touches&>(c); // not kept: a record is one visit
    [[maybe_unused]] const auto& [mode, max_gamma, turn_deg_per_s, roll_deg_per_s, turn_jerk_deg_per_s3, rapidity_per_s,
        rapidity_jerk_per_s2, boundary, pace, solids, comfort, paced]
        = f;
    [[maybe_unused]] const auto& [no_roll, level_horizon, turn_steps_deg, vignette] = f.comfort;
    [[maybe_unused]] const auto& [elevation_deg, clear_deg, soft_deg, darkness] = *vignette;
    [[maybe_unused]] const auto& [exposure_mode, automatic, min_ev, max_ev, bloom, calm] = e;
    [[maybe_unused]] const auto& [ship, flight_mode, flight_lever, coasting, lever_waits, lever_rest, frozen, time_scale,
        homeward, thrust_inhibited, rate, thrust, turn_rad_s, turn_lead_rad_s, step_wait, vignette_part, homing,
        flight_look_rad, effects, exposure_ev, flight_hud, ticks, left_ns, leaps]
        = s;
}

/// Ranges wide enough for any device, narrow enough to prevent overflow.
constexpr Range any_rate{-1e3, 1e3};
constexpr Range any_place{-1e15, 1e15};
constexpr double most_ns = 9e15; ///< a hundred days; whole numbers below it are doubles

/// == would accept 0 for -0, which must come back as -0.
bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

template <class Vector> std::vector<double> components(const Vector& v)
{
    std::vector<double> all;
    for (int i = 0; i < Vector::length(); ++i)
        all.push_back(v[i]);
    return all;
}
std::vector<double> components(const glm::dquat& q) { return {q.w, q.x, q.y, q.z}; }
std::vector<double> components(double v) { return {v}; }

template <class Value> void put(Json& json, const char* name, const Value& value, const Value& usual)
{
    const std::vector<double> a = components(value), b = components(usual);
    if (!std::equal(a.begin(), a.end(), b.begin(), same))
        json[name] = a.size() == 1 ? Json(a[0]) : Json(a);
}

/// Reads a quaternion, w first.
void take_turn(const Place& place, const std::string& name, glm::dquat& turn)
{
    const auto p = find_member(place, name);
    if (!p)
        return;
    const glm::dvec4 v = vec4(*p, {-1.001, 1.001});
    if (std::abs(glm::length(v) - 1) > 0.001)
        fail_at(*p, "is not a turn; a list of four numbers whose squares add up to 1 is right");
    turn = glm::dquat(v[0], v[1], v[2], v[3]);
}

std::int64_t whole(const Place& place, double most)
{
    const double value = number(place, {0, most});
    if (value != std::floor(value))
        fail_at(place, "is not a whole number; one from 0 to " + shown(most) + " is right");
    return std::int64_t(value);
}

std::uint64_t read_digest(const Place& place)
{
    const std::string digits = text(place);
    if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdef") != digits.npos)
        fail_at(place, "is not a digest; a text of 16 hexadecimal digits is right");
    return std::stoull(digits, nullptr, 16);
}

/// Reads the start. It is not in the form of a shot's file, where a speed and directions would be rounded.
Shot read_start(const Place& place)
{
    reject_unknown_members(place, {"time", "position", "u", "ship_from_cockpit", "effects", "exposure_ev"});
    Shot start;
    read_optional(place, "time", start.time, any_place);
    read_optional(place, "position", start.position, any_place);
    read_optional(place, "u", start.u, any_place);
    take_turn(place, "ship_from_cockpit", start.ship_from_cockpit);
    if (auto p = find_member(place, "effects"))
        start.effects = read<Effects>(*p);
    read_optional(place, "exposure_ev", start.exposure_ev, {-60, 60});
    return start;
}

Pace read_pace(const Place& place)
{
    reject_unknown_members(place, {"per_s2", "least", "things"});
    Pace pace;
    read_optional(place, "per_s2", pace.per_s2, {0, 1e30});
    read_optional(place, "least", pace.least, {0, 1e15});
    for (const Place& thing : items(member(place, "things"), 0, 10'000, "things")) {
        const std::vector<Place> at = items(thing, 6, 6, "numbers (the lowest corner, the highest)");
        AlignedBox& box = pace.things.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            box.low[int(i)] = number(at[i], any_place);
            box.high[int(i)] = number(at[i + 3], any_place);
        }
    }
    return pace;
}

std::vector<Solid> read_solids(const Place& place)
{
    std::vector<Solid> solids;
    for (const Place& one : items(place, 0, 100, "solid balls")) {
        reject_unknown_members(one, {"radius", "span", "path"});
        Solid& solid = solids.emplace_back();
        solid.radius = number(member(one, "radius"), {0, 1e15});
        solid.span = number(member(one, "span"), {0, 1e15, true});
        const std::vector<Place> path
            = items(member(one, "path"), solid.path.size(), solid.path.size(), "points (a polynomial's coefficients)");
        for (std::size_t k = 0; k < path.size(); ++k)
            solid.path[k] = vec3(path[k], any_place);
    }
    return solids;
}

Flying read_rules(const Place& place)
{
    reject_unknown_members(place,
        {"mode", "max_gamma", "turn_deg_per_s", "roll_deg_per_s", "turn_jerk_deg_per_s3", "rapidity_per_s",
            "rapidity_jerk_per_s2", "boundary", "pace", "solids", "comfort"});
    Flying rules;
    if (auto p = find_member(place, "comfort"))
        rules.comfort = read_comfort(*p);
    if (auto p = find_member(place, "pace"))
        rules.pace = read_pace(*p);
    if (auto p = find_member(place, "boundary")) {
        reject_unknown_members(*p, {"centre", "radius"});
        Boundary& boundary = rules.boundary.emplace();
        read_optional(*p, "centre", boundary.centre, any_place);
        read_optional(*p, "radius", boundary.radius, {0, 1e15});
    }
    if (auto p = find_member(place, "solids"))
        rules.solids = read_solids(*p);
    rules.mode = chosen(member(place, "mode"), flight_modes);
    constexpr Range any{0, 1e9};
    read_optional(place, "max_gamma", rules.max_gamma, {1, 1e9, true});
    read_optional(place, "turn_deg_per_s", rules.turn_deg_per_s, any);
    read_optional(place, "roll_deg_per_s", rules.roll_deg_per_s, any);
    read_optional(place, "turn_jerk_deg_per_s3", rules.turn_jerk_deg_per_s3, any);
    read_optional(place, "rapidity_per_s", rules.rapidity_per_s, any);
    read_optional(place, "rapidity_jerk_per_s2", rules.rapidity_jerk_per_s2, any);
    return rules;
}

Command read_command(const Place& place)
{
    std::vector<std::string> words;
    for (const Place& word : items(place, 1, 2, "words")) {
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

/// range_curve.h says what the numbers are.
std::vector<double> read_range_goal(const Place& place)
{
    constexpr std::size_t before = 4, cells = RANGE_KNOTS - 1;
    const std::vector<Place> all = items(place, before + 1, before + cells, "numbers");
    std::vector<double> goal{number(all[0], {-1e3, 1e3}), number(all[1], {-1e3, 1e3}),
        double(integer(all[2], 0, int(cells + before - all.size()))), number(all[3], {-1e3, 1e3})};
    for (std::size_t i = before; i < all.size(); ++i)
        goal.push_back(number(all[i], {0, 1, true}));
    return goal;
}

RecordEntry read_entry(const Place& top)
{
    std::vector<std::string_view> known{"dt_ns", "skipped_ns", "unseen", "lever", "faster", "push", "turn", "look_rad",
        "head_m", "head_turned", "exposure", "exposure_ev", "light", "ranged", "range_goal", "choose", "turn_by", "taken",
        "commands"};
    for (const SwitchEntry& one : all_switches)
        known.emplace_back(one.name);
    reject_unknown_members(top, known);
    RecordEntry entry;
    entry.dt_ns = whole(member(top, "dt_ns"), 1e9);
    if (auto p = find_member(top, "skipped_ns"))
        entry.skipped_ns = whole(*p, most_ns);
    if (auto p = find_member(top, "exposure_ev"))
        entry.exposure_ev = number(*p, {-1e3, 1e3});
    read_optional(top, "light", entry.light, {0, 1});
    read_optional(top, "ranged", entry.ranged);
    if (auto p = find_member(top, "range_goal"))
        entry.range_goal = read_range_goal(*p);
    bool unseen = false;
    read_optional(top, "unseen", unseen);
    entry.shown = !unseen;
    Controls& controls = entry.controls;
    controls.time_ns = entry.dt_ns + entry.skipped_ns;
    if (auto p = find_member(top, "lever"))
        controls.lever = number(*p, {0, 1});
    read_optional(top, "faster", controls.throttle_rate, any_rate);
    read_optional(top, "push", controls.push, any_rate);
    read_optional(top, "turn", controls.turn, any_rate);
    read_optional(top, "look_rad", controls.look_rad, any_rate);
    read_optional(top, "head_m", controls.head.moved_m, any_rate);
    take_turn(top, "head_turned", controls.head.turned);
    read_optional(top, "exposure", controls.exposure, any_rate);
    if (auto p = find_member(top, "choose"))
        controls.choose = integer(*p, -1000, 1000);
    if (auto p = find_member(top, "turn_by"))
        controls.turn_by = integer(*p, -1000, 1000);
    for (const SwitchEntry& one : all_switches) {
        bool pressed = false;
        read_optional(top, std::string(one.name), pressed);
        controls.set(one.which, pressed);
    }
    read_optional(top, "taken", controls.taken);
    if (auto p = find_member(top, "commands"))
        for (const Place& command : items(*p, 1, 1000, "commands"))
            entry.commands.push_back(read_command(command));
    return entry;
}

RecordCheck read_check(const Place& top)
{
    reject_unknown_members(top, {"ticks", "digest", "last"});
    RecordCheck check;
    check.ticks = whole(member(top, "ticks"), most_ns);
    check.digest = read_digest(member(top, "digest"));
    read_optional(top, "last", check.last);
    return check;
}

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

std::string text_of(const RecordHeader& header)
{
    const Shot& start = header.start;
    const Flying& rules = header.rules;
    Json json;
    json["starbow_record"] = record_version;
    json["scene"] = header.scene;
    json["scene_digest"] = shown_digest(header.scene_digest);
    json["layout"] = header.layout;
    json["layout_digest"] = shown_digest(header.layout_digest);
    json["pattern"] = header.pattern;
    json["seconds_per_time_unit"] = header.seconds_per_time_unit;
    json["start"] = {{"time", start.time}, {"position", components(start.position)}, {"u", components(start.u)},
        {"ship_from_cockpit", components(start.ship_from_cockpit)}, {"effects", written(start.effects)},
        {"exposure_ev", start.exposure_ev}};
    json["flying"]
        = {{"mode", name_of(rules.mode)}, {"max_gamma", rules.max_gamma}, {"turn_deg_per_s", rules.turn_deg_per_s},
            {"roll_deg_per_s", rules.roll_deg_per_s}, {"turn_jerk_deg_per_s3", rules.turn_jerk_deg_per_s3},
            {"rapidity_per_s", rules.rapidity_per_s}, {"rapidity_jerk_per_s2", rules.rapidity_jerk_per_s2}};
    if (rules.boundary)
        json["flying"]["boundary"] = {{"centre", components(rules.boundary->centre)}, {"radius", rules.boundary->radius}};
    if (rules.pace) {
        Json& pace = json["flying"]["pace"] = {{"per_s2", rules.pace->per_s2}, {"least", rules.pace->least}};
        pace["things"] = Json::array();
        for (const auto& [low, high] : rules.pace->things)
            pace["things"].push_back({low.x, low.y, low.z, high.x, high.y, high.z});
    }
    for (const Solid& solid : rules.solids) {
        Json& one = json["flying"]["solids"].emplace_back(Json{{"radius", solid.radius}, {"span", solid.span}});
        for (const glm::dvec3& at : solid.path)
            one["path"].push_back(components(at));
    }
    if (const Json comfort = written_comfort(rules.comfort); !comfort.empty())
        json["flying"]["comfort"] = comfort;
    json["exposure"]
        = {{"automatic", header.exposing.automatic}, {"min_ev", header.exposing.min_ev}, {"max_ev", header.exposing.max_ev}};
    if (header.exposing.bloom)
        json["exposure"]["bloom"] = *header.exposing.bloom;
    if (header.exposing.mode != ExposureMode::eye)
        json["exposure"]["mode"] = name_of(header.exposing.mode);
    if (header.exposing.calm)
        json["calm"] = true;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_of(const RecordEntry& entry)
{
    const Controls& controls = entry.controls;
    static const Controls usual;
    Json json;
    json["dt_ns"] = entry.dt_ns;
    if (entry.skipped_ns != 0)
        json["skipped_ns"] = entry.skipped_ns;
    if (!entry.shown)
        json["unseen"] = true;
    if (entry.exposure_ev)
        json["exposure_ev"] = *entry.exposure_ev;
    if (entry.light != 1)
        json["light"] = entry.light;
    if (entry.ranged)
        json["ranged"] = true;
    if (!entry.range_goal.empty())
        json["range_goal"] = entry.range_goal;
    if (controls.lever)
        json["lever"] = *controls.lever;
    put(json, "faster", controls.throttle_rate, usual.throttle_rate);
    put(json, "push", controls.push, usual.push);
    put(json, "turn", controls.turn, usual.turn);
    put(json, "look_rad", controls.look_rad, usual.look_rad);
    put(json, "head_m", controls.head.moved_m, usual.head.moved_m);
    put(json, "head_turned", controls.head.turned, usual.head.turned);
    put(json, "exposure", controls.exposure, usual.exposure);
    if (controls.choose != 0)
        json["choose"] = controls.choose;
    if (controls.turn_by != 0)
        json["turn_by"] = controls.turn_by;
    for (const SwitchEntry& one : all_switches)
        if (controls[one.which])
            json[std::string(one.name)] = true;
    if (controls.taken)
        json["taken"] = true;
    for (const Command& command : entry.commands)
        json["commands"].push_back(words_of(command));
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_of(const RecordCheck& check)
{
    Json json{{"ticks", check.ticks}, {"digest", shown_digest(check.digest)}};
    if (check.last)
        json["last"] = true;
    return json.dump() + "\n";
}

RecordHeader parse_record_header(const std::string& file, std::string line)
{
    const Document document = parse_document(file, std::move(line));
    const Place top = root(document);
    if (!top.json->is_object() || !find_member(top, "starbow_record"))
        fail_at(top, "is not how a record begins; a file that starbow run --record has written is right");
    const Place version = member(top, "starbow_record");
    if (number(version, {0, 1e9}) != record_version)
        fail_at(version, "is a version of records that is not known here; " + std::to_string(record_version) + " is right");
    reject_unknown_members(top,
        {"starbow_record", "scene", "scene_digest", "layout", "layout_digest", "pattern", "seconds_per_time_unit", "start",
            "flying", "exposure", "calm"});
    RecordHeader header;
    header.scene = text(member(top, "scene"));
    header.scene_digest = read_digest(member(top, "scene_digest"));
    header.layout = text(member(top, "layout"));
    header.layout_digest = read_digest(member(top, "layout_digest"));
    header.pattern = text(member(top, "pattern"));
    header.seconds_per_time_unit = number(member(top, "seconds_per_time_unit"), {0, 1e60, true});
    header.start = read_start(member(top, "start"));
    header.start.scene = header.scene;
    header.rules = read_rules(member(top, "flying"));
    header.exposing = read_exposing(member(top, "exposure"));
    read_optional(top, "calm", header.exposing.calm);
    return header;
}

std::variant<RecordEntry, RecordCheck> parse_record_line(const std::string& file, int line, std::string content)
{
    const Document document = parse_document(file, std::move(content), line);
    const Place top = root(document);
    if (top.json->is_object() && find_member(top, "digest"))
        return read_check(top);
    return read_entry(top);
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
