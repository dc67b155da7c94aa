#pragma once
#include "flying.h"
#include "measure.h"
#include "shot.h"
#include "words.h"
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace starbow {

/// A choice is right where the measured number is at least `from` and below `below`.
struct Choice {
    std::string text;
    double from = -std::numeric_limits<double>::infinity(), below = std::numeric_limits<double>::infinity();
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
    double unattended_s = 7; ///< the longest time for which the question is shown where nobody is there to answer
};

/// A thing that a step speaks of: the picture has a ring with a name around it.
struct Highlight {
    std::string name; ///< above the ring
    std::string body; ///< a body of the scene, or empty: the world
    std::string globe; ///< a globe of the scene's sky instead, or empty
    glm::dvec3 at{0}; ///< its middle, scene units: in the world, or from a body's origin, among its axes, where it rests
    double across = 0; ///< its diameter at rest, scene units; of a globe the globe's own
    bool enlarged = false; ///< while it looks small, an inset shows it enlarged, with a line to its place
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

/// A step's motion on displays that surround the visitor.
struct Around {
    std::variant<Coast, Cut, Glide> motion; ///< a cut or a glide
};

struct Step {
    double seconds; ///< of the visitor's time
    double ship_s_per_s
        = 1; ///< seconds of the ship's per second of the visitor's: slow and fast motion; 0: time stands still
    glm::dvec2 ease_s{0}; ///< durations in which the ship's time starts at the step's beginning and stops at its end
    std::variant<Coast, Cut, Glide, Thrust, Turning, Try> motion;
    std::string title; ///< in large letters over the picture, or empty
    std::string caption; ///< or empty
    std::string description; ///< of the picture, for people who cannot see it; or empty
    std::optional<Measure> measure; ///< the value of {measured} in the caption
    std::vector<Highlight> highlights; ///< two at most
    std::optional<Effects> effects; ///< nullopt: as before
    std::optional<double> exposure_ev; ///< reached at once with a cut, else by the step's end; nullopt: as before
    std::optional<Question> question;
    std::optional<Around> around; ///< instead of `motion`, by seen_on
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

/// The same tour on a display that surrounds the visitor (Layout::surrounds), nearer to what would be small there, or on
/// another.
Tour seen_on(Tour tour, bool surrounds);

/// Reads and checks a tour, its texts in the words' language. Throws InputError.
Tour load_tour(const std::filesystem::path& file, const Words& words, const FindShot& find_shot);

} // namespace starbow
