#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace starbow {

/// Exit status after a wait that had no end: the graphics driver or the window system hangs.
constexpr int exit_hung = 4;

/// A wait with a limit, or work that may hang, for as long as the object lives. A wait inside another takes its place; the
/// outer one's time begins anew afterwards. Make it only on the thread that draws. WaitWatch compares it with its limit.
class LimitedWait {
public:
    /// what: names the wait in the log: "the end of the frame's drawing (fence)".
    explicit LimitedWait(std::string_view what) noexcept;
    /// Work that takes longer than a frame, as loading. Waits inside it may take four times as long as others.
    LimitedWait(std::string_view what, double limit_s) noexcept;
    ~LimitedWait();
    LimitedWait(const LimitedWait&) = delete;

    double limit_s() const { return limit_s_; }
    /// The work has come on: its time begins anew.
    void restart();

private:
    friend class WaitWatch;
    void begin(std::string_view what);
    std::string what_;
    double limit_s_;
    double waited_s_ = 0;
    bool long_; ///< waits inside it may take longer
};

/// Names the wait that had no end in the log, and ends the process with exit_hung, without destructors: they would wait for
/// the same device. A record and a log of readings are on the disk by then: their last lines are written within a second.
[[noreturn]] void give_up(const std::string& what, double waited_s);

/// The part of a wait's time that counts, s, where all threads of the process together computed for so long, and for so long
/// could have computed but got no processor. Neither is a hang: on a busy machine everything takes longer, and while it
/// loads, a program computes. At least a twentieth counts.
double counted_s(double ran_s, double computed_s, double starved_s, bool loads);

/// Ends the process where a wait has no end. Only time in which this process ran counts (counted_s), so that a stopped or
/// starved program is not taken for a hung one.
class WaitWatch {
public:
    /// limit_s: of a wait that names none, from here on.
    explicit WaitWatch(double limit_s);
    ~WaitWatch();
    WaitWatch(const WaitWatch&) = delete;

private:
    struct Thread;
    std::unique_ptr<Thread> thread_;
};

} // namespace starbow
