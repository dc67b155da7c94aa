#include "latency.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace starbow {
namespace {

double ms(std::int64_t from_ns, std::int64_t to_ns) { return 1e-6 * double(to_ns - from_ns); }

} // namespace

double percentile(std::vector<double> values, double part)
{
    if (values.empty())
        return 0;
    // Rounding must not raise a whole rank to the next: 0.29 * 100 is 28.999999999999996, 0.07 * 100 is
    // 7.000000000000001.
    const double rank = std::ceil(part * double(values.size()) - 1e-9);
    const auto index = std::clamp<std::size_t>(std::size_t(std::max(rank, 1.0)), 1, values.size()) - 1;
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(index), values.end());
    return values[index];
}

void Latency::add(const FrameTimes& times)
{
    const FrameTimes before = std::exchange(last_, times);
    const bool first = before.shown_ns == 0;
    if (times.compiled || before.compiled) {
        apart_ms_.push_back(ms(times.read_ns, times.shown_ns));
        return;
    }
    if (own_ms_.empty())
        first_ns_ = times.shown_ns;
    if (!first)
        frame_ms_.push_back(ms(before.shown_ns, times.shown_ns));
    // A device's thread stamps a report and then hands it over. If the thread is held up between the two, the report is
    // older than controls that were read without it.
    const std::int64_t read_ns = first ? times.read_ns : before.read_ns;
    bound_ms_.push_back(
        ms(times.report_ns > before.report_ns ? std::min(read_ns, times.report_ns) : read_ns, times.shown_ns));
    own_ms_.push_back(ms(times.read_ns, times.handed_ns));
    present_ms_.push_back(ms(times.handed_ns, times.shown_ns));
    if (times.report_ns > before.report_ns)
        report_ms_.push_back(ms(times.report_ns, times.shown_ns));
}

std::string Latency::describe() const
{
    std::string text;
    char line[160];
    const auto add = [&](const char* format, auto... values) {
        std::snprintf(line, sizeof line, format, values...);
        text += line;
    };
    const auto row = [&](const char* name, const std::vector<double>& values) {
        add("%-52s %9.2f %9.2f %9.2f\n", name, percentile(values, 0.5), percentile(values, 0.99), percentile(values, 1));
    };
    add("%.1f s, %zu frames, %zu of them the first to show a report of a device\n\n", seconds(), frames(), reports());
    add("%-52s %9s %9s %9s\n", "milliseconds", "p50", "p99", "worst");
    row("report's arrival to the return of the present call", report_ms_);
    row("frame time", frame_ms_);
    row("own share: controls read to the present call", own_ms_);
    row("in the present call", present_ms_);
    row("no report takes longer, whenever it comes", bound_ms_);
    const double frame = percentile(frame_ms_, 0.5);
    if (frame > 0)
        add("\nthe own share is %.2f of a frame at p50, %.2f at p99\n", percentile(own_ms_, 0.5) / frame,
            percentile(own_ms_, 0.99) / frame);
    if (apart() > 0)
        add("not in the table: %zu frames with or just after a compilation of shaders, the longest of %.2f ms\n", apart(),
            percentile(apart_ms_, 1));
    return text;
}

} // namespace starbow
