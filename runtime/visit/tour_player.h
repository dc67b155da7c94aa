#pragma once
#include "flight_source.h"
#include "read_aloud.h"
#include "runtime/flight/tour.h"
#include "runtime/hud/caption.h"
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

/// The text of a step before it is shown: its question, or its caption, with … where a number is still to be measured.
std::string announced(const Step& step);

/// How a tour is shown.
struct Staging {
    bool visitors = true; ///< false where nobody is there to fly and to answer
    bool read_aloud = false; ///< its steps last until their texts are read
    bool surrounds = false; ///< the display does, the visitor
};

/// A tour as the source of an exhibit's flight.
class TourPlayer : public FlightSource {
public:
    /// seconds_per_time_unit: of the tour's scene.
    TourPlayer(Tour tour, const Flying& rules, double seconds_per_time_unit, const Staging& staging = {})
        : staging_(staging)
        , tour_(staged(std::move(tour)))
        , show_{tour_, rules, seconds_per_time_unit, staging.visitors}
        , touring_(touring_at(show_))
    {
    }

    const Flight& flight() const override { return touring_.flight; }
    const Flight& advance(const Controls& controls, std::int64_t dt_ns) override;
    bool by_hand() const override { return flies(touring_, show_); }
    bool over() const override { return touring_.over; }
    bool paused() const override { return by_hand() ? touring_.flight.frozen : touring_.paused; }
    double begun_ev() const override { return touring_.flight.exposure_ev; }
    double visitors_ev() const override { return touring_.brighter_ev; }
    /// The tour's exposure, or the adapted one where the visitor flies; it fades from one to the other.
    double shown_ev(const Exposure& adapted, const Exposing& rules) const override;
    Flight* switched() override { return by_hand() ? &touring_.flight : nullptr; }
    void limit(double max_gamma) override { show_.rules.max_gamma = max_gamma; }
    const TourPlayer* tour() const override { return this; }
    TourPlayer* tour() override { return this; }

    bool asks() const { return starbow::asks(touring_, show_); } ///< a question waits for an answer
    bool answered() const { return touring_.measured_answer.has_value(); } ///< the step's question
    const std::string& description() const { return tour_.steps[touring_.step()].description; } ///< of the step
    std::string title() const { return title_of(touring_, show_); } ///< while it is shown; or empty
    std::size_t step() const { return touring_.step(); } ///< counted from 0
    const std::vector<Step>& steps() const { return tour_.steps; }
    /// Seconds left of the present step; 0 after the tour's end.
    double left_s() const { return touring_.over ? 0 : starbow::left_s(touring_, show_); }
    /// The tour begins again.
    void again();
    /// The tour's own motion stands still, or goes on.
    void pause(bool on) { touring_.paused = on; }
    /// The same tour in another language keeps its step and the part of it that is over.
    void reword(Tour tour);

    /// The caption; nullopt after the tour's end, while the visitor flies.
    std::optional<Caption> caption(const Words& words, const InputCapabilities& capabilities) const;
    /// The line that the tour has ended, for a while after its end; otherwise "".
    std::string prompt(const Words& words) const;

private:
    Tour staged(Tour tour) const;

    Staging staging_;
    Tour tour_;
    Show show_;
    Touring touring_;
    double automatic_ = 0; ///< the automatic exposure's part, from 0 to 1
    double over_s_ = 0;
};

} // namespace starbow
