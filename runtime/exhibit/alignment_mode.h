#pragma once
#include "config/model/adjust.h"
#include "input/command.h"
#include "input/controls.h"
#include "runtime/render/frame_renderer.h"
#include <chrono>

namespace starbow {

/// The builder's keys and tablet in a running exhibit: test patterns, and changes of the layout's numbers.
class AlignmentMode {
public:
    using Clock = std::chrono::steady_clock;
    explicit AlignmentMode(Pattern pattern = Pattern::none)
        : first_(pattern)
        , pattern_(pattern)
    {
    }

    /// Applies the builder's keys and the queued commands to `layout`; returns true if it has changed. kept: the
    /// layout by its file. The save key writes into layout.file; says() reports failures. The way back to the start shows
    /// the first pattern again: a visitor's F2 must not outlast the visit.
    bool apply(const Controls& controls, Layout& layout, const Layout& kept);

    /// Queues a command that moves the layout's numbers for the next apply(). Returns false for any other. Throws InputError
    /// for a grip that the layout has not.
    bool queue(const Command& command, const Layout& layout);
    /// The chosen grip and its numbers, for people; empty: none is chosen yet.
    const std::string& grip() const { return grip_; }
    const std::string& grip_says() const { return grip_says_; }
    /// The direction in the cockpit of the handle that is moved, while says() speaks of it.
    std::optional<glm::dvec3> handle() const { return Clock::now() < until_ ? handle_ : std::nullopt; }
    bool as_saved() const { return moved_.has_value(); }
    /// Another file's layout is shown: no move is taken back, and no grip is chosen.
    void reset_moves();

    Pattern pattern() const { return pattern_; }
    /// A line for the head-up display for some seconds after a key; otherwise empty.
    const std::string& says() const { return Clock::now() < until_ ? says_ : silent_; }

    void say(std::string line);
    /// Rejects the change of the last apply(): the layout stays as it was. why: the error's one line. Returns the message
    /// for people, without the layout's place.
    std::string refuse(const std::string& why);
    void show(Pattern pattern) { pattern_ = pattern; }
    void show_first() { pattern_ = first_; }

private:
    void save(const Layout& layout);
    void choose_grip(const Layout& layout, const Grip& grip);
    bool show_moved(Layout& layout);
    bool turn_by_keys(const Controls& controls, Layout& layout);
    bool apply_command(const Command& command, Layout& layout, const Layout& kept);

    Pattern first_, pattern_;
    std::size_t chosen_ = 0;
    bool choosing_ = false;
    std::string grip_, grip_says_;
    std::optional<glm::dvec3> handle_;
    std::vector<Command> queued_;
    std::optional<Layout> moved_; ///< the builder's, while the file's is shown
    struct Move {
        Layout before, after;
    };
    std::vector<Move> moves_; ///< the last one last
    std::size_t moves_before_ = 0; ///< their number before the last apply()
    std::string says_, silent_;
    Clock::time_point until_{};
};

} // namespace starbow
