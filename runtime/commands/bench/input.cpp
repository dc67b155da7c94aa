#include "input.h"
#include "config/json/error.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/commands/interrupt.h"
#include "runtime/exhibit/exhibit.h"
#include "runtime/exhibit/outputs.h"
#include "runtime/operation/latency.h"
#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;

/// The time that a device may be silent at the start: somebody finds it and takes it into the hand.
constexpr double grace_s = 4;
/// The frames that must have passed as well: while shaders are compiled, seconds lie between two of them.
constexpr int grace_frames = 60;

/// Counts from the first report on, and shows on standard error how far it is.
struct Measurement {
    double seconds;
    Latency latency{};
    Clock::time_point shown = Clock::now();
    int frames = 0;
    std::optional<Clock::time_point> drawn{}, began{}; ///< the first frame, and the first with a report

    static double since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

    void add(const FrameTimes& times)
    {
        if (frames++ == 0)
            drawn = Clock::now();
        if (times.report_ns == 0)
            return;
        if (!began) {
            began = Clock::now();
            std::fprintf(stderr, "A device reports; keep it moving for %.0f s (Ctrl-C: stop earlier)\n", seconds);
        }
        latency.add(times);
    }

    bool over()
    {
        const bool terminal = isatty(STDERR_FILENO);
        if (began && since(shown) > (terminal ? 1 : 10)) {
            shown = Clock::now();
            std::fprintf(stderr, "%s%.0f of %.0f s, %zu reports shown, %.0f s left%s", terminal ? "\r" : "", since(*began),
                seconds, latency.reports(), std::max(0.0, seconds - since(*began)), terminal ? "   " : "\n");
        }
        return interrupted() || (began ? since(*began) > seconds : frames > grace_frames && since(*drawn) > grace_s);
    }
};

} // namespace

int bench_input(const std::string& layout, double seconds)
{
    if (!has_display())
        throw InputError(
            "There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no present call can "
            "be timed; a desktop session is right");
    ExhibitOptions exhibit_options;
    exhibit_options.content = content_of_scene("avenue");
    exhibit_options.layout = load_layout(shipped_file("layouts", layout.empty() ? "desk" : layout));
    exhibit_options.words = words_in("en");
    exhibit_options.profiles = known_profiles();
    Measurement measurement{seconds};
    exhibit_options.timed = [&](const FrameTimes& times) { measurement.add(times); };
    exhibit_options.over = [&] { return measurement.over(); };
    catch_interrupts();
    WindowSystem window_system;
    std::fprintf(stderr, "Move a stick, a throttle or a pad: timing starts with its first report\n");
    const int status = fly_exhibit(exhibit_options);
    if (!measurement.began)
        throw InputError("No stick, throttle or pad has reported anything within " + std::to_string(int(grace_s))
            + " s, and a keyboard does not count; one that is plugged in ('starbow devices' lists them) and moved is right");
    std::printf("\n%s", measurement.latency.describe().c_str());
    return status;
}

} // namespace starbow
