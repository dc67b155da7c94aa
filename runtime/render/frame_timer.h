#pragma once
#include "device.h"
#include <optional>
#include <span>

namespace starbow {

/// One pass of a frame, in the device's time.
struct PassTime {
    const char* name;
    double begin_ms, duration_ms; ///< begin: since the frame's begin
};

/// Measures how long the device takes for one frame at a time, and for the passes in it. A frame may be in two parts,
/// between which the device waits for the screens: that wait is no cost of the frame.
class FrameTimer {
public:
    explicit FrameTimer(const Device& device);

    /// These two enclose all commands of a frame.
    void begin(vk::CommandBuffer commands);
    void end(vk::CommandBuffer commands);
    /// The end of a frame's first part, and the beginning of its second one. Its commands wait as a whole.
    void pause(vk::CommandBuffer commands);
    void resume(vk::CommandBuffer commands);
    /// These two enclose one pass, between begin and end; passes may nest. Spans beyond most_spans are not measured.
    /// name: a string that outlives this object.
    void begin_span(vk::CommandBuffer commands, const char* name);
    void end_span(vk::CommandBuffer commands);

    /// Milliseconds of the last frame without the wait between its parts; nothing before the first frame or without a device
    /// clock. The device must have finished it.
    std::optional<double> ms() const;
    /// The passes of the last frame, in the order of their beginnings; empty where ms() is nothing.
    std::span<const PassTime> passes();

private:
    static constexpr std::uint32_t most_spans = 255;
    /// The queries: the frame's, then two for each span.
    enum Stamp : std::uint32_t { begun, paused, resumed, ended, first_span };

    vk::raii::QueryPool stamps_ = nullptr; ///< null without a device clock
    bool in_parts_ = false; ///< the frame has been resumed
    double ms_per_tick_ = 0;
    std::uint64_t mask_ = 0;
    bool measured_ = false;
    std::vector<const char*> names_;
    std::vector<std::uint32_t> open_; ///< spans that have begun
    std::vector<PassTime> passes_;
};

/// Adds a frame's passes to a trace. The device's clock has a zero of its own: its frame is drawn from the time of its
/// submission on, Trace::now_ns().
void add_passes(Trace& trace, std::span<const PassTime> passes, std::int64_t submitted_ns);

/// Submits a frame's two parts: `world` at once, `outputs` after it and after all of `wait`. `signal` and `done` are
/// signalled after both.
void submit_frame(const Device& device, vk::CommandBuffer world, vk::CommandBuffer outputs,
    std::span<const vk::SemaphoreSubmitInfo> wait, std::span<const vk::SemaphoreSubmitInfo> signal, vk::Fence done);

} // namespace starbow
