#include "hid.h"
#include "rates.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <hidapi/hidapi.h>
#include <libudev.h>
#include <poll.h>
#include <thread>
#include <tuple>
#include <unistd.h>

namespace starbow {
namespace {

std::int64_t now_ns()
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string plain(const wchar_t* text)
{
    std::string out;
    for (; text && *text; ++text)
        if (*text >= 32 && *text < 127) // names go into messages and file names, so plain ASCII
            out += char(*text);
    return out;
}

/// Reads the descriptor from sysfs, which every user may read; hidapi 0.13 does not provide it.
std::vector<std::uint8_t> descriptor_bytes(const std::string& path)
{
    const std::string node = path.substr(path.rfind('/') + 1);
    std::ifstream stream("/sys/class/hidraw/" + node + "/device/report_descriptor", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::pair<DeviceInfo, Profile> identify(
    const hid_device_info& found, const Descriptor& descriptor, const std::vector<Profile>& profiles)
{
    DeviceInfo info{found.path, plain(found.product_string), plain(found.serial_number), found.vendor_id, found.product_id};
    Profile profile = profile_for(profiles, info, descriptor);
    if (info.name.empty()) // not every device has a name
        info.name = profile.file.empty() ? "device" : profile.name;
    return {std::move(info), std::move(profile)};
}

} // namespace

/// The time that distinguishes a burst of impossible reports from a press: eight reports of a device that sends as fast as
/// most can. It is half a frame at 60 Hz, and delays no axis.
constexpr std::int64_t sure_after_ns = 8'000'000;

/// The state that the reading thread and the visitor's frame share.
struct Hid::Device {
    DeviceInfo info;
    Descriptor descriptor;
    Profile profile;
    int opening = 0; ///< number of the opening: the same path may become another device
    std::atomic<bool> gone = false;
    mutable std::mutex mutex;
    DeviceState state;
    std::thread reader;
};

struct Hid::Shared {
    std::vector<Profile> profiles;
    LogTo log;
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> unplugged = 0; ///< since the start
    mutable std::mutex mutex;
    std::vector<std::shared_ptr<Device>> devices;
    std::vector<DeviceInfo> missing;
    int openings = 0;
    std::vector<std::string> refused; ///< paths that could not be opened, reported once
    std::thread observer;

    void read(const std::shared_ptr<Device>& device, hid_device* handle);
    void look();
    void watch();
    void open(const hid_device_info& found);
};

/// Reads until the device is unplugged or the program ends. Every report is taken: the last value of an axis counts, and
/// each press of a button.
void Hid::Shared::read(const std::shared_ptr<Device>& device, hid_device* handle)
{
    std::array<unsigned char, 4096> report;
    while (!stop) {
        const int size = hid_read_timeout(handle, report.data(), report.size(), 50);
        if (size < 0)
            break;
        if (size == 0)
            continue;
        const std::int64_t now = now_ns();
        const std::lock_guard lock(device->mutex);
        take_report(device->descriptor, std::span(report.data(), std::size_t(size)), now, device->state);
    }
    hid_close(handle);
    if (stop)
        return;
    device->gone = true;
    ++unplugged;
    try {
        log(LogKind::device_unplugged, describe(device->info) + " is unplugged");
        const std::lock_guard lock(mutex);
        missing.push_back(device->info);
    } catch (const std::bad_alloc&) { // it is forgotten without a word
    }
}

void Hid::Shared::open(const hid_device_info& found)
{
    const std::string path = found.path;
    const Descriptor descriptor = parse_descriptor(descriptor_bytes(path));
    if (!is_controller(descriptor))
        return;
    auto device = std::make_shared<Device>();
    device->descriptor = descriptor;
    std::tie(device->info, device->profile) = identify(found, descriptor, profiles);
    device->state.raw.resize(descriptor.fields.size());
    hid_device* handle = hid_open_path(path.c_str());
    if (!handle) {
        const int why = access(path.c_str(), R_OK | W_OK) == 0 ? 0 : errno;
        if (std::find(refused.begin(), refused.end(), path) == refused.end()) {
            refused.push_back(path);
            log(LogKind::device_unreadable,
                describe(device->info) + " at " + path
                    + (why == EACCES ? " can't be read by this user: copy config/udev/70-starbow.rules to /etc/udev/rules.d "
                                       "and plug it in again"
                                     : " can't be opened"));
        }
        return;
    }
    std::erase(refused, path);
    const std::lock_guard lock(mutex);
    device->opening = ++openings;
    const auto back = std::find_if(missing.begin(), missing.end(), [&](const DeviceInfo& info) {
        return info.vendor == device->info.vendor && info.product == device->info.product
            && info.serial == device->info.serial;
    });
    if (back != missing.end())
        missing.erase(back);
    devices.reserve(devices.size() + 1); // from the thread's start on, nothing may throw until the list has it
    try {
        device->reader = std::thread([this, device, handle] { read(device, handle); });
    } catch (...) {
        hid_close(handle);
        throw;
    }
    devices.push_back(device);
    log(LogKind::device_plugged,
        describe(device->info) + " is plugged in at " + path + ", flown by "
            + (device->profile.file.empty() ? device->profile.name : "the profile " + device->profile.name));
}

/// Opens new devices; forgets missing ones.
void Hid::Shared::look()
{
    std::vector<std::shared_ptr<Device>> ended;
    {
        const std::lock_guard lock(mutex);
        for (const auto& device : devices)
            if (device->gone)
                ended.push_back(device);
        std::erase_if(devices, [](const auto& device) { return device->gone.load(); });
    }
    for (const auto& device : ended)
        device->reader.join();
    hid_device_info* all = hid_enumerate(0, 0);
    std::vector<std::string> paths; // a device with several collections is listed once for each
    for (const hid_device_info* found = all; found; found = found->next) {
        const std::string path = found->path;
        if (std::find(paths.begin(), paths.end(), path) != paths.end())
            continue;
        paths.push_back(path);
        bool known = false;
        {
            const std::lock_guard lock(mutex);
            known = std::any_of(devices.begin(), devices.end(), [&](const auto& d) { return d->info.path == path; });
        }
        if (!known)
            open(*found);
    }
    std::erase_if(
        refused, [&](const std::string& path) { return std::find(paths.begin(), paths.end(), path) == paths.end(); });
    hid_free_enumeration(all);
}

void Hid::Shared::watch()
{
    udev* context = udev_new();
    udev_monitor* monitor = context ? udev_monitor_new_from_netlink(context, "udev") : nullptr;
    if (monitor) {
        udev_monitor_filter_add_match_subsystem_devtype(monitor, "hidraw", nullptr);
        udev_monitor_enable_receiving(monitor);
    }
    const auto look_again = [this] {
        try {
            look();
        } catch (const std::exception&) { // no memory, or no thread for a device: the next event is the next attempt
        }
    };
    look_again();
    while (!stop) {
        pollfd wait{monitor ? udev_monitor_get_fd(monitor) : -1, POLLIN, 0};
        const int events = poll(&wait, 1, 100);
        if (events > 0)
            while (udev_device* event = udev_monitor_receive_device(monitor))
                udev_device_unref(event);
        bool gone = false;
        {
            const std::lock_guard lock(mutex);
            gone = std::any_of(devices.begin(), devices.end(), [](const auto& d) { return d->gone.load(); });
        }
        if (events > 0 || gone)
            look_again();
    }
    if (monitor)
        udev_monitor_unref(monitor);
    if (context)
        udev_unref(context);
}

std::vector<ControllerListing> list_controllers(const std::vector<Profile>& profiles)
{
    std::vector<ControllerListing> list;
    hid_init();
    hid_device_info* all = hid_enumerate(0, 0);
    for (const hid_device_info* found = all; found; found = found->next) {
        const std::string path = found->path;
        const Descriptor descriptor = parse_descriptor(descriptor_bytes(path));
        if (!is_controller(descriptor)
            || std::any_of(list.begin(), list.end(), [&](const ControllerListing& one) { return one.info.path == path; }))
            continue;
        auto [info, profile] = identify(*found, descriptor, profiles);
        const int node = open(path.c_str(), O_RDWR | O_CLOEXEC); // as hidapi opens it
        const int error = node < 0 ? errno : 0;
        if (node >= 0)
            close(node);
        list.push_back({std::move(info), profile.name, error});
    }
    hid_free_enumeration(all);
    hid_exit();
    return list;
}

std::string describe(const DeviceInfo& info)
{
    return info.name + " (" + hex4(info.vendor) + ":" + hex4(info.product) + ")";
}

bool is_controller(const Descriptor& descriptor)
{
    return std::any_of(descriptor.applications.begin(), descriptor.applications.end(), [](const Usage& usage) {
        return (usage.page == 1 && (usage.id == 4 || usage.id == 5 || usage.id == 8)) || usage.page == 2;
    });
}

Profile profile_for(const std::vector<Profile>& profiles, const DeviceInfo& info, const Descriptor& descriptor)
{
    const Profile* best = nullptr;
    for (const Profile& profile : profiles)
        if (profile.vendor == info.vendor && profile.product == info.product
            && (profile.serial.empty() || profile.serial == info.serial)
            && (!best || best->serial.empty() || !profile.serial.empty()))
            best = &profile;
    return best ? *best : usual_profile(descriptor);
}

Hid::Hid(std::vector<Profile> profiles, LogTo log)
    : shared_(std::make_shared<Shared>())
{
    shared_->profiles = std::move(profiles);
    shared_->log = std::move(log);
    hid_init();
    shared_->observer = std::thread([shared = shared_] { shared->watch(); });
}

Hid::~Hid()
{
    shared_->stop = true;
    shared_->observer.join();
    for (const auto& device : shared_->devices)
        device->reader.join();
    hid_exit();
}

void Hid::add(double dt_s, Controls& controls)
{
    std::vector<std::shared_ptr<Device>> devices;
    {
        const std::lock_guard lock(shared_->mutex);
        devices = shared_->devices;
    }
    std::map<std::string, std::unique_ptr<Mapping>> kept;
    std::vector<Lever> levers;
    std::vector<std::string> troubles;
    const std::int64_t now = now_ns();
    for (const auto& device : devices) {
        if (device->gone)
            continue;
        const std::string key = device->info.path + " " + std::to_string(device->opening);
        auto& mapping = kept[key] = std::move(mappings_[key]);
        if (!mapping)
            mapping = std::make_unique<Mapping>(
                device->descriptor, left_handed_ ? starbow::left_handed(device->profile) : device->profile);
        DeviceState state;
        {
            const std::lock_guard lock(device->mutex);
            state = known_since(device->state, came_ns_);
            // A burst shows within a few milliseconds that it is one: the newest presses wait for the next frame.
            auto& later = now - state.pressed_ns < sure_after_ns ? state.presses : device->state.presses;
            later.assign(later.size(), {});
        }
        const Rates others = take_rates(controls);
        mapping->add(state, now, dt_s, controls);
        add_rates(controls, others, dt_s);
        for (Lever lever : mapping->levers()) {
            lever.device = describe(device->info) + device->info.serial;
            levers.push_back(std::move(lever));
        }
        for (const std::string& trouble : mapping->troubles())
            troubles.push_back(device->info.name + ": " + trouble);
        if (state.report_ns > 0)
            controls.report_ns = std::max(controls.report_ns, state.report_ns);
    }
    mappings_ = std::move(kept);
    if (const auto place = lever_.place(levers, now))
        controls.lever = place;
    report_troubles(std::move(troubles));
}

void Hid::left_handed(bool is)
{
    if (left_handed_ != is)
        mappings_.clear(); // a press that waits is lost: it belonged to the other hand
    left_handed_ = is;
}

void Hid::forget()
{
    came_ns_ = now_ns();
    mappings_.clear(); // a press that waits was the other hands'
}

void Hid::report_troubles(std::vector<std::string> troubles)
{
    const auto holds
        = [](const auto& all, const std::string& one) { return std::find(all.begin(), all.end(), one) != all.end(); };
    for (const std::string& trouble : troubles)
        if (!holds(troubles_, trouble))
            shared_->log(LogKind::device_trouble, trouble);
    for (const std::string& trouble : troubles_)
        if (!holds(troubles, trouble))
            shared_->log(LogKind::device_well, "no longer: " + trouble);
    troubles_ = std::move(troubles);
}

std::size_t Hid::unplugged() const { return shared_->unplugged; }

std::string Hid::trouble() const
{
    const std::lock_guard lock(shared_->mutex);
    std::string line;
    for (const DeviceInfo& info : shared_->missing)
        line += (line.empty() ? "" : ", ") + info.name;
    if (!line.empty())
        return line + (shared_->missing.size() > 1 ? " are unplugged" : " is unplugged");
    return troubles_.empty() ? "" : troubles_.front();
}

InputCapabilities Hid::capabilities() const
{
    InputCapabilities all{.left_handed = left_handed_};
    for (const auto& [key, mapping] : mappings_) {
        const InputCapabilities own = mapping->capabilities();
        all.stick |= own.stick, all.lever |= own.lever, all.trigger |= own.trigger;
        if (own.stick && own.stop_button > 0) { // the buttons of the stick in the hand
            all.stop_button = own.stop_button;
            all.home_button = own.home_button, all.undo_button = own.undo_button;
        }
    }
    return all;
}

std::vector<UsbId> Hid::kinds() const
{
    const std::lock_guard lock(shared_->mutex);
    std::vector<UsbId> kinds;
    for (const auto& device : shared_->devices)
        if (!device->gone)
            kinds.push_back({device->info.vendor, device->info.product});
    return kinds;
}

std::vector<Hid::Connected> Hid::devices() const
{
    const std::lock_guard lock(shared_->mutex);
    std::vector<Connected> all;
    for (const auto& device : shared_->devices)
        if (!device->gone) {
            const std::lock_guard own(device->mutex);
            all.push_back({device->info, device->profile.name, device->descriptor, device->state});
        }
    return all;
}

} // namespace starbow
