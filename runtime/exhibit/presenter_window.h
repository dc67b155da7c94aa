#pragma once
#include "outputs.h"
#include "presenter.h"
#include "runtime/render/resources.h"

namespace starbow {

/// The guide's window on one device. No frame of the visitors waits for it: a picture that is not painted, or whose image
/// the window system holds, is left out.
class PresenterWindow {
public:
    PresenterWindow(Device& device, Presenter& presenter, const std::optional<Presenting>& rules);
    ~PresenterWindow();
    PresenterWindow(const PresenterWindow&) = delete;

    /// Opens the window where its monitor is there, and shows a new picture where one is due. Call it once a frame, after
    /// the visitors' pictures are handed over. Throws vk::DeviceLostError.
    void show(const Session& session, const std::vector<Monitor>& monitors);

private:
    using Clock = std::chrono::steady_clock;
    void settle_on_monitor(const std::vector<Monitor>& monitors);
    void open(const std::optional<WindowPlace>& place);
    void listen();
    void close(const std::string& why);
    void copy(const PresenterPicture& picture);

    Device& device_;
    Presenter& presenter_;
    Output output_; ///< as a layout would describe the window
    std::optional<Window> window_;
    std::string logged_reason_; ///< the logged reason for the missing window
    Clock::time_point looked_{};
    bool swallows_ = false; ///< the character of the key that has opened the caption
    vk::raii::Fence done_;
    vk::raii::CommandBuffers commands_;
    Buffer texels_;
};

} // namespace starbow
