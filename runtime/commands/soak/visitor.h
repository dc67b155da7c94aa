#pragma once
#include "runtime/flight/record.h"
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace starbow {

/// Names of everything that a visitor or a docent may choose.
struct SoakNames {
    std::vector<std::string> scenes, shots, tours, languages, qualities;
};

/// The use of the exhibit in a soak: visitors of all kinds; a tour that nobody touches; a stick in the hand without a rest;
/// and a still exhibit with a layout that is saved at each visit.
enum class Use { visitors, tour, flight, reloads };
inline constexpr std::array use_names{"visitors", "tour", "flight", "reloads"}; ///< in the order of Use

/// A visitor made of random numbers: the same seed and number give the same visit on every machine. Some use keys, some a
/// stick, some watch, and some visit with a docent at the remote. In a flight all use the stick; in a tour and in reloads
/// all watch.
class SeededVisitor {
public:
    SeededVisitor(Use use, std::uint64_t seed, long visit, const SoakNames& choices);

    int frames() const { return frames_; } ///< of the whole visit
    /// The controls and commands of the next frame, of dt_s seconds.
    void act(RecordEntry& entry, double dt_s);

private:
    enum class Kind { keys, stick, watcher, docent };
    bool chance(double part) { return std::uniform_real_distribution<double>()(random_) < part; }
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    const std::string& any(const std::vector<std::string>& names)
    {
        return names[std::uniform_int_distribution<std::size_t>(0, names.size() - 1)(random_)];
    }
    void press_keys(Controls& controls, double dt_s);
    void move_stick(Controls& controls, double dt_s);
    Command direction();

    std::mt19937_64 random_;
    const SoakNames& choices_;
    Kind kind_;
    int frames_;
    glm::dvec3 turn_{0}, push_{0};
    double lever_ = 0;
};

} // namespace starbow
