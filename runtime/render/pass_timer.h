#pragma once
#include "command_counts.h"
#include "frame_timer.h"
#include "invocations.h"
#include "offscreen.h"
#include <chrono>

namespace starbow {

/// The time that work takes, ms.
template <class Work> double milliseconds(Work&& work)
{
    const auto began = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
}

/// Makes a target ready to be drawn into once more; its old content is lost.
void make_writable(vk::CommandBuffer commands, const Target& target);

/// A frame that is drawn as an exhibit draws it.
struct TimedFrame {
    std::int64_t begin_ns = 0, submit_ns = 0, end_ns = 0; ///< Trace::now_ns(); end: the device has finished
    double device_ms = 0; ///< by the device's clock; 0: it has none
    std::vector<PassTime> passes; ///< by the device's clock, in the order of their beginnings; passes may nest

    double whole_ms() const { return double(end_ns - begin_ns) * 1e-6; }
    double processor_ms() const { return double(submit_ns - begin_ns) * 1e-6; } ///< planning, culling, recording
};

/// Times the passes of one offscreen renderer, each alone: from the start of its recording until the device has finished
/// it, in milliseconds. A pass reads the results of the passes before it, as in a frame: call update() first, then cubes().
class PassTimer {
public:
    PassTimer(Device& device, OffscreenRenderer& renderer);

    /// The whole frame of all outputs, with update() and the reading of the meter. hud: the panel, or null.
    double frame(const Shot& shot, const Panel* hud = nullptr);
    /// The processor's part: observers, plan, culling, upload.
    double update(const Shot& shot, const Panel* hud = nullptr);
    /// recording_ms: gets the part of the time in which the processor records.
    double cubes(double* recording_ms = nullptr);
    double stars(); ///< of the first output
    double warp(); ///< of all outputs
    double hud(); ///< of the first output
    double finish(); ///< of all outputs
    double metering();

    /// A whole frame with the time of each of its passes on the device.
    TimedFrame timed(const Shot& shot, const Panel* hud = nullptr);
    /// The calls of the whole frame, submitted as an exhibit's; count_commands() comes before it.
    CommandCounts counts(const Shot& shot, const Panel* hud = nullptr);
    /// How often the whole frame's shaders run; for a device that was opened with Options::invocations.
    std::vector<DrawInvocations> invocations(const Shot& shot, const Panel* hud = nullptr);

    /// The time that the processor and then the device are busy with so many frames in one submission, without the wait for
    /// either.
    double busy(const Shot& shot, int frames);

private:
    template <class Record> double each_output(Record&& record);
    void draw(vk::CommandBuffer world, vk::CommandBuffer outputs, const Shot& shot, const Panel* hud);
    /// Draws a frame in two parts, as an exhibit does, and waits for it. timer: measures it, or null. Returns the time of
    /// its submission, Trace::now_ns().
    std::int64_t exhibit_frame(const Shot& shot, const Panel* hud, FrameTimer* timer);

    Device& device_;
    FrameRenderer& frame_;
    std::vector<Target> targets_;
};

} // namespace starbow
