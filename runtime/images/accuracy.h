#pragma once
#include "config/model/quality.h"
#include "picture_errors.h"
#include <string>
#include <vector>

namespace starbow {

/// One way to spend a frame: a quality with a name.
struct Setting {
    std::string name;
    Quality quality;
    bool shipped = false; ///< its name is a file of config/qualities
};

/// A setting's cost and its pictures' errors against the reference: over all shots and outputs.
struct MeasuredSetting {
    Setting setting;
    double ms = 0; ///< a frame's time: the mean of the shots' medians
    double ratio = 1; ///< time over the default setting's, measured in turn with it
    double megabytes = 0; ///< memory of images on the device
    double texels_per_pixel = 0; ///< drawn
    int images = 0; ///< the most of any shot
    PictureErrors errors{}; ///< means; for the noise its energy's mean; for the edges the worst
    double direction_px = 0; ///< the worst 99th percentile of the pixels' errors of direction, pixels
    double doppler = 0; ///< the worst 99th percentile of D's relative error
};

/// The settings that `starbow measure` tries: the shipped ones, each single change of the default, and combinations of
/// the most effective changes. two_eyes: the stereo methods too. needed: the scene's spectral level.
std::vector<Setting> settings_to_try(
    const std::vector<Setting>& shipped, const Quality& standard, bool two_eyes, SpectralLevel needed);

/// The Pareto frontier: true for a setting that no other beats by being as fast and more accurate (FLIP), or faster and as
/// accurate.
std::vector<bool> frontier(const std::vector<MeasuredSetting>& all);

/// A setting that is better in both by more than the given part, beyond noise; null where there is none.
const MeasuredSetting* better_than(const MeasuredSetting& one, const std::vector<MeasuredSetting>& all, double part);

/// The most accurate setting within a frame budget; null where there is none.
const MeasuredSetting* best_within(const std::vector<MeasuredSetting>& all, double budget_ms);

/// A ladder: the frontier's settings between which a running exhibit can change, from the fastest.
std::vector<PresetLevel> ladder_of(const std::vector<MeasuredSetting>& all);

/// The subject of a measurement, for the page's head.
struct MeasuredOn {
    std::string what; ///< scene, layout, shots
    std::string machine; ///< device, driver
    int rounds, samples;
};
std::string accuracy_csv(const std::vector<MeasuredSetting>& all);
/// A chart of error against milliseconds, a point a setting, the frontier a line. It stands by itself in an .svg file or in
/// a page.
std::string accuracy_chart(const std::vector<MeasuredSetting>& all, const std::string& title);
/// An HTML page that needs no other file.
std::string accuracy_page(const std::vector<MeasuredSetting>& all, const MeasuredOn& on);

} // namespace starbow
