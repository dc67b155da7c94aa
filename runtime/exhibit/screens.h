#pragma once
#include "desktop.h"
#include "outputs.h"
#include "runtime/operation/skew.h"

namespace starbow {

/// The windows of a layout, each on the monitor that its output names. An output whose monitor is missing has no window, and
/// gets it when the monitor is there: never is a picture on another screen. What comes and goes is told on stderr.
class Screens {
public:
    /// Throws InputError where a window can't be opened; a missing monitor is only told.
    Screens(Device& device, const Layout& layout);

    /// Takes up a changed layout: windows whose output keeps its name, size and place stay open.
    void adopt(const Layout& layout);

    /// Opens, moves and closes windows as monitors come, change and go. To be called before each frame: costs nothing where
    /// nothing has changed.
    void follow();

    /// The next pictures to draw into, one for each output; those without a view are not drawn: no monitor, minimised,
    /// changing. False if there is none at all.
    bool acquire();
    const std::vector<Target>& targets() const { return targets_; }
    /// The format of the windows' pictures; undefined where no window has one yet.
    vk::Format format() const;

    /// Hands the device the commands that draw the acquired pictures; `done` is signalled after them. Throws
    /// vk::DeviceLostError.
    void submit(vk::CommandBuffer commands, vk::Fence done);
    /// Shows them all, together. Throws vk::DeviceLostError. Adds to `skew` where there are several: the skew of this frame,
    /// or of an earlier one of which the driver has told by now when its pictures were seen.
    void present(Skew& skew);

    const std::vector<GLFWwindow*>& handles() const { return handles_; } ///< of the windows that are open
    bool closed() const; ///< by the visitor
    void switch_full_screen();
    /// Of the fastest monitor that shows something.
    double refresh_hz() const;

private:
    using Clock = std::chrono::steady_clock;
    struct Screen {
        Output output;
        std::optional<Window> window;
        std::optional<WindowPlace> place;
        std::string told; ///< why there is no window, as it was told
    };

    void settle_on_monitors(bool starting);
    void open(Screen& screen, const std::optional<WindowPlace>& place, bool starting);
    void close(Screen& screen, const std::string& why);
    void list_handles();
    void time_on_screen(Skew& skew);

    Device& device_;
    Desktop desktop_;
    std::vector<Screen> screens_;
    std::vector<GLFWwindow*> handles_;
    std::vector<Target> targets_;
    std::vector<Window*> acquired_; ///< windows with a picture of this frame
    vk::Fence done_; ///< of the frame's commands
    std::uint64_t frame_ = 0; ///< counted for the driver
    std::vector<PresentClock*> asked_; ///< about one frame's pictures
    Clock::time_point looked_{};
};

} // namespace starbow
