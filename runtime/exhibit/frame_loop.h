#pragma once
#include "hud_updater.h"
#include "runtime/render/frame_timer.h"
#include "runtime/render/render_context.h"
#include "screens.h"
#include "session.h"

namespace starbow {

/// Starts each frame at its turn, since some drivers' FIFO does not wait for the screen. The turn is a hundredth shorter
/// than the screen's: where the driver does wait, it alone does.
struct Pace {
    using Clock = std::chrono::steady_clock;
    Clock::time_point next = Clock::now();
    void wait(double refresh_hz);
};

/// Flies a session on one device, frame after frame, until the visitor leaves. Everything in it goes with the device.
class FrameLoop {
public:
    FrameLoop(Session& session, RenderContext& context);
    ~FrameLoop(); ///< waits until the device has nothing to do

    /// One frame from the controls to the screens; frame_loop.cpp tells it in order. Returns whether to go on. Throws
    /// vk::DeviceLostError.
    bool fly_frame();

private:
    /// Draws, unseen, everything that the visitor's switches can need; progress on a terminal.
    void warm_up();
    /// Waits for the frame's turn and for the device. Returns the exposure for the frame before, if it was metered.
    std::optional<double> await_device();
    /// Applies a change of the layout's files: all of it or, where anything in it is wrong, nothing. The old picture stays
    /// until the new one can be drawn.
    void apply_file_changes();
    /// Applies a builder's change by keyboard, or undoes it if it can't be drawn.
    void apply_alignment(const Controls& controls);
    /// The shot that the session has come to, and everything about it that the frame renderer needs to know.
    Shot set_up_frame(const Controls& controls);
    /// Enclose what FrameRenderer::draw records: the timer and the layouts of the windows' pictures.
    void begin_commands();
    void end_commands();
    /// The device's passes of the frame before, for the trace.
    void trace_passes();

    Session& session_;
    RenderContext& context_;
    Device& device_;
    std::unique_ptr<FrameRenderer> frame_;
    FrameTimer timer_;
    Screens screens_;
    bool cold_; ///< the warm-up is still to come
    HudUpdater hud_;
    Pace pace_;
    vk::raii::Fence done_;
    vk::raii::CommandBuffer commands_;
    double prepared_ms_ = 0; ///< the processor's part of the frame before
    std::int64_t submitted_ns_ = 0; ///< steady clock; of the frame before
};

} // namespace starbow
