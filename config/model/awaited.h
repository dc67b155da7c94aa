#pragma once
#include "config/model/log_kinds.h"
#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace starbow {

/// A place on the network that this machine may not have yet: an address, a free port, an interface. It is tried once a
/// second, and the log says once that it is missing and once that it has come. The caller has the clock.
class Awaited {
public:
    using Time = std::chrono::steady_clock::time_point;

    /// place: a text such as "the head tracker's port 4242 of 192.168.7.20".
    Awaited(std::string place, LogTo log)
        : place_(std::move(place))
        , log_(std::move(log))
    {
    }

    /// True where the place is to be tried now: at first, then a second after each failure.
    bool is_due(Time now) const { return !there_ && (!next_ || now >= *next_); }
    /// It can't be had. why: a phrase, such as that of an errno.
    void fails(const std::string& why, Time now)
    {
        there_ = false, next_ = now + std::chrono::seconds(1);
        std::string lack = place_ + " can't be had (" + why + ")";
        if (std::exchange(lack_, std::move(lack)) != lack_)
            log_(LogKind::network_waits, lack_ + "; the exhibit goes on without it, and takes it up once it is there");
    }
    void comes()
    {
        there_ = true;
        if (!std::exchange(lack_, {}).empty())
            log_(LogKind::network_opens, place_ + " is there now");
    }

    bool is_there() const { return there_; }
    /// A sentence about what is missing; empty: it was not tried yet, or it is there.
    const std::string& lack() const { return lack_; }

private:
    std::string place_;
    LogTo log_;
    bool there_ = false;
    std::optional<Time> next_;
    std::string lack_;
};

} // namespace starbow
