#pragma once
#include "device.h"
#include <optional>

namespace starbow {

/// How long the device takes for what is recorded between begin() and end(): of one frame at a time.
class FrameTimer {
public:
    explicit FrameTimer(const Device& device);
    void begin(vk::CommandBuffer commands);
    void end(vk::CommandBuffer commands);
    /// Milliseconds of the last one, which the device must have finished; nothing before the first, or where it has no
    /// clock.
    std::optional<double> ms() const;

private:
    vk::raii::QueryPool stamps_ = nullptr; ///< null where the device has no clock
    double ms_per_tick_ = 0;
    std::uint64_t mask_ = 0;
    bool told_ = false;
};

} // namespace starbow
