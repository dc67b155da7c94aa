#pragma once
#include "input/exhibit_state.h"
#include <cstdint>
#include <string>
#include <vector>

namespace starbow {

/// The running exhibit as a remote shows it, once a frame.
struct Snapshot : ExhibitState {
    std::string layout, quality; ///< names of files; empty: none
    std::string pattern; ///< one of pattern_names; "none" or empty: the world
    std::string visit; ///< one of visit_phase_names
    double frames_per_s = 0, frame_ms = 0;
    std::string error; ///< the last one, as a sentence; empty: none
    std::string grip, grip_says; ///< of the layout, the chosen one and its numbers; empty: none
    std::string machines; ///< of the exhibit, in a line; empty: one shows all
    double uptime_s = 0;
};

/// Long texts that change seldom: about once a second.
struct Condition {
    std::string metrics; ///< in Prometheus's text format
    std::vector<std::string> log; ///< the last lines, oldest first
    std::vector<std::string> grips; ///< the names of the layout's
    std::size_t unkept = 0; ///< numbers, or lists of numbers, of the layout that differ from its file's
};

/// A small picture of what the visitors see, about once a second.
struct LivePicture {
    int width = 0, height = 0; ///< pixels; at most most_live_px each
    std::vector<std::uint8_t> rgb; ///< three bytes a pixel, sRGB, from the top left, row by row
};
constexpr int most_live_px = 1024;

} // namespace starbow
