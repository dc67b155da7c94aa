#pragma once
#include "command_counts.h"
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

    Device& device_;
    FrameRenderer& frame_;
    std::vector<Target> targets_;
};

} // namespace starbow
