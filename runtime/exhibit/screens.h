#pragma once
#include "desktop.h"
#include "outputs.h"
#include "runtime/operation/skew.h"

namespace starbow {

/// The windows of a layout, each on the monitor that its output names. An output whose monitor is missing has no window
/// until the monitor appears; no picture ever goes to another screen. Windows that open and close are logged.
class Screens {
public:
    /// node: whose outputs have windows here; empty: all have. Throws InputError where a window can't be opened; a missing
    /// monitor is only logged.
    Screens(Device& device, const Layout& layout, std::string node = "");

    /// Applies a changed layout. A window stays open if its output keeps its name, size and place.
    void adopt(const Layout& layout);

    /// Opens, moves and closes windows as monitors come, change and go. Call it before each frame; without changes it
    /// takes no time.
    void follow();

    /// Acquires one image for each output. Targets without a view are not drawn: their monitor is missing, or the window
    /// is minimised or changing. Returns false if there is no image at all.
    bool acquire();
    const std::vector<Target>& targets() const { return targets_; }
    /// The targets' sizes, pixels; zero for a target without a view.
    std::vector<glm::ivec2> sizes() const;
    /// Gives an output's window a smaller picture, which is scaled up. Throws InputError, as Window's.
    void draw_smaller(Pipelines& pipelines, std::size_t output, glm::ivec2 size);
    /// These two enclose the drawing of all targets.
    void begin_pictures(vk::CommandBuffer commands) const;
    void end_pictures(vk::CommandBuffer commands) const;
    std::size_t shown() const { return acquired_.size(); } ///< windows with an image of this frame
    std::size_t held() const; ///< windows whose images the window system does not give back
    /// The first target whose picture can be copied to the processor; none where the window system allows that of none.
    std::optional<std::size_t> readable() const;
    /// The format of the windows' images; undefined where no window has one yet.
    vk::Format format() const;

    /// Submits a frame: `world` at once, and `outputs`, which draws the acquired images, when the screens are ready for
    /// them. `done` is signalled after both. Throws vk::DeviceLostError.
    void submit(vk::CommandBuffer world, vk::CommandBuffer outputs, vk::Fence done);
    /// Presents all acquired images together. Throws vk::DeviceLostError. With several outputs it adds a skew to `skew`:
    /// this frame's, or an earlier frame's once the driver has reported when its images were on the screens.
    void present(Skew& skew);

    const std::vector<Monitor>& monitors() const { return desktop_.monitors(); }
    const std::vector<GLFWwindow*>& handles() const { return handles_; } ///< the open windows
    bool closed() const; ///< true if the visitor has closed a window
    void switch_full_screen();
    /// The refresh rate of the fastest monitor in use.
    double refresh_hz() const;
    /// True when all open windows' pictures change together, and with those of other machines.
    bool barrier() const;

private:
    using Clock = std::chrono::steady_clock;
    struct Screen {
        Output output;
        std::optional<Window> window;
        std::optional<WindowPlace> place;
        std::string logged_reason; ///< the logged reason for the missing window
    };

    void settle_on_monitors(bool starting);
    void open(Screen& screen, const std::optional<WindowPlace>& place, bool starting);
    void close(Screen& screen, const std::string& why);
    void list_handles();
    void time_on_screen(Skew& skew);

    bool is_here(const Screen& screen) const { return is_shown_by(node_, screen.output); }

    Device& device_;
    std::string node_;
    Desktop desktop_;
    std::vector<Screen> screens_;
    std::vector<GLFWwindow*> handles_;
    std::vector<Target> targets_;
    std::vector<Window*> acquired_; ///< windows with a picture of this frame
    vk::Fence done_; ///< signalled after the frame's commands
    std::uint64_t frame_ = 0; ///< the driver's present id
    std::vector<PresentClock*> clocks_; ///< clocks of one frame's images
    Clock::time_point looked_{};
};

} // namespace starbow
