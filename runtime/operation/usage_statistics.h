#pragma once
#include "usage_counts.h"
#include <array>
#include <ctime>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace starbow {

/// One day's counts by the hour, as a file in the state folder: days/2026-11-23.json.
struct UsageDay {
    std::string date; ///< 2026-11-23
    std::array<UsageCounts, 24> hours{};
};

/// The file of a date in a state folder.
std::filesystem::path day_file(const std::filesystem::path& state, const std::string& date);
/// A day's file; a missing one is a day without counts. Throws InputError for a file that is no day.
UsageDay load_usage_day(const std::filesystem::path& state, const std::string& date);
/// The days of which there are files, in order.
std::vector<std::string> days_in(const std::filesystem::path& state);
/// A date and an hour by the machine's clock and zone.
std::string date_of(std::time_t time);

/// Keeps an exhibit's counts: since the start, and by the hour in the day's file. The files are written beside the frame
/// thread, which never waits for a disk.
class UsageStatistics {
public:
    /// state: the state folder; empty: no file is written. textfile: receives the exposition for node_exporter; empty: none.
    explicit UsageStatistics(std::filesystem::path state, std::filesystem::path textfile = {});
    ~UsageStatistics(); ///< closes it
    UsageStatistics(const UsageStatistics&) = delete;

    /// Calls `count` with each counts that a new event belongs to.
    template <class Count> void count(const Count& count)
    {
        count(since_start_);
        count(hour_);
    }
    const UsageCounts& since_start() const { return since_start_; }

    /// Call it about once a second. now: the machine's clock, which may have been set back. Every minute, and at an hour's
    /// end, the day's file is written; every 15 seconds the text for node_exporter. Returns true when an exposition was
    /// made.
    bool turn(std::time_t now, const Gauges& gauges);
    /// Writes what is left. They count no more.
    void close();
    /// The last exposition.
    const std::string& exposition() const { return exposition_; }

private:
    void add_hour();
    UsageDay day_of(const std::string& date);
    void write(bool waits);
    void finish();
    void fail(const std::string& reason);

    using EndedDay = std::shared_ptr<const UsageDay>;
    std::filesystem::path state_, textfile_;
    UsageCounts since_start_, hour_; ///< hour_: not yet added to the day
    UsageDay day_;
    std::vector<EndedDay> ended_; ///< days before, of which no write has ended yet
    int hour_of_day_ = -1;
    std::time_t written_ = 0, exposed_ = 0;
    std::string exposition_;
    std::future<std::vector<EndedDay>> writing_; ///< gives the ended days that it has written
    bool failed_ = false; ///< logged once
};

} // namespace starbow
