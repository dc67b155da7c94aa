#include "commands.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/operation/state_folder.h"
#include "runtime/operation/usage_statistics.h"
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <sstream>

namespace starbow {
namespace {

struct ReportOptions {
    std::string day, state, out;
};

std::string figure(double x, int decimals)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.*f", decimals, x);
    return text.data();
}

std::string time_of(double s)
{
    const long whole = std::lround(s);
    if (whole < 60)
        return std::to_string(whole) + " s";
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

/// A bar for each hour from the first to the last one with pictures.
template <class Value>
std::string bars(const UsageDay& day, int first, int last, const char* colour, int decimals, const Value& value)
{
    constexpr double width = 800, height = 180, foot = 24, head = 20;
    double most = 0;
    for (int hour = first; hour <= last; ++hour)
        most = std::max(most, value(day.hours[std::size_t(hour)]));
    const double pitch = width / double(last - first + 1);
    const double ground = height - foot;
    Svg svg;
    for (int hour = first; hour <= last; ++hour) {
        const double v = value(day.hours[std::size_t(hour)]), x = pitch * (hour - first), middle = x + 0.5 * pitch;
        const double tall = most > 0 ? (ground - head) * v / most : 0;
        svg.rect({x + 0.1 * pitch, ground - tall}, {x + 0.9 * pitch, ground}, attribute("fill", colour));
        svg.text({middle, height - 6}, std::to_string(hour), "text-anchor=\"middle\"");
        if (v > 0)
            svg.text({middle, ground - tall - 4}, figure(v, decimals), "text-anchor=\"middle\"");
    }
    svg.line({0, ground}, {width, ground}, "stroke=\"#888\"");
    return svg.drawn({width, height}, "role=\"img\"");
}

/// A count with a comma before each three digits.
std::string grouped(std::uint64_t count)
{
    std::string digits = std::to_string(count);
    for (std::ptrdiff_t at = std::ptrdiff_t(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(std::size_t(at), ",");
    return digits;
}

std::string page_of(const UsageDay& day, int first, int last, const UsageCounts& all)
{
    std::ostringstream out;
    const std::string mean = all.visits > 0 ? time_of(all.visits_s / double(all.visits)) : "none";
    out << page_begin("en", "Starbow, " + day.date) << "<h1>Starbow on " << day.date << "</h1>\n<table>\n"
        << table_row({"Visits", grouped(all.visits)}) << table_row({"Mean length of a visit", mean})
        << table_row({"Tours shown to their end", grouped(all.tours_finished)})
        << table_row({"Pictures", grouped(all.frames())})
        << table_row({"Half of them came within", figure(1e3 * all.percentile_s(0.5), 1) + " ms"})
        << table_row({"99.9 % of them came within", figure(1e3 * all.percentile_s(0.999), 1) + " ms"})
        << table_row({"The longest took", figure(1e3 * all.longest_frame_s, 1) + " ms"})
        << table_row({"Missed refreshes", grouped(all.missed_refreshes)})
        << table_row({"Worst skew of the outputs", figure(1e3 * all.worst_skew_s, 2) + " ms"})
        << table_row({"The GPU was lost", std::to_string(all.device_losses) + " times"})
        << table_row({"A stick went away", std::to_string(all.unplugged) + " times"})
        << table_row({"Commands of remotes, and refused ones", grouped(all.commands) + ", " + grouped(all.refused_commands)})
        << table_row({"Greatest memory", figure(1e-6 * double(all.resident_bytes), 0) + " MB"}) << "</table>\n";
    out << "<h2>Visits by the hour</h2>\n"
        << bars(day, first, last, "#0b5fa5", 0, [](const UsageCounts& counts) { return double(counts.visits); });
    out << "<h2>Mean length of a visit, seconds</h2>\n"
        << bars(day, first, last, "#15803d", 0,
               [](const UsageCounts& counts) { return counts.visits > 0 ? counts.visits_s / double(counts.visits) : 0; });
    out << "<h2>Missed refreshes in 100,000 pictures</h2>\n"
        << bars(day, first, last, "#c2410c", 1, [](const UsageCounts& counts) {
               return counts.frames() > 0 ? 1e5 * double(counts.missed_refreshes) / double(counts.frames()) : 0;
           });
    out << "<h2>Time of the visitors in each scene</h2>\n<table>\n";
    for (const auto& [scene, s] : all.scenes_s)
        out << table_row({scene, time_of(s)});
    out << "</table>\n<p>Counts belong to whole hours; nothing here tells who came.</p>\n</body></html>\n";
    return out.str();
}

int report(const ReportOptions& options)
{
    const std::filesystem::path state = options.state.empty() ? state_folder() : std::filesystem::path(options.state);
    const std::string date = options.day.empty() ? date_of(std::time(nullptr)) : options.day;
    const UsageDay day = load_usage_day(state, date);
    int first = 24, last = -1;
    UsageCounts all;
    for (int hour = 0; hour < 24; ++hour)
        if (const UsageCounts& counts = day.hours[std::size_t(hour)]; counts.frames() > 0) {
            all += counts;
            first = std::min(first, hour), last = hour;
        }
    if (last < 0) {
        std::string known;
        for (const std::string& one : days_in(state))
            known += (known.empty() ? "" : ", ") + one;
        throw InputError("No picture was counted on " + date + " in " + (state / "days").string()
            + (known.empty() ? "; no day has counts yet" : "; days with counts are " + known));
    }
    const std::filesystem::path out = options.out.empty() ? std::filesystem::path("out") / ("report-" + date + ".html")
                                                          : std::filesystem::path(options.out);
    make_folder_of(out);
    write_whole(out, page_of(day, first, last, all));
    std::printf("%s: %llu visits, %llu pictures, %llu missed refreshes; the page is %s\n", date.c_str(),
        (unsigned long long)all.visits, (unsigned long long)all.frames(), (unsigned long long)all.missed_refreshes,
        out.c_str());
    return 0;
}

} // namespace

static void add_report(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<ReportOptions>();
    Subcommand* command = app.add_subcommand("report",
        "Draw a day of the exhibit as a page: how many came, for how long, in which scenes, and when it stuttered.");
    command->add_option("day", options->day, "The day, such as 2026-11-23 [today]");
    command->add_option("--state", options->state, "The exhibit's state folder, such as /var/lib/starbow [this person's]");
    command->add_option("--out", options->out, "The page to write [out/report-DAY.html]");
    command->footer("Examples:\n  starbow report\n  starbow report 2026-11-23 --state /var/lib/starbow --out day.html");
    command->callback([options, &chosen] { chosen = [options] { return report(*options); }; });
}

static const Registered report_command{12, add_report};

} // namespace starbow
