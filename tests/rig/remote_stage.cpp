// Plays the frame thread of an exhibit for tests of the remote, without a GPU: remote_stage EXHIBIT.json [WORK_MS] publishes
// sixty times a second after WORK_MS of arithmetic, and applies commands to a state that is nothing but the snapshot. At
// SIGUSR1 and at its end it prints, in milliseconds: a frame's time on the clock and on the processor, and the time from
// "caption sent NS", NS on the monotonic clock, to the frame thread: "NAME P50 P99 MAX COUNT".
#include "config/json/error.h"
#include "config/model/exhibit_file.h"
#include "config/model/programme_file.h"
#include "config/model/shipped.h"
#include "runtime/remote/remote.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <thread>
#include <vector>

using namespace starbow;
using Clock = std::chrono::steady_clock;

namespace {

std::atomic<bool> ends{false}, prints{false};

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

/// Applies a command. Returns a refusal, or "".
std::string apply(const Command& command, Snapshot& now, int items)
{
    using enum CommandKind;
    switch (command.kind) {
    case stop:
        now.speed = 0, now.gamma = 1;
        break;
    case reset:
        now = {};
        now.items = items;
        now.scene = "avenue", now.language = "en", now.layout = "desk", now.quality = "balanced", now.max_gamma = 1e6;
        break;
    case tour:
        now.doing = Doing::tour, now.tour = command.text, now.step = 1, now.steps = 12, now.left_s = 42, now.shot.clear();
        now.next_caption = {{"en", "Soon we fly past it, to the left. Watch its colour."},
            {"de", "Gleich fliegen wir links daran vorbei. Achten Sie auf seine Farbe."}};
        break;
    case grip:
        now.grip = command.text, now.grip_says = "0.9, 0.1";
        break;
    case CommandKind::move: // std::move is another
        now.grip_says = std::to_string(int(command.number)) + " and " + std::to_string(int(command.second));
        break;
    case next:
        now.step = std::min(now.step + 1, now.steps);
        break;
    case back:
        now.step = std::max(now.step - 1, 1);
        break;
    case scene:
        if (command.text == "gone")
            return "There is no gone.json in config/scenes";
        now.scene = command.text, now.shot.clear(), now.tour.clear(), now.steps = 0, now.doing = Doing::flies;
        break;
    case shot:
        now.shot = command.text, now.tour.clear();
        break;
    case layout:
        now.layout = command.text;
        break;
    case pattern:
        now.pattern = command.text;
        break;
    case quality:
        now.quality = command.text;
        break;
    case restart:
        ends = true;
        break;
    default:
        try {
            static_cast<ExhibitState&>(now) = after(now, command);
        } catch (const InputError& error) {
            return error.what();
        }
    }
    return "";
}

/// Arithmetic of a given time at the processor's full speed; the count of its rounds is measured once.
double work(long rounds)
{
    volatile double sum = 0;
    for (long i = 1; i <= rounds; ++i)
        sum = sum + std::sqrt(double(i));
    return sum;
}

/// The picture of a binary PPM file, as ImageMagick writes it; without a file a sky with a Sun.
LivePicture read_picture(const char* file)
{
    LivePicture picture{.width = 480, .height = 270, .rgb = {}};
    int greatest = 255;
    std::FILE* const stream = file ? std::fopen(file, "rb") : nullptr;
    if (stream && std::fscanf(stream, "P6 %d %d %d%*c", &picture.width, &picture.height, &greatest) != 3)
        throw InputError(file, "", "is not a binary PPM; one is right");
    const std::size_t width = std::size_t(picture.width), pixels = width * std::size_t(picture.height);
    picture.rgb.resize(pixels * 3);
    if (stream) {
        picture.rgb.resize(std::fread(picture.rgb.data(), 1, picture.rgb.size(), stream));
        std::fclose(stream);
        return picture;
    }
    for (std::size_t i = 0; i < pixels; ++i) {
        const double x = double(i % width), y = double(i / width);
        const bool sun = std::hypot(x - 340, y - 90) < 24;
        picture.rgb[3 * i] = sun ? 255 : std::uint8_t(y / 3);
        picture.rgb[3 * i + 1] = sun ? 220 : std::uint8_t(30 + y / 4);
        picture.rgb[3 * i + 2] = sun ? 150 : std::uint8_t(90 + y / 4);
    }
    return picture;
}

struct Times {
    std::vector<double> wall, processor, commands;
};

void print(const char* name, std::vector<double>& values)
{
    std::sort(values.begin(), values.end());
    const auto at
        = [&](double part) { return values[std::min(values.size() - 1, std::size_t(part * double(values.size())))]; };
    if (!values.empty())
        std::printf("%s %.3f %.3f %.3f %zu\n", name, at(0.5), at(0.99), values.back(), values.size());
}

void print(Times& times)
{
    print("wall_ms", times.wall);
    print("processor_ms", times.processor);
    print("command_ms", times.commands);
    std::printf("end\n");
    std::fflush(stdout);
    times = {};
}

double clock_ms(clockid_t clock)
{
    timespec now{};
    clock_gettime(clock, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) / 1e6;
}

int play(const char* exhibit, double work_ms, const char* file)
{
    const LivePicture picture = read_picture(file);
    const Exhibit parts = load_exhibit(exhibit);
    RemoteOptions options{
        .settings = parts.remote, .patterns = {"none", "grid", "rings", "names", "wedges", "overlap"}, .version = "0.9.0"};
    if (!parts.programme.empty())
        options.programme = load_programme(shipped_file("programmes", parts.programme));
    const int items = options.programme ? int(options.programme->items.size()) : 0;
    Remote remote(std::move(options));
    for (std::size_t i = 0; i < remote.drawn_pins().size(); ++i)
        std::printf("%s %s\n", role_names[i], remote.drawn_pins()[i].c_str());
    std::printf("page %s\n", remote.page().c_str());
    std::fflush(stdout);
    Clock::time_point start = Clock::now();
    work(2000000);
    const long rounds = long(2000000 * work_ms / ms_since(start));
    Times times;
    Snapshot now;
    apply({.kind = CommandKind::reset}, now, items);
    NumberedCommand command;
    int published_second = -1;
    start = Clock::now();
    for (int frame = 0; !ends; ++frame) {
        if (prints.exchange(false))
            print(times);
        const double begin = clock_ms(CLOCK_MONOTONIC), processor = clock_ms(CLOCK_THREAD_CPUTIME_ID);
        while (remote.take(command)) {
            if (command.command.text.starts_with("sent "))
                times.commands.push_back(begin - std::atof(command.command.text.c_str() + 5) / 1e6);
            remote.answer(command.number, apply(command.command, now, items));
        }
        work(rounds);
        const double time = ms_since(start) / 1000;
        const double gamma_beta = now.fade ? 0 : 1.5 + std::sin(time / 5);
        now.gamma = std::min(std::hypot(1, gamma_beta), now.max_gamma),
        now.speed = std::sqrt(1 - 1 / (now.gamma * now.gamma));
        now.uptime_s = time, now.frames_per_s = 60, now.frame_ms = times.wall.empty() ? 0 : times.wall.back();
        remote.next_snapshot() = now;
        remote.publish_snapshot();
        if (const int second = int(time); second != published_second) {
            published_second = second;
            remote.next_condition().metrics
                = "# TYPE starbow_frames_total counter\nstarbow_frames_total " + std::to_string(frame) + "\n";
            remote.next_condition().log.assign(1, "info stage: " + std::to_string(second) + " s");
            remote.next_condition().grips = {"left, tilt", "left, upper left corner"};
            remote.next_condition().unkept = now.grip.empty() ? 0 : 1;
            remote.publish_condition();
            if (remote.picture_wanted()) {
                remote.next_picture() = picture;
                remote.publish_picture();
            }
        }
        times.wall.push_back(clock_ms(CLOCK_MONOTONIC) - begin);
        times.processor.push_back(clock_ms(CLOCK_THREAD_CPUTIME_ID) - processor);
        std::this_thread::sleep_until(start + std::chrono::microseconds(16667L * (frame + 1)));
    }
    print(times);
    return 0;
}

} // namespace

int main(int count, char** arguments)
{
    for (const int signal : {SIGTERM, SIGINT})
        std::signal(signal, [](int) { ends = true; });
    std::signal(SIGUSR1, [](int) { prints = true; });
    try {
        return play(arguments[1], count > 2 ? std::atof(arguments[2]) : 0, count > 3 ? arguments[3] : nullptr);
    } catch (const InputError& error) {
        std::fprintf(stderr, "remote_stage: %s\n", error.what());
        return 2;
    }
}
