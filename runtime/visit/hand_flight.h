#pragma once
#include "flight_source.h"
#include "runtime/flight/history.h"

namespace starbow {

/// The flight of a visitor's hands.
class HandFlight : public FlightSource {
public:
    /// seconds_per_time_unit: of the start's scene.
    HandFlight(const Shot& start, const Flying& rules, double seconds_per_time_unit)
        : start_(start)
        , rules_(rules)
        , seconds_per_time_unit_(seconds_per_time_unit)
        , flight_(flight_at(start, rules))
    {
    }

    const Flight& flight() const override { return flight_; }
    const Flight& advance(const Controls& controls, std::int64_t dt_ns) override
    {
        return flight_ = flown(flight_, history_, controls, dt_ns, rules_, seconds_per_time_unit_, start_);
    }
    double begun_ev() const override { return start_.exposure_ev; }
    Flight* switched() override { return &flight_; }
    void limit(double max_gamma) override { rules_.max_gamma = max_gamma; }
    bool is_near_home(double seconds) const override
    {
        Controls home;
        home.set(Switch::home);
        return !step(flight_, home, std::int64_t(1e9 * seconds), rules_, seconds_per_time_unit_, start_).homing;
    }

private:
    Shot start_;
    Flying rules_;
    double seconds_per_time_unit_;
    Flight flight_;
    History history_;
};

} // namespace starbow
