#pragma once
#include "flying.h"
#include "shot.h"
#include "words.h"
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace starbow {

/// A number that follows from the ship's state.
struct Measure {
    enum class Quantity {
        gamma,
        beta,
        rapidity,
        ship_s, ///< the ship's clock, seconds
        world_s, ///< the world's, seconds
        distance, ///< to `at` in the world, scene units
        angle_deg, ///< between the motion and the seen direction of `at`; straight ahead 0
        doppler, ///< D of light from `at`
        doppler_ahead, ///< D straight along the motion
        size, ///< the angular size of a small thing at `at`, over that at the tour's last cut
        reading_s, ///< the seen reading of a clock at `at` that keeps the world's time, seconds
        now_s, ///< that clock's reading at the ship's present, in the ship's frame, seconds
        own_colour_deg, ///< angle from the motion at which D is 1
    };
    Quantity quantity = Quantity::gamma;
    glm::dvec3 at{0}; ///< a place at rest in the world, scene units
    std::optional<glm::dvec3> relative_to; ///< the quantity at this place is subtracted
};
inline const std::vector<std::pair<std::string_view, Measure::Quantity>> measures{{"gamma", Measure::Quantity::gamma},
    {"beta", Measure::Quantity::beta}, {"rapidity", Measure::Quantity::rapidity}, {"ship_s", Measure::Quantity::ship_s},
    {"world_s", Measure::Quantity::world_s}, {"distance", Measure::Quantity::distance},
    {"angle_deg", Measure::Quantity::angle_deg}, {"doppler", Measure::Quantity::doppler},
    {"doppler_ahead", Measure::Quantity::doppler_ahead}, {"size", Measure::Quantity::size},
    {"reading_s", Measure::Quantity::reading_s}, {"now_s", Measure::Quantity::now_s},
    {"own_colour_deg", Measure::Quantity::own_colour_deg}};
constexpr bool has_place(Measure::Quantity quantity)
{
    using enum Measure::Quantity;
    return quantity == distance || quantity == angle_deg || quantity == doppler || quantity == size || quantity == reading_s
        || quantity == now_s;
}

/// A choice is right where the measured number is at least `from` and below `below`.
struct Choice {
    std::string text;
    double from, below;
};
/// A number that the visitor sets; it is right within the tolerance of the measured one.
struct NumberToSet {
    double from, to, step, tolerance;
};
/// The visitor flies until the measured number is between these.
struct PlaceToReach {
    double from, to;
};
struct Question {
    std::string ask, explanation; ///< explanation: shown after any answer; {measured} stands for the number
    Measure measure;
    std::variant<std::vector<Choice>, NumberToSet, PlaceToReach> answer;
    double explanation_s = 8; ///< the time for which the explanation is shown
};

/// A jump to a shot.
struct Cut {
    Shot shot;
};
/// A camera's path, not a ship's. It leads from the last step's end to a place, a velocity and a view, without a jerk at
/// either end. The velocity moves along the geodesic of velocity space. Missing members stay. The world's time advances
/// by gamma for each second of the ship's, or to `time`.
struct Glide {
    std::optional<glm::dvec3> position, u;
    std::optional<glm::dquat> ship_from_cockpit;
    std::optional<double> time;
};
/// Constant proper acceleration, rapidity per second of the ship's, along the nose or along a direction among the ship's
/// axes.
struct Thrust {
    double rapidity_per_s;
    std::optional<glm::dvec3> towards;
};
/// A straight flight while the nose turns to a view without a jerk.
struct Turning {
    glm::dquat ship_from_cockpit;
};
struct Coast { };
/// The visitor flies, until the time is over or the visitor goes on.
struct Try {
    std::optional<FlightMode> mode; ///< nullopt: the exhibit's
    std::optional<double> max_gamma; ///< at most the exhibit's
};

struct Step {
    double seconds; ///< of the visitor's time
    double ship_s_per_s
        = 1; ///< seconds of the ship's per second of the visitor's: slow and fast motion; 0: time stands still
    glm::dvec2 ease_s{0}; ///< durations in which the ship's time starts at the step's beginning and stops at its end
    std::variant<Coast, Cut, Glide, Thrust, Turning, Try> motion;
    std::string caption; ///< or empty
    std::optional<Measure> measure; ///< the value of {measured} in the caption
    std::optional<Effects> effects; ///< nullopt: as before
    std::optional<double> exposure_ev; ///< reached at once with a cut, else by the step's end; nullopt: as before
    std::optional<Question> question;
};

/// A timeline: the tour shows, explains, lets the visitor try, and puts questions.
struct Tour {
    std::filesystem::path file;
    std::string scene; ///< name or path of a scene file
    double again_after_s = 90; ///< the tour begins anew when nobody has touched anything for this time after its end
    std::vector<Step> steps; ///< the first is a cut
};

/// Finds the file of a named shot.
using FindShot = std::function<std::filesystem::path(const std::string& name)>;

/// Reads and checks a tour, its texts in the words' language. Throws InputError.
Tour load_tour(const std::filesystem::path& file, const Words& words, const FindShot& find_shot);

} // namespace starbow
