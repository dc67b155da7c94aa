#include "lab_log.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <unistd.h>

namespace starbow {
namespace {

constexpr const char* line_end = "\r\n"; // RFC 4180

using Columns = std::vector<std::pair<std::string, std::string>>;

/// Formats a number with a decimal point in any locale.
std::string csv_number(double value)
{
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.12g", value);
    for (char& c : text)
        if (c == ',')
            c = '.';
    return text.data();
}

std::string csv_number(const std::optional<double>& value, double unit = 1)
{
    return value ? csv_number(*value / unit) : "";
}

void add_spot(Columns& columns, const std::string& name, const std::optional<SpotReading>& spot)
{
    const SpotReading& s = spot ? *spot : SpotReading{};
    const auto known = [&](const std::string& text) { return spot ? text : std::string(); };
    columns.insert(columns.end(),
        {{name + "_from_motion_deg", csv_number(s.from_motion_rad, degree)},
            {name + "_from_motion_in_world_deg", csv_number(s.from_motion_world_rad, degree)},
            {name + "_relative_gamma_beta", known(csv_number(s.relative_u))},
            {name + "_from_relative_motion_deg", csv_number(s.from_relative_motion_rad, degree)},
            {name + "_doppler", known(csv_number(s.ray.D))}, {name + "_550_nm_seen_as_nm", known(csv_number(s.seen_nm))},
            {name + "_distance_light_s", csv_number(s.distance_s)},
            {name + "_distance_in_ship_light_s", csv_number(s.ship_distance_s)},
            {name + "_emitted_world_s", csv_number(s.emitted_s)}, {name + "_clock_s", csv_number(s.clock_s)}});
}

void add_reading(Columns& columns, const std::optional<WrittenReading>& reading)
{
    const auto number = [&](double value) { return reading ? csv_number(value) : ""; };
    const WrittenReading r = reading.value_or(WrittenReading{});
    columns.insert(columns.end(),
        {{"reading_of", reading ? std::string(entry_of(r.of).name) : ""}, {"reading", number(r.value)},
            {"reading_uncertainty", number(r.uncertainty)}, {"reading_theory", number(r.theory)},
            {"reading_sigmas", number(r.sigmas())}});
}

Columns columns_of(
    const Measured& m, const std::string& overlay, const std::string& utc, const std::optional<WrittenReading>& reading = {})
{
    const MeasuringObserver& o = m.observer;
    const double speed = glm::length(o.u), gamma = physics::gamma_of(o.u);
    Columns all = {{"utc", utc}, {"ship_time_s", csv_number(m.ship_s)}, {"world_time_s", csv_number(m.world_s)}};
    const double unit = m.seconds_per_time_unit;
    constexpr std::array<const char*, 3> places = {"place_x_light_s", "place_y_light_s", "place_z_light_s"},
                                         velocities = {"gamma_beta_x", "gamma_beta_y", "gamma_beta_z"};
    for (int i = 0; i < 3; ++i)
        all.emplace_back(places[std::size_t(i)], csv_number(o.place[i] * unit));
    for (int i = 0; i < 3; ++i)
        all.emplace_back(velocities[std::size_t(i)], csv_number(o.u[i]));
    all.insert(all.end(),
        {{"gamma", csv_number(gamma)}, {"beta", csv_number(speed / gamma)},
            {"one_minus_beta", csv_number(1 / (gamma * (gamma + speed)))}});
    for (const EffectEntry& one : all_effects)
        if (one.usual)
            all.emplace_back(std::string(one.name) + "_on", m.effects[one.which] ? "1" : "0");
    all.insert(all.end(), {{"overlay", overlay}, {"doppler_1_from_motion_deg", csv_number(unshifted_angle(o), degree)}});
    add_spot(all, "aim", m.aim);
    all.emplace_back("aim_light", csv_number(m.aim.light));
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string name = "mark_" + std::to_string(i + 1);
        all.emplace_back(name + "_number", m.mark_numbers[i] > 0 ? std::to_string(m.mark_numbers[i]) : "");
        add_spot(all, name, m.marks[i]);
    }
    const PairReading pair = m.pair.value_or(PairReading{});
    all.insert(all.end(),
        {{"marks_angle_deg", m.pair ? csv_number(pair.angle_rad / degree) : ""},
            {"marks_apparent_length_light_s", csv_number(pair.apparent_s)},
            {"marks_rest_length_light_s", csv_number(pair.rest_s)},
            {"marks_contracted_length_light_s", csv_number(pair.contracted_s)},
            {"marks_relative_gamma_beta", csv_number(pair.relative_u)},
            {"marks_from_motion_at_rest_deg", csv_number(pair.from_motion_at_rest_rad, degree)},
            {"marks_clock_2_minus_1_s", csv_number(pair.clocks_s)}});
    add_reading(all, reading);
    return all;
}

std::string joined(const Columns& columns, std::string Columns::value_type::*member)
{
    std::string line;
    for (const auto& column : columns)
        line.append(&column == &columns.front() ? "" : ",").append(column.*member);
    return line;
}

std::string utc_now()
{
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    std::array<char, 40> day, part;
    std::strftime(day.data(), day.size(), "%Y-%m-%dT%H:%M:%S", &utc);
    std::snprintf(part.data(), part.size(), ".%03dZ", int(ms));
    return std::string(day.data()) + part.data();
}

} // namespace

std::string log_header() { return joined(columns_of({}, "", ""), &Columns::value_type::first); }

std::string log_line(const Measured& measured, const std::string& overlay, const std::string& utc,
    const std::optional<WrittenReading>& reading)
{
    return joined(columns_of(measured, overlay, utc, reading), &Columns::value_type::second);
}

LabLog::LabLog(const std::filesystem::path& file, LogTo log)
    : file_(file)
    , log_(std::move(log))
{
    stream_ = open_to_write(file, O_APPEND, "a CSV file in a folder that can be written");
    const std::string header = log_header() + line_end;
    std::array<char, 65536> piece;
    char last = '\n'; // of the file; another one where its last line is incomplete, as after a power cut
    RegularFile known(file);
    for (std::size_t got; (got = known.read(piece)) > 0; last = piece[got - 1]) {
        if (const std::string_view begin(piece.data(), std::min(got, header.size()));
            lines_ == 0 && begin != header && !begin.starts_with(log_header() + "\n")) {
            close(stream_);
            throw InputError(one_line(file.string()), "1",
                "begins otherwise than a log of this program does; a new file, or one that starbow run --log has written, "
                "is right");
        }
        lines_ += std::count(piece.data(), piece.data() + got, '\n');
    }
    if (lines_ == 0)
        write_out(header), lines_ = 1;
    else if (last != '\n')
        write_out(line_end), ++lines_;
    --lines_;
}

LabLog::~LabLog() { close(stream_); }

bool LabLog::write(const Measured& measured, const std::string& overlay, const std::optional<WrittenReading>& reading)
{
    std::string line = log_line(measured, overlay, utc_now(), reading);
    if (!write_out(line + line_end))
        return false;
    last_ = std::move(line);
    ++lines_;
    return true;
}

bool LabLog::write_out(const std::string& text)
{
    if (!failed_ && ::write(stream_, text.data(), text.size()) != ssize_t(text.size())) {
        failed_ = true;
        log_(LogKind::lab_log_ended,
            file_.string() + ": can't be written (" + std::strerror(errno) + "); the log ends here, the flight goes on");
    }
    return !failed_;
}

} // namespace starbow
