#pragma once
#include "callouts.h"
#include "hud_updater.h"
#include "master.h"
#include "picture_setup.h"
#include "presenter_window.h"
#include "remote_control.h"
#include "runtime/render/command_counts.h"
#include "runtime/render/frame_timer.h"
#include "runtime/render/live_copy.h"
#include "runtime/render/render_context.h"
#include "runtime/render/warm_up.h"
#include "screens.h"
#include "session.h"
#include "world_loader.h"

namespace starbow {

/// Starts frames at the screen's rate, because some drivers' FIFO does not wait for the screen. The period is a hundredth
/// shorter than the screen's: where the driver does wait, its wait alone counts.
struct FramePace {
    using Clock = std::chrono::steady_clock;
    Clock::time_point next = Clock::now();
    void wait(double refresh_hz);
};

/// Flies a session on one device, frame after frame, until the visitor leaves. All its members are lost with the device.
class FrameLoop {
public:
    FrameLoop(Session& session, RemoteControl& remote, Presenter& presenter, RenderContext& context);
    ~FrameLoop(); ///< waits until the device has nothing to do

    /// One frame from the controls to the screens; frame_loop.cpp lists its steps in order. Returns false at the end of
    /// the flight. Throws vk::DeviceLostError.
    bool fly_frame();

private:
    using Clock = std::chrono::steady_clock;
    /// Waits a moment while no window has an image.
    void stand_by();
    /// Draws off-screen all states of the visitor's switches; shows the progress on a terminal.
    void warm_up();
    /// One step of the same while nobody sees that a frame comes late.
    void warm_up_at_rest(const Shot& shot);
    /// Null where a viewport is too narrow for an inset. Throws NoRoom.
    std::unique_ptr<WarmUp> warm_up_in(const Quality& quality);
    /// Another world, layout or quality: the warm-up at rest and the callouts begin anew.
    void forget_drawn() { at_rest_.reset(), rested_ = false, callouts_.forget(), pictures_.forget(); }
    void fit(std::size_t output);
    /// Waits for the frame's turn and for the device. Returns the luminance of the frame before, if it was metered.
    Metered await_device();
    /// Hands the small copy of the previous frame to the guide's window and to the remote, as each has requested it.
    void publish_view();
    /// Has a changed layout loaded beside, and applies one that is ready. If any file is wrong, nothing changes: the old
    /// picture stays until the new one can be drawn.
    void apply_file_changes();
    void apply(LayoutLoader::Loaded loaded);
    /// Makes touches of the live picture into the directions that it shows there. So a record does not depend on the layout.
    void aim_pointer(std::vector<Command>& commands) const;
    /// Adds what a programme's item shows as a command of its own, last. So a replay needs no programme.
    void add_items_content(std::vector<Command>& commands) const;
    /// Advances the visitors' menu; its choice is a command of this frame.
    void choose_in_menu(RecordEntry& entry, Requests& requests);
    /// Takes those of the frame's commands out that lead to another world, until it is read, and brings them back then. So a
    /// record has a command in the frame in which it is carried out.
    void await_worlds(std::vector<Command>& commands);
    /// Another state is wanted than the world that is being read.
    void forget_coming();
    /// visitors: false where nobody is there to fly.
    void show_content(SessionContent content, bool visitors = true);
    void show_attraction(std::size_t number);
    void record_visit();
    /// Follows the visit by the frame's signs of somebody, and carries out what it asks for. hands: this frame's.
    Requests attend(const Controls& hands, std::int64_t dt_ns);
    void change_visitors(const VisitEvents& events);
    void show_quality(const std::string& name);
    /// Carries out a remote's command; a refused one is logged with its reason and changes nothing.
    void apply_command(const Command& command, Requests& requests);
    /// Applies a builder's change by keyboard, or undoes it if it can't be drawn.
    void apply_alignment(const Controls& controls);
    /// Gives the outputs their windows' sizes.
    void fit_outputs();
    /// The session's present state as its pictures depend on it.
    PictureState next_picture_state(const Head& head);
    /// The same for the other machines.
    SharedState shared(const PictureState& now) const;
    /// Lets all machines show the frame, and keeps the names of those that are not in step.
    void release_frame();
    /// These two enclose FrameRenderer::draw with the timer and the layout transitions of the windows' images. The commands
    /// are in two buffers, of which only the second waits for the screens.
    void begin_commands();
    void end_commands();
    /// Adds the device's passes of the frame before to the trace.
    void trace_passes();
    /// Adds the counts of this frame's calls that differ from those of the frame before.
    void trace_calls(const CommandCounts& counts);
    void gather_lacks();
    /// Once a second: leaves a level of quality, or writes a line of the log, where the device's memory is used beyond its
    /// budget.
    void watch_memory();

    Session& session_;
    RemoteControl& remote_;
    Presenter& presenter_;
    RenderContext& context_;
    Device& device_;
    std::unique_ptr<FrameRenderer> frame_;
    FrameTimer timer_;
    Screens screens_;
    std::optional<Clock::time_point> held_since_; ///< the window system has held all images since
    std::optional<Clock::time_point> presented_; ///< the frame before
    bool fresh_ = true; ///< no frame is shown yet
    bool cold_; ///< the warm-up is still to come
    std::unique_ptr<WarmUp> at_rest_; ///< the warm-up that goes on while the ship rests; null before it and after it
    bool rested_ = false; ///< it is over, for the present world, layout and quality
    std::size_t most_pipelines_; ///< that are kept
    HudUpdater hud_;
    Callouts callouts_;
    PictureSetup pictures_;
    std::unique_ptr<Master> master_; ///< null: this machine shows all
    std::vector<TurnedNumber> turned_; ///< the builder's changes, for the other machines
    FramePace pace_;
    Clock::time_point memory_watched_{};
    bool memory_reported_ = false; ///< the use of memory beyond its budget, which goes on
    vk::raii::Fence done_;
    LiveCopy live_;
    std::size_t live_output_ = 0; ///< the copied one
    bool remotes_view_ = false, guides_view_ = false; ///< the recorded copy is for the remote, for the guide's window
    WorldLoader worlds_;
    std::optional<Command> coming_; ///< waits for its world
    vk::raii::CommandBuffers commands_; ///< the world's, the outputs'
    bool submitted_ = false; ///< a frame since the last wait for the device
    double prepared_ms_ = 0; ///< the processor's part of the frame before
    std::int64_t submitted_ns_ = 0; ///< steady clock; of the frame before
    CommandCounts traced_{}; ///< as they stand in the trace
    PresenterWindow presenter_window_;
};

} // namespace starbow
