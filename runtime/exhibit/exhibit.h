#pragma once
#include "config/model/exposing.h"
#include "config/model/flying.h"
#include "config/model/layout.h"
#include "config/model/profile.h"
#include "config/model/shot.h"
#include "config/model/tour_file.h"
#include "config/model/words.h"
#include "runtime/operation/latency.h"
#include "runtime/render/frame_renderer.h"
#include <filesystem>
#include <functional>
#include <optional>

namespace starbow {

class Trace;

/// An exhibit as it opens, its files read.
struct ExhibitOptions {
    std::filesystem::path scene;
    Layout layout;
    Shot start; ///< where the visit begins and where reset leads back to
    Words words; ///< of what the visitor reads
    std::optional<Tour> tour{}; ///< that is shown, in its own scene
    Flying rules{};
    Exposing exposure{};
    std::vector<Profile> profiles{};
    bool tutorial = true;
    std::optional<Quality> quality{}; ///< none: what the device affords
    double frame_budget_ms = 0; ///< of a whole frame; 0: the quality stays
    std::vector<PresetLevel> ladder{}; ///< by which it is held
    std::optional<bool> warms_up{}; ///< compiles what the switches can need before the first frame; none: on a GPU
    long frames = 0; ///< to be shown; 0: until the visitor leaves
    Pattern pattern = Pattern::none; ///< what the outputs show first
    std::filesystem::path record{}; ///< where to keep the flight; empty: nowhere
    std::filesystem::path log{}; ///< where to keep what is measured, a CSV file; empty: nowhere
    double log_every_s = 0; ///< writes a line by itself so often; 0: only when asked
    std::filesystem::path replay{}; ///< a record to fly again instead of the visitor; empty: none
    Trace* trace = nullptr; ///< gets the spans of each frame; null: none. It outlives the flight
    std::function<void(const FrameTimes&)> timed{}; ///< is told of each frame
    std::function<bool()> over{}; ///< is asked before each frame whether to leave
};

/// Flies until the visitor leaves. Follows changes of the layout's files, of the monitors, and the loss of the GPU. Returns
/// the exit status; throws InputError for what is wrong at the start.
int fly_exhibit(const ExhibitOptions& options);

} // namespace starbow
