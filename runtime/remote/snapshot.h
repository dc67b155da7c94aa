#pragma once
#include "config/model/information.h"
#include "config/model/shot.h"
#include <cstdint>
#include <string>
#include <vector>

namespace starbow {

/// The running exhibit as a remote shows it, once a frame.
struct Snapshot {
    // Names of files, without folder and .json; empty: none.
    std::string scene, shot, tour;
    std::string language, layout, quality;
    std::string pattern; ///< one of pattern_names; "none" or empty: the world
    int step = 0, steps = 0; ///< of the tour, the first one 1; 0: no tour
    bool paused = false, fade = false, hold = false;
    std::string visit; ///< one of visit_phase_names
    Effects effects;
    bool slow_motion = false, one_button = false, left_handed = false;
    Information information = Information::laboratory;
    double speed = 0; ///< v/c
    double gamma = 1;
    double max_gamma = 1; ///< at full throttle
    double exposure_ev = 0; ///< a docent's change
    std::string caption; ///< by the command
    double frames_per_s = 0, frame_ms = 0;
    std::string error; ///< the last one, as a sentence; empty: none
    double uptime_s = 0;
};

/// Long texts that change seldom: about once a second.
struct Condition {
    std::string metrics; ///< in Prometheus's text format
    std::vector<std::string> log; ///< the last lines, oldest first
};

/// A small picture of what the visitors see, about once a second.
struct LivePicture {
    int width = 0, height = 0; ///< pixels; at most most_live_px each
    std::vector<std::uint8_t> rgb; ///< three bytes a pixel, sRGB, from the top left, row by row
};
constexpr int most_live_px = 1024;

} // namespace starbow
