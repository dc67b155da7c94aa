#pragma once
#include "config/model/quality.h"
#include "picture_errors.h"
#include <string>
#include <vector>

namespace starbow {

/// One way to spend a frame.
struct Setting {
    std::string name;
    Quality quality;
    bool shipped = false; ///< by its name a file of config/qualities
};

/// What it costs, and how far its pictures are from the reference: of all shots and outputs together.
struct MeasuredSetting {
    Setting setting;
    double ms = 0; ///< of a frame: the mean of the shots' medians
    double ratio = 1; ///< to the default setting's, each time measured in turn with it
    double megabytes = 0; ///< of images on the device
    double texels_per_pixel = 0; ///< drawn
    int images = 0; ///< the most of any shot
    PictureErrors errors{}; ///< means; of the noise's energy; of the edges the worst
    double direction_px = 0; ///< the worst 99th percentile of how far a pixel looks from where it should, pixels
    double doppler = 0; ///< the same of D, relative
};

/// What `starbow measure` tries: the shipped settings, each knob of the default by itself, and the knobs that matter most
/// together. two_eyes: the stereo methods too. needed: the level of light that the scene asks for.
std::vector<Setting> settings_to_try(
    const std::vector<Setting>& shipped, const Quality& standard, bool two_eyes, SpectralLevel needed);

/// Which of them none of the others beats: by being as fast and more accurate (FLIP), or faster and as accurate.
std::vector<bool> frontier(const std::vector<MeasuredSetting>& all);

/// Whether another of them is better than one in both by more than a part: what noise may hide.
const MeasuredSetting* better_than(const MeasuredSetting& one, const std::vector<MeasuredSetting>& all, double part);

/// The most accurate within a frame's time; null where none is.
const MeasuredSetting* best_within(const std::vector<MeasuredSetting>& all, double budget_ms);

/// What a frame's time may be held by: the frontier's settings between which a flight can change, from the fastest.
std::vector<PresetLevel> ladder_of(const std::vector<MeasuredSetting>& all);

/// What was measured, for the page's head.
struct MeasuredOn {
    std::string what; ///< scene, layout, shots
    std::string machine; ///< device, driver
    int rounds, samples;
};
std::string accuracy_csv(const std::vector<MeasuredSetting>& all);
/// Error against milliseconds, a point a setting, the frontier a line. Stands by itself in an .svg file or in a page.
std::string accuracy_chart(const std::vector<MeasuredSetting>& all, const std::string& title);
/// A page that needs nothing but itself.
std::string accuracy_page(const std::vector<MeasuredSetting>& all, const MeasuredOn& on);

} // namespace starbow
