#pragma once
#include "config/model/adjust.h"
#include "input/controls.h"
#include "runtime/render/frame_renderer.h"
#include <chrono>

namespace starbow {

/// What a builder does to a running exhibit from the keyboard: test patterns, and the layout's numbers turned and kept.
class AlignmentMode {
public:
    using Clock = std::chrono::steady_clock;
    explicit AlignmentMode(Pattern pattern = Pattern::none)
        : pattern_(pattern)
    {
    }

    /// True where the layout has changed. Keeping writes into layout.file; what can't be kept is told in says().
    bool apply(const Controls& controls, Layout& layout);

    Pattern pattern() const { return pattern_; }
    /// One line for the head-up display, some seconds after a key; else empty.
    const std::string& says() const { return Clock::now() < until_ ? says_ : silent_; }

    void say(std::string line);

private:
    void save(const Layout& layout);

    Pattern pattern_;
    std::size_t chosen_ = 0;
    bool choosing_ = false;
    std::string says_, silent_;
    Clock::time_point until_{};
};

} // namespace starbow
