#pragma once
#include "config/model/log_kinds.h"
#include "mapping.h"
#include "pad.h"
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace starbow {

/// A controller that is plugged in.
struct DeviceInfo {
    std::string path, name, serial; ///< path: "/dev/hidraw0"
    int vendor = 0, product = 0;
};

/// "Flight Stick (1234:abcd)"
std::string describe(const DeviceInfo& info);

/// A controller as the system lists it, read or not.
struct ControllerListing {
    DeviceInfo info;
    std::string profile; ///< name of the profile that would apply
    int error = 0; ///< errno of opening its node; 0: it can be opened
};
/// All controllers that are plugged in, opened for a moment each. Call it while no Hid lives.
std::vector<ControllerListing> list_controllers(const std::vector<Profile>& profiles);

/// True for the descriptor of a joystick, gamepad, space mouse or simulator's control; false for a mouse or a keyboard.
bool is_controller(const Descriptor& descriptor);

/// Reads all plugged-in sticks, throttles and pads, each on a thread of its own. No function here waits.
class Hid {
public:
    /// log: is called with a line for the log, from any thread.
    explicit Hid(std::vector<Profile> profiles, LogTo log);
    Hid(const Hid&) = delete;
    ~Hid();

    /// Adds the controls of all devices. An unplugged device adds none: its axes are neutral from then on.
    void add(double dt_s, Controls& controls);

    /// Sets the devices for a left-handed visitor, or for a right-handed one, from the next add() on.
    void left_handed(bool is);

    /// Other hands come: each device counts once it has reported again.
    void forget();

    /// A line for the visitors' display while a device is missing, or while a stuck or noisy axis is ignored; otherwise
    /// empty.
    std::string trouble() const;
    std::size_t unplugged() const; ///< number of devices that have gone since the start
    std::size_t ignored_axes() const { return troubles_.size(); } ///< stuck or noisy ones, as of the last add()
    /// The kinds of all devices that are read.
    std::vector<UsbId> kinds() const;
    /// The kinds of control of all devices together, as of the last add().
    InputCapabilities capabilities() const;

    struct Connected {
        DeviceInfo info;
        std::string profile; ///< its name
        Descriptor descriptor;
        DeviceState state;
    };
    std::vector<Connected> devices() const;

private:
    struct Device;
    struct Shared;
    std::shared_ptr<Shared> shared_;
    std::map<std::string, std::unique_ptr<Mapping>> mappings_; ///< by path and number of openings
    bool left_handed_ = false;
    std::int64_t came_ns_ = -1; ///< when these hands came
    LeverChoice lever_;
    std::vector<std::string> troubles_; ///< of axes, as last logged
    void report_troubles(std::vector<std::string> troubles);
};

/// A device's profile: by its serial number first, then by its kind; of several, the last. Otherwise it is made from the
/// descriptor's usages.
Profile profile_for(const std::vector<Profile>& profiles, const DeviceInfo& info, const Descriptor& descriptor);

} // namespace starbow
