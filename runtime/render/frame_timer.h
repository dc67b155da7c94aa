#pragma once
#include "device.h"
#include <optional>
#include <span>

namespace starbow {

/// A pass of a frame in the device's own time.
struct PassTime {
    const char* name;
    double begin_ms, duration_ms; ///< begin: since the frame's own
};

/// Measures how long the device takes for one frame at a time, and for the passes in it.
class FrameTimer {
public:
    explicit FrameTimer(const Device& device);

    /// Enclose all that a frame records.
    void begin(vk::CommandBuffer commands);
    void end(vk::CommandBuffer commands);
    /// Enclose one pass, between begin and end; passes may nest. Beyond most_spans they are not measured. name must live.
    void begin_span(vk::CommandBuffer commands, const char* name);
    void end_span(vk::CommandBuffer commands);

    /// Milliseconds of the last frame, which the device must have finished; nothing before the first, or where the device
    /// has no clock.
    std::optional<double> ms() const;
    /// The passes of the last frame, in the order of their beginnings; empty where ms() is nothing.
    std::span<const PassTime> passes();

private:
    static constexpr std::uint32_t most_spans = 255;

    vk::raii::QueryPool stamps_ = nullptr; ///< null where the device has no clock; 0, 1: the frame's, then two a span
    double ms_per_tick_ = 0;
    std::uint64_t mask_ = 0;
    bool measured_ = false;
    std::vector<const char*> names_;
    std::vector<std::uint32_t> open_; ///< spans that have begun
    std::vector<PassTime> passes_;
};

} // namespace starbow
