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

/// Nodes of the glTF file, with all nodes below them, that move as one. In their own rest frame they are placed as in the
/// file, around the body's own origin. That frame's axes are the world's, carried by the pure boost.
struct Body {
    std::string name;
    std::vector<std::string> nodes;
    glm::dvec3 u{0}; ///< proper velocity if `worldline` is empty: the origin passes `at`, and the body moves for ever
    Event at;
    std::vector<Event> worldline; ///< otherwise the events that the origin joins by straight segments, each within the light
                                  ///< cone of the one before; before the first and after the last the body does not exist
};

} // namespace starbow
