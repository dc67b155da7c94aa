#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace starbow {

/// The one master whose messages a node follows: the first one heard, until it is gone. Times are the caller's.
class Following {
public:
    using Time = std::chrono::steady_clock::time_point;
    /// A master that was silent for so long is gone. It is longer than a master takes to show another world.
    static constexpr std::chrono::seconds silence{3};

    /// A state of a master, not 0. Returns false where another one is followed.
    bool hears(std::uint64_t master, Time now)
    {
        if (master_ == 0)
            master_ = master;
        if (master_ != master)
            return false;
        heard_ = now;
        return true;
    }
    /// ended: the network says that the followed one has ended. Returns true where it is gone: the next one is followed.
    bool drops(bool ended, Time now)
    {
        if (master_ == 0 || (!ended && now - heard_ < silence))
            return false;
        master_ = 0;
        return true;
    }
    std::optional<std::uint64_t> master() const { return master_ == 0 ? std::nullopt : std::optional(master_); }

private:
    std::uint64_t master_ = 0; ///< as the network numbers writers, from 1; 0: none
    Time heard_{};
};

/// Another master of the same exhibit, as its states describe it.
struct Rival {
    std::uint64_t master = 0; ///< a number of its own
    std::int64_t led_ms = 0; ///< since it began to lead, as it says
    bool followed = false; ///< nodes have said that they draw its states
};

/// A master's turn to lead its exhibit: it listens first, and stands back while another one leads. Times are the caller's.
class Leading {
public:
    using Time = std::chrono::steady_clock::time_point;
    /// For so long a master listens before it leads.
    static constexpr std::chrono::milliseconds listens{1000};

    Leading(std::uint64_t master, Time now)
        : master_(master)
        , began_(now)
    {
    }

    /// Another master's state. followed: nodes draw the states of this one.
    void hears(const Rival& other, bool followed, Time now)
    {
        other_ = now;
        if (!since_ || followed)
            return;
        // Nodes decide. What a master says of itself counts only where neither ever had any.
        const std::int64_t led = led_ms(now);
        const bool as_long = std::max(led, other.led_ms) - std::min(led, other.led_ms) < 1000;
        const bool outranks = as_long ? other.master < master_ : other.led_ms > led;
        if (other.followed || (!was_followed_ && outranks))
            since_.reset(), was_followed_ = false;
    }
    /// True where it sends states now. followed: nodes draw them.
    bool leads(bool followed, Time now)
    {
        if (!since_ && now - began_ >= listens && !hears_other(now))
            since_ = now;
        was_followed_ |= since_ && followed;
        return since_.has_value();
    }
    /// True while another one sends states.
    bool hears_other(Time now) const { return other_ && now - *other_ < Following::silence; }
    std::int64_t led_ms(Time now) const
    {
        return since_ ? std::chrono::duration_cast<std::chrono::milliseconds>(now - *since_).count() : 0;
    }

private:
    std::uint64_t master_;
    Time began_;
    std::optional<Time> since_, other_;
    bool was_followed_ = false; ///< since it leads
};

} // namespace starbow
