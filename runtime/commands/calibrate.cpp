#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "input/calibration.h"
#include "input/hid.h"
#include "interrupt.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/operation/log.h"
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <poll.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace starbow {
namespace {

struct CalibrateOptions {
    std::string device, out;
    bool quick = false, force = false;
};

constexpr double hands_off_s = 1.5, back_s = 0.7;
constexpr int look_every_ms = 5; // a button is down for about a tenth of a second
constexpr int draw_every_ms = 50;
constexpr std::size_t bar_width = 41, most_buttons = 128;

using Look = std::function<void()>;

/// The person at the terminal.
class Person {
public:
    Person() { catch_interrupts(); }

    Look always = [] {}; ///< is called during every question

    /// Asks, and waits for a line; calls `look` meanwhile. Input typed ahead at a terminal is dropped: a second Enter by
    /// mistake would skip a step.
    std::string answer(const std::string& question, const Look& look = {})
    {
        std::printf("%s ", question.c_str());
        std::fflush(stdout);
        if (isatty(0)) {
            tcflush(0, TCIFLUSH);
            typed_.clear();
        }
        for (;;) {
            if (const auto end = typed_.find('\n'); end != typed_.npos) {
                const std::string line = typed_.substr(0, end);
                typed_.erase(0, end + 1);
                if (!isatty(0))
                    std::printf("\n"); // a terminal echoes Enter
                const auto first = line.find_first_not_of(" \t\r"), last = line.find_last_not_of(" \t\r");
                return first == line.npos ? "" : one_line(line.substr(first, last - first + 1), 200);
            }
            pollfd wait{0, POLLIN, 0};
            const int events = poll(&wait, 1, look_every_ms);
            if (interrupted())
                give_up();
            if (events > 0) {
                char bytes[256];
                const ssize_t count = read(0, bytes, sizeof bytes);
                if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN))
                    give_up();
                typed_.append(bytes, std::size_t(std::max<ssize_t>(count, 0)));
            }
            always();
            if (look)
                look();
        }
    }

    /// Calls `look` again and again for this time.
    void wait(double seconds, const Look& look)
    {
        std::fflush(stdout);
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(look_every_ms));
            if (interrupted())
                give_up();
            look();
        }
    }

private:
    [[noreturn]] static void give_up()
    {
        std::printf("\n");
        std::fflush(stdout);
        throw InputError("The calibration was stopped early; nothing was written");
    }
    std::string typed_;
};

/// The device that is being calibrated; it must stay plugged in.
struct Watched {
    const Hid& hid;
    DeviceInfo info;
    Descriptor descriptor;

    DeviceState now() const
    {
        for (Hid::Connected& seen : hid.devices())
            if (seen.info.path == info.path && seen.info.vendor == info.vendor && seen.info.product == info.product)
                return std::move(seen.state);
        throw InputError(describe(info) + " was unplugged; nothing was written");
    }
};

/// Limits how often lines are drawn, so that people can read them.
class Pace {
public:
    bool due()
    {
        const auto now = std::chrono::steady_clock::now();
        if (now < next_)
            return false;
        next_ = now + std::chrono::milliseconds(draw_every_ms);
        return true;
    }

private:
    std::chrono::steady_clock::time_point next_;
};

std::string description_of(const Hid::Connected& device)
{
    return describe(device.info) + (device.info.serial.empty() ? "" : ", serial number " + device.info.serial) + ", "
        + device.info.path;
}

/// Chooses a device: "044f:b10a" by vendor and product, "2" by its place in the list. Without `wanted` it takes the only
/// one, or asks.
Watched choose(Person& person, const Hid& hid, const std::string& wanted)
{
    person.wait(0.5, [] {}); // Hid opens the devices meanwhile
    std::vector<Hid::Connected> all = hid.devices();
    if (all.empty())
        throw InputError(
            "No stick, throttle, pad or space mouse that this user can read is plugged in; plug it in, then start again");
    const bool kind = wanted.size() == 9 && wanted[4] == ':';
    std::vector<Hid::Connected> fitting;
    for (std::size_t i = 0; i < all.size(); ++i) {
        char ids[16];
        std::snprintf(ids, sizeof ids, "%04x:%04x", unsigned(all[i].info.vendor), unsigned(all[i].info.product));
        if (wanted.empty() || (kind && strcasecmp(wanted.c_str(), ids) == 0) || wanted == std::to_string(i + 1))
            fitting.push_back(all[i]);
    }
    const auto list = [](const std::vector<Hid::Connected>& devices) {
        for (std::size_t i = 0; i < devices.size(); ++i)
            std::printf("  %zu  %s\n", i + 1, description_of(devices[i]).c_str());
    };
    if (fitting.empty()) {
        list(all);
        throw InputError("--device: " + wanted
            + " is not plugged in; a number from this list, or its four and four hexadecimal digits, are right");
    }
    std::size_t one = 0;
    if (fitting.size() > 1) {
        list(fitting);
        for (one = fitting.size(); one >= fitting.size();) {
            const std::string number
                = person.answer("Which of them? Type its number (1 to " + std::to_string(fitting.size()) + "), then Enter:");
            for (std::size_t i = 0; i < fitting.size(); ++i)
                if (number == std::to_string(i + 1))
                    one = i;
        }
    }
    return {hid, fitting[one].info, fitting[one].descriptor};
}

/// Names joined for a sentence: "X axis, twist (Rz)".
std::string names(const std::vector<SeenAxis>& axes, const std::function<bool(const SeenAxis&)>& which)
{
    std::string text;
    for (const SeenAxis& axis : axes)
        if (which(axis))
            text += (text.empty() ? "" : ", ") + describe(axis);
    return text;
}

/// Draws each axis on a line, with its range so far and its present value. again: over the lines drawn before.
void draw_axes(const Watched& device, const std::vector<SeenAxis>& axes, const DeviceState& state, bool again)
{
    if (again)
        std::printf("\033[%zuA", axes.size());
    for (const SeenAxis& axis : axes) {
        const Field& field = device.descriptor.fields[axis.field];
        const auto place = [&](std::int64_t raw) {
            return std::size_t(double(bar_width) / 2 + double(bar_width / 2) * centred(field, raw));
        };
        std::string bar(bar_width, '.');
        if (axis.low)
            for (std::size_t i = place(*axis.low); i <= place(*axis.high); ++i)
                bar[i] = '=';
        if (axis.field < state.raw.size() && state.raw[axis.field])
            bar[place(*state.raw[axis.field])] = '#';
        std::printf("\r\033[K  %-12s %s %s\n", describe(axis).c_str(), bar.c_str(),
            axis.low ? (std::to_string(*axis.low) + " to " + std::to_string(*axis.high)).c_str() : "no value yet");
    }
    std::fflush(stdout);
}

/// Samples the resting axes. An axis that moves was touched: it samples again, unless the axis never stops.
void stay_off(Person& person, const Watched& device, std::size_t when, double seconds, std::vector<SeenAxis>& axes)
{
    for (int attempt = 0; attempt < 3; ++attempt) {
        for (SeenAxis& axis : axes)
            axis.rest[when].clear();
        std::printf("Hands off for %s ...\n", when == 0 ? "two seconds" : "another second");
        person.wait(seconds, [&] { take_rest(device.now(), when, axes); });
        const std::string touched = names(
            axes, [&](const SeenAxis& axis) { return !kept_still(axis.rest[when], device.descriptor.fields[axis.field]); });
        if (touched.empty())
            return;
        std::printf("Moved meanwhile: %s. ", touched.c_str());
    }
    std::printf("It does not stop.\n");
}

void find_rest(Person& person, const Watched& device, std::vector<SeenAxis>& axes)
{
    std::string question = "\nThe middle. Move every control a little, let go of everything, hands off, and press Enter:";
    for (;;) {
        person.answer(question);
        stay_off(person, device, 0, hands_off_s, axes);
        if (std::any_of(axes.begin(), axes.end(), [](const SeenAxis& axis) { return !axis.rest[0].empty(); }))
            return;
        question = "The device has not sent anything yet. Move its controls a little, let go, and press Enter:";
    }
}

void find_ends(Person& person, const Watched& device, std::vector<SeenAxis>& axes)
{
    std::printf(
        "\nThe ends. Move every control slowly all the way to each of its ends, and around: stick, twist, throttle,\n"
        "pedals, triggers, whatever there is.\n");
    Pace pace;
    if (isatty(1)) {
        std::printf("Then let go of everything and press Enter.\n");
        draw_axes(device, axes, device.now(), false);
    }
    person.answer(isatty(1) ? "" : "Then let go of everything and press Enter:", [&] {
        const DeviceState state = device.now();
        take_ends(state, axes);
        if (isatty(1) && pace.due())
            draw_axes(device, axes, state, true);
    });
    stay_off(person, device, 1, back_s, axes);
    const std::string left
        = names(axes, [&](const SeenAxis& axis) { return !measured(axis, device.descriptor.fields[axis.field]).moved; });
    if (!left.empty())
        std::printf("Not moved to any ends, so left as they were: %s.\n", left.c_str());
}

/// The axes that have a role now: "Y axis" or "nothing".
std::string does(const Profile& present, AxisRole role, const std::vector<SeenAxis>& axes)
{
    std::string text;
    for (const AxisUse& use : present.axes)
        if (const auto axis = axis_of(use, axes); axis && use.role == role)
            text += (text.empty() ? "" : ", ") + describe(axes[*axis]);
    return text.empty() ? "nothing" : text;
}

std::string does(const Profile& present, ButtonRole role)
{
    std::string text;
    for (const ButtonUse& use : present.buttons)
        if (use.role == role)
            text += (text.empty() ? "button " : ", ") + std::to_string(use.button);
    return text.empty() ? "nothing" : text;
}

/// Asks until one axis is moved. Enter alone leaves the role as it was; "none" removes it.
void ask_axis(Person& person, const Watched& device, const Profile& present, const std::vector<SeenAxis>& axes,
    AxisRole role, const std::string& what, DeviceState from, Chosen& chosen)
{
    const std::string now = does(present, role, axes);
    const std::string question = what + ", hold it there, and press Enter.\n  (Now: " + now
        + ". Enter without moving leaves it as it is; 'none' and Enter: no control does it.)";
    for (;;) {
        std::string typed;
        if (role == AxisRole::throttle) {
            typed = person.answer("Throttle: first pull it back to idle, all the way, and press Enter.");
            from = device.now();
        }
        if (typed.empty())
            typed = person.answer(question);
        if (typed == "none") {
            chosen.axes.push_back({role, {}});
            std::printf("  No control does it.\n");
            return;
        }
        const std::vector<Push> found = pushed(device.descriptor, axes, from, device.now());
        if (found.empty()) {
            std::printf("  Nothing was moved: %s, as it was.\n", now.c_str());
            return;
        }
        if (found.size() > 1) {
            std::string both;
            for (const Push& push : found)
                both += (both.empty() ? "" : " and ") + describe(axes[push.axis]);
            std::printf("  Several moved: %s. Let go, then move one control alone.\n", both.c_str());
            continue;
        }
        const auto taken = std::find_if(chosen.axes.begin(), chosen.axes.end(), [&](const auto& answer) {
            return answer.second && answer.second->axis == found[0].axis
                && (answer.second->to_high == found[0].to_high || !one_sided(answer.first) || !one_sided(role));
        });
        if (taken != chosen.axes.end()) {
            std::printf("  %s is %s already. Take another control.\n", describe(axes[found[0].axis]).c_str(),
                name_of(taken->first).c_str());
            continue;
        }
        chosen.axes.push_back({role, found[0]});
        std::printf("  %s, to its %s end.\n", describe(axes[found[0].axis]).c_str(), found[0].to_high ? "high" : "low");
        return;
    }
}

void ask_axes(
    Person& person, const Watched& device, const Profile& present, const std::vector<SeenAxis>& axes, Chosen& chosen)
{
    std::printf("\nWhat each control does. Let go of everything between the questions.\n");
    const auto& applications = device.descriptor.applications;
    const bool pad = std::find(applications.begin(), applications.end(), Usage{1, 5}) != applications.end();
    std::vector<std::pair<AxisRole, std::string>> wanted{{AxisRole::nose_up, "Nose up: pull the control for it all the way"},
        {AxisRole::nose_right, "Nose to the right: move the control for it all the way"},
        {AxisRole::roll_right, "Roll to the right: move the control for it all the way"}};
    if (pad) {
        wanted.push_back({AxisRole::faster, "Faster: pull the control for it all the way"});
        wanted.push_back({AxisRole::slower, "Slower: pull the control for it all the way"});
    } else {
        wanted.push_back({AxisRole::throttle, "Now push it to full, all the way"});
    }
    const DeviceState from = device.now();
    for (const auto& [role, what] : wanted)
        ask_axis(person, device, present, axes, role, what, from, chosen);
}

/// The numbers of the pressed buttons.
std::vector<int> down(const Watched& device, const DeviceState& state)
{
    std::vector<int> numbers;
    for (std::size_t i = 0; i < std::min(state.raw.size(), device.descriptor.fields.size()); ++i) {
        const Field& field = device.descriptor.fields[i];
        if (is_button(field) && state.raw[i].value_or(0) != 0 && field.usage.id >= 1 && field.usage.id <= most_buttons)
            numbers.push_back(field.usage.id);
    }
    return numbers;
}

void ask_buttons(Person& person, const Watched& device, const Profile& present, Chosen& chosen)
{
    std::printf("\nButtons. For each line press the button to use, let go, then Enter. Enter alone leaves it as it is;\n"
                "'none' and Enter: no button does it.\n");
    for (const auto& [role, what] :
        std::vector<std::pair<ButtonRole, std::string>>{{Switch::stop, "Full stop"}, {Switch::home, "Back to the start"},
            {Switch::undo, "Ten seconds back"}, {Switch::next_mode, "Next way of flying"}})
        for (bool done = false; !done;) {
            std::vector<int> before = down(device, device.now());
            std::optional<int> pressed;
            const std::string typed = person.answer(what + " (now " + does(present, role) + "):", [&] {
                const std::vector<int> now = down(device, device.now());
                for (const int button : now)
                    if (std::find(before.begin(), before.end(), button) == before.end())
                        pressed = button;
                before = now;
            });
            done = true;
            const auto taken = std::find_if(chosen.buttons.begin(), chosen.buttons.end(),
                [&](const auto& answer) { return pressed && answer.second == pressed; });
            if (typed == "none") {
                chosen.buttons.push_back({role, {}});
                std::printf("  No button does it.\n");
            } else if (taken != chosen.buttons.end()) {
                std::printf("  Button %d is %s already. Press another.\n", *pressed, name_of(taken->first).c_str());
                done = false;
            } else if (pressed) {
                chosen.buttons.push_back({role, pressed});
                std::printf("  Button %d.\n", *pressed);
            }
        }
}

/// A warning about an axis' calibration, or "".
std::string warning_of(const AxisMeasure& is, const AxisUse& use)
{
    if (!is.moved)
        return "not moved: as it was";
    if (use.role != AxisRole::none && !one_sided(use.role)
        && (is.rests == AxisMeasure::Rest::low_end || is.rests == AxisMeasure::Rest::high_end))
        return "rests at an end: works to one side alone. Was it let go?";
    return use.dead_zone > 0.15 ? "jitters: worn or dirty?" : "";
}

void show(const Watched& device, const std::vector<SeenAxis>& axes, const Profile& profile)
{
    std::printf("\n  %-14s %-11s %-16s %-9s %-10s %s\n", "axis", "role", "ends", "middle", "dead zone", "inverted");
    for (const AxisUse& use : profile.axes)
        if (const auto i = axis_of(use, axes)) {
            const AxisMeasure is = measured(axes[*i], device.descriptor.fields[axes[*i].field]);
            std::string ends = "the device's", middle = "its own";
            if (use.range) {
                ends = starbow::shown(use.range->front()) + " to " + starbow::shown(use.range->back());
                middle = one_sided(use.role) || is.rests == AxisMeasure::Rest::anywhere ? "none"
                                                                                        : starbow::shown((*use.range)[1]);
            }
            char zone[16];
            std::snprintf(zone, sizeof zone, "%.1f %%", 100 * use.dead_zone);
            std::printf("  %-14s %-11s %-16s %-9s %-10s %-9s %s\n", describe(axes[*i]).c_str(), name_of(use.role).c_str(),
                ends.c_str(), middle.c_str(), zone, use.inverted ? "yes" : "no", warning_of(is, use).c_str());
        }
    for (const ButtonUse& use : profile.buttons)
        std::printf("  button %-7d %s\n", use.button, name_of(use.role).c_str());
}

std::filesystem::path own_file(const Profile& profile)
{
    char ids[16];
    std::snprintf(ids, sizeof ids, "%04x-%04x", unsigned(profile.vendor), unsigned(profile.product));
    std::string name = ids;
    if (!profile.serial.empty()) {
        name += "-";
        for (const char c : profile.serial) // a serial number may hold characters that a file's name can't
            name += std::isalnum((unsigned char)(c)) || c == '.' || c == '_' ? c : '_';
    }
    return own_profiles() / (name + ".json");
}

void ask_name(Person& person, const Watched& device, Profile& profile)
{
    const std::string name = person.answer("\nA name for this profile (Enter: " + device.info.name + "):");
    profile.name = name.empty() ? device.info.name : name;
    profile.vendor = device.info.vendor, profile.product = device.info.product;
    profile.serial.clear();
    if (device.info.serial.empty())
        return;
    const std::string alone = person.answer("Is it for this one device alone, by its serial number " + device.info.serial
        + "? (y and Enter: this one alone; Enter: all of its kind):");
    if (alone == "y" || alone == "yes")
        profile.serial = device.info.serial;
}

/// Prints the profile that this device will use, if it is not the one just written.
void report_other_profile(const Watched& device, const std::filesystem::path& file)
{
    const Profile counts = profile_for(known_profiles(), device.info, device.descriptor);
    std::error_code error;
    if (!std::filesystem::equivalent(counts.file, file, error))
        std::printf("For this device %s counts before it.\n",
            counts.file.empty() ? "the profile made from its usages" : counts.file.string().c_str());
}

int calibrate(const CalibrateOptions& options)
{
    const std::vector<Profile> known = known_profiles();
    Person person;
    const Hid hid(known, write_log);
    const Watched device = choose(person, hid, options.device);
    person.always = [&] { (void)device.now(); };
    const Profile present = profile_for(known, device.info, device.descriptor);
    std::printf("Calibrating %s; its profile so far: %s.\nEach step ends with Enter. Ctrl-C gives up: nothing is written.\n",
        describe(device.info).c_str(), one_line(present.name).c_str());

    std::vector<SeenAxis> axes = axes_of(device.descriptor);
    Chosen chosen;
    if (!axes.empty()) {
        find_rest(person, device, axes);
        find_ends(person, device, axes);
        if (!options.quick)
            ask_axes(person, device, present, axes, chosen);
    }
    if (!options.quick)
        ask_buttons(person, device, present, chosen);
    Profile profile = calibrated(present, device.descriptor, axes, chosen);
    ask_name(person, device, profile);
    show(device, axes, profile);

    const std::filesystem::path file = options.out.empty() ? own_file(profile) : std::filesystem::path(options.out);
    std::error_code error;
    if (!options.force && std::filesystem::exists(file, error)) {
        const std::string replace
            = person.answer("\n" + file.string() + " is there already. y and Enter replaces it; Enter gives up:");
        if (replace != "y" && replace != "yes")
            throw InputError(file.string(), "", "is there already and was kept; --force or another --out is right");
    }
    if (interrupted())
        throw InputError("The calibration was stopped early; nothing was written");
    save_profile(profile, file);
    std::printf("\nWritten to %s.\nA running exhibit keeps the profile that it has and reads this one at its next start.\n",
        file.c_str());
    if (options.out.empty())
        report_other_profile(device, file);
    return 0;
}

} // namespace

static void add_calibrate(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<CalibrateOptions>();
    Subcommand* command = app.add_subcommand(
        "calibrate", "Guide you through the calibration of a stick, throttle, pad or pedals, and write its profile.");
    command->add_option("--device", options->device,
        "The device, if several are plugged in: its four and four hexadecimal digits, or its number in the list");
    command->add_option("--out", options->out, "The profile's file; without it, a file in ~/.config/starbow/profiles");
    command->add_flag("--quick", options->quick, "Middle and ends alone; the controls keep their roles");
    command->add_flag("--force", options->force, "Replace a file of that name without asking");
    command->footer("Asks step by step and writes at the end; Ctrl-C gives up, and nothing is written.\n\n"
                    "Examples:\n  starbow calibrate\n  starbow calibrate --device 044f:b10a --quick\n"
                    "  starbow calibrate --device 2 --out my/profiles/left-stick.json");
    command->callback([options, &chosen] { chosen = [options] { return calibrate(*options); }; });
}

static const Registered calibrate_command{7, add_calibrate};

} // namespace starbow
