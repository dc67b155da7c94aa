#pragma once
#include "input/command.h"
#include <optional>
#include <string>

namespace starbow {

/// A docent's directions to a running exhibit that are neither content nor a visitor's choice.
class Docent {
public:
    /// Carries out fade, exposure, caption, hold, speed limit and restart. Returns false, and changes nothing, for any other
    /// command.
    bool apply_command(const Command& command);
    /// dt_s seconds later.
    void advance(double dt_s);
    /// The exhibit begins again, without any.
    void forget() { *this = {}; }

    bool fades() const { return fades_; } ///< to black, and stays so
    double fade() const { return fade_; } ///< the part of black over the picture
    bool holds() const { return holds_; } ///< the visitors' devices do nothing
    double exposure_ev() const { return exposure_ev_; } ///< added to every picture's
    const std::string& caption() const { return caption_; } ///< on the head-up display; empty: none
    std::optional<double> max_gamma() const { return max_gamma_; } ///< of visitors; none: the exhibit's own
    bool restarts() const { return restarts_; } ///< the exhibit ends, so that the service manager starts it again
    std::string refusal{}; ///< the reason of the last refused command

private:
    bool fades_ = false, holds_ = false, restarts_ = false;
    double fade_ = 0, exposure_ev_ = 0;
    std::string caption_{};
    std::optional<double> max_gamma_{};
};

} // namespace starbow
