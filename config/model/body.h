#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace starbow {

/// An event in the world's frame: place and time, scene units; times in unit / c.
struct Event {
    double time = 0;
    glm::dvec3 position{0};
    bool operator==(const Event&) const = default;
};

/// Nodes of the glTF file, with all that hangs below them, that move as one. In their own rest frame, whose axes are the
/// world's carried by the pure boost, they stand as in the file, around the body's own origin.
struct Body {
    std::string name;
    std::vector<std::string> nodes;
    glm::dvec3 u{0}; ///< proper velocity, where `worldline` is empty: its origin passes `at`, and it moves for ever
    Event at;
    std::vector<Event> worldline; ///< else the events that its origin joins in straight segments, each within the light
                                  ///< cone of the one before; before the first and after the last it does not exist
};

struct Place;
/// Reads the scene file's member "bodies". Throws InputError.
std::vector<Body> read_bodies(const Place& place);

} // namespace starbow
