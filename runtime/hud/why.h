#pragma once
#include "config/model/scene_file.h"
#include "config/model/words.h"
#include "instruments.h"
#include "runtime/flight/ship.h"
#include <array>
#include <string>
#include <vector>

namespace starbow {

/// The pages that explain the picture, in the order of the key that steps through them.
enum class Why { none, aberration, doppler, headlight, delay, dilation, length };
constexpr std::array<const char*, 7> why_names
    = {"none", "aberration", "doppler", "headlight", "delay", "dilation", "length"};

/// All measurements of one instant.
struct Measured {
    MeasuringObserver observer;
    double ship_s = 0, world_s = 0; ///< the clock on board since the start, and the world's
    double light_speed_m_s = 299792458, seconds_per_time_unit = 1; ///< the scene's
    Effects effects;
    SpotReading aim;
    std::array<std::optional<SpotReading>, 2> marks;
    std::array<long, 2> mark_numbers{}; ///< which mark each is since the start of the program, from 1; 0: none
    std::optional<PairReading> pair;
};

/// The instruments' readings at one instant. aim: the spot at the crosshair; light: its light, as Probed::light.
Measured measured_of(const MeasuringObserver& observer, const Ship& ship, const SceneFile& scene, const World& world,
    const Effects& effects, const Spot& aim, double light, const std::array<std::optional<Spot>, 2>& marks);

/// A page: the effect in a sentence or two, its formula in the field's symbols, and the formula with the numbers on screen.
struct WhyPage {
    std::string title;
    std::vector<std::string> sentence;
    std::string formula;
    std::vector<std::string> numbers;
};
WhyPage why_page(Why why, const Measured& measured, const Words& words);

/// The instruments' readings for people: label and value, three rows of three.
std::array<std::pair<std::string, std::string>, 9> reading_fields(const Measured& measured, const Words& words);

} // namespace starbow
