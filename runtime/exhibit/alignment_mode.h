#pragma once
#include "config/model/adjust.h"
#include "input/controls.h"
#include "runtime/render/frame_renderer.h"
#include <chrono>

namespace starbow {

/// The builder's keys in a running exhibit: test patterns, and changes of the layout's numbers.
class AlignmentMode {
public:
    using Clock = std::chrono::steady_clock;
    explicit AlignmentMode(Pattern pattern = Pattern::none)
        : first_(pattern)
        , pattern_(pattern)
    {
    }

    /// Applies the builder's keys to `layout`; returns true if it has changed. The save key writes into layout.file; says()
    /// reports failures. The way back to the start shows the first pattern again: a visitor's F2 must not outlast the visit.
    bool apply(const Controls& controls, Layout& layout);

    Pattern pattern() const { return pattern_; }
    /// A line for the head-up display for some seconds after a key; otherwise empty.
    const std::string& says() const { return Clock::now() < until_ ? says_ : silent_; }

    void say(std::string line);
    void show(Pattern pattern) { pattern_ = pattern; }
    void show_first() { pattern_ = first_; }

private:
    void save(const Layout& layout);

    Pattern first_, pattern_;
    std::size_t chosen_ = 0;
    bool choosing_ = false;
    std::string says_, silent_;
    Clock::time_point until_{};
};

} // namespace starbow
