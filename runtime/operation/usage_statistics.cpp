#include "usage_statistics.h"
#include "config/json/error.h"
#include "config/json/folder.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "log.h"
#include <algorithm>
#include <chrono>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

namespace starbow {
namespace {

constexpr std::time_t write_every_s = 60, expose_every_s = 15;

struct DateAndHour {
    std::string date;
    int hour;
};

DateAndHour local(std::time_t time)
{
    std::tm parts{};
    localtime_r(&time, &parts);
    std::array<char, 16> date;
    std::strftime(date.data(), date.size(), "%Y-%m-%d", &parts);
    return {date.data(), parts.tm_hour};
}

bool is_date(const std::string& text)
{
    if (text.size() != 10)
        return false;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (i == 4 || i == 7 ? text[i] != '-' : text[i] < '0' || text[i] > '9')
            return false;
    return true;
}

/// A checksum over a day's counts. Equal values have equal texts.
std::string sum_of(const std::string& date, const nlohmann::json& hours)
{
    Hash hash;
    hash.add(date);
    hash.add(hours.dump());
    return cache_key(hash.value, "");
}

std::string text_of(const UsageDay& day)
{
    nlohmann::json hours = nlohmann::json::object();
    for (std::size_t hour = 0; hour < day.hours.size(); ++hour)
        if (day.hours[hour].frames() > 0)
            hours[(hour < 10 ? "0" : "") + std::to_string(hour)] = json_of(day.hours[hour]);
    return nlohmann::json{{"starbow_day", day.date}, {"hours", hours}, {"sum", sum_of(day.date, hours)}}.dump(1) + "\n";
}

void write_day(const std::filesystem::path& state, const UsageDay& day)
{
    const std::string text = text_of(day);
    write_own(day_file(state, day.date), text);
}

} // namespace

std::string date_of(std::time_t time) { return local(time).date; }

std::filesystem::path day_file(const std::filesystem::path& state, const std::string& date)
{
    return state / "days" / (date + ".json");
}

UsageDay load_usage_day(const std::filesystem::path& state, const std::string& date)
{
    if (!is_date(date))
        throw InputError(one_line(date, 40) + " is not a day; a date such as 2026-11-23 is right");
    UsageDay day{date};
    const std::filesystem::path file = day_file(state, date);
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        return day;
    const Document document = read_document(file);
    const Place top = root(document);
    if (!top.json->is_object() || !find_member(top, "starbow_day"))
        fail_at(top, "is not a day's counts; a file that starbow run has written is right");
    const Place hours = member(top, "hours");
    if (!hours.json->is_object())
        fail_at(hours, "is not a list of hours; an object with members such as \"09\" is right");
    // Days of older versions have no checksum.
    if (const auto sum = find_member(top, "sum"); sum && *sum->json != sum_of(date, *hours.json))
        fail_at(*sum,
            "is not the checksum of these counts, so the file is damaged; a file as starbow run has written it is right");
    for (int hour = 0; hour < 24; ++hour)
        if (const auto at = hours.json->find(std::string(hour < 10 ? "0" : "") + std::to_string(hour));
            at != hours.json->end())
            day.hours[std::size_t(hour)] = usage_counts_of(*at);
    return day;
}

std::vector<std::string> days_in(const std::filesystem::path& state)
{
    std::vector<std::string> days;
    each_entry(state / "days", [&](const std::filesystem::path& file) {
        if (const std::string name = file.stem(); file.extension() == ".json" && is_date(name))
            days.push_back(name);
    });
    std::ranges::sort(days);
    return days;
}

UsageStatistics::UsageStatistics(std::filesystem::path state, std::filesystem::path textfile)
    : state_(std::move(state))
    , textfile_(std::move(textfile))
{
}

UsageStatistics::~UsageStatistics()
{
    try {
        close();
    } catch (const std::bad_alloc&) { // the counts of the last minute are lost
    }
}

void UsageStatistics::close()
{
    if (hour_of_day_ < 0)
        return;
    add_hour();
    write(true);
    hour_of_day_ = -1;
}

/// Adds the counts of the hour so far to the day that they belong to.
void UsageStatistics::add_hour()
{
    day_.hours[std::size_t(hour_of_day_)] += hour_;
    hour_ = {};
}

/// A day's counts so far: of a day that has ended and is not written yet (the clock was set back), or of its file.
UsageDay UsageStatistics::day_of(const std::string& date)
{
    if (const auto at = std::ranges::find(ended_, date, [](const auto& day) { return day->date; }); at != ended_.end()) {
        const UsageDay day = **at;
        ended_.erase(at);
        return day;
    }
    try {
        return state_.empty() ? UsageDay{date} : load_usage_day(state_, date);
    } catch (const InputError& error) {
        write_log(LogKind::usage_damaged, one_line(error.what()) + "; the day's counts begin again");
        return {date};
    }
}

bool UsageStatistics::turn(std::time_t now, const Gauges& gauges)
{
    const DateAndHour local_now = local(now);
    if (hour_of_day_ < 0 || local_now.date != day_.date) {
        if (hour_of_day_ >= 0) {
            add_hour();
            ended_.push_back(std::make_shared<const UsageDay>(std::move(day_)));
        }
        day_ = day_of(local_now.date);
        hour_of_day_ = local_now.hour, written_ = now;
        if (!ended_.empty())
            write(false);
    } else if (local_now.hour != hour_of_day_) {
        add_hour();
        hour_of_day_ = local_now.hour;
    }
    if (now - written_ >= write_every_s || now < written_) {
        add_hour();
        write(false);
        written_ = now;
    }
    if (now - exposed_ < expose_every_s && now >= exposed_ && !exposition_.empty())
        return false;
    exposition_ = exposition_of(since_start_, gauges);
    exposed_ = now;
    if (!textfile_.empty())
        write(false);
    return true;
}

/// Takes the result of the write on the other thread, which may still have to end. A failed write is told once.
void UsageStatistics::finish()
{
    if (!writing_.valid())
        return;
    try {
        const std::vector<EndedDay> written = writing_.get();
        std::erase_if(ended_, [&](const EndedDay& day) { return std::ranges::find(written, day) != written.end(); });
        failed_ = false;
    } catch (const InputError& error) {
        fail(one_line(error.what()));
    } catch (const std::system_error& error) {
        fail(error.what());
    }
}

void UsageStatistics::fail(const std::string& reason)
{
    if (!std::exchange(failed_, true))
        write_log(LogKind::usage_unwritten, reason + "; the counts are kept in memory and written later");
}

/// Writes the files on a thread of its own. waits: until they are written; otherwise a write that is still under way makes
/// this one wait for its next turn.
void UsageStatistics::write(bool waits)
{
    using namespace std::chrono_literals;
    if (writing_.valid() && !waits && writing_.wait_for(0s) != std::future_status::ready)
        return;
    finish(); // after a failed write, too, the newest counts are tried: the reason may be gone
    try {
        writing_ = std::async(std::launch::async,
            [state = state_, textfile = textfile_, exposition = exposition_, ended = ended_, day = day_] {
                if (!state.empty()) {
                    for (const EndedDay& one : ended)
                        write_day(state, *one);
                    write_day(state, day);
                }
                if (!textfile.empty() && !exposition.empty())
                    write_whole(textfile, exposition);
                return ended;
            });
    } catch (const std::system_error& error) { // no thread can be made now
        fail(error.what());
    }
    if (waits)
        finish();
}

} // namespace starbow
