#pragma once
#include "input/channels.h"
#include <cmath>
#include <random>

namespace starbow::testing {

/// Hands of chance: they press every switch and every step of the controls, and move every number of them, from still to as
/// fast as they can. The lists of config/model/switches.h and input/channels.h describe a new control for these hands, too.
class ChanceHands {
public:
    explicit ChanceHands(unsigned int seed)
        : random_(seed)
        , restless_(std::pow(uniform(0, 1), 2))
        , has_lever_(uniform(0, 1) < 0.5)
    {
        for (auto& channel : moves_)
            for (Move& move : channel)
                move.still = uniform(0, 1) < 0.4, move.shakes = uniform(0, 1) < 0.5, move.hz = uniform(1, 9);
    }

    Controls next(double dt_s)
    {
        time_s_ += dt_s;
        Controls controls;
        for (const SwitchEntry& one : all_switches)
            controls.set(one.which, uniform(0, 1) < 3 * restless_ * dt_s);
        for (const auto step : all_steps)
            controls.*step = uniform(0, 1) < 3 * restless_ * dt_s ? int(uniform(-10, 11)) : 0;
        if (has_lever_)
            controls.lever = 0.5;
        for (std::size_t i = 0; i < all_channels.size(); ++i) {
            const std::span<double> numbers = all_channels[i].of(controls);
            for (std::size_t n = 0; n < numbers.size(); ++n)
                numbers[n] += reach(all_channels[i].way) * moved(moves_[i][n], dt_s);
        }
        if (controls.lever)
            controls.lever = std::clamp(*controls.lever, 0.0, 1.0);
        controls.head.turned = glm::normalize(controls.head.turned);
        return controls;
    }

private:
    struct Move {
        bool still = false, shakes = false;
        double hz = 1, now = 0, left_s = 0;
    };

    static double reach(Way way) { return way == Way::place ? 0.5 : way == Way::change ? 0.3 : 1; }

    /// From -1 to 1: a shake, or a place that is held for a while.
    double moved(Move& move, double dt_s)
    {
        if (move.still)
            return 0;
        if (move.shakes)
            return std::sin(6.283 * move.hz * time_s_);
        if ((move.left_s -= dt_s) < 0)
            move.left_s = uniform(0, 0.8), move.now = std::clamp(std::round(uniform(-1.5, 1.5)), -1.0, 1.0);
        return move.now;
    }

    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

    std::mt19937 random_;
    double restless_;
    bool has_lever_;
    double time_s_ = 0;
    std::array<std::array<Move, 4>, all_channels.size()> moves_{};
};

} // namespace starbow::testing
