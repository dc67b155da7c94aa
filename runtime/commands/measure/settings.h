#pragma once
#include "config/model/shot.h"
#include "runtime/images/accuracy.h"
#include "runtime/render/render_context.h"
#include <filesystem>

namespace starbow {

/// What all settings are tried on.
struct Trial {
    std::filesystem::path scene;
    Layout layout;
    std::vector<std::pair<std::string, Shot>> shots; ///< by name, all of that scene
    Quality standard; ///< every time is measured in turn with this
    int rounds = 9, samples = 64;
    std::filesystem::path folder; ///< for the references' rows and for what was measured already; made
};

/// Measures each setting's time, memory and error on the device. What takes long is kept in the folder, so that an
/// interrupted run goes on where it was. Throws InputError.
std::vector<MeasuredSetting> measure_settings(
    const Trial& trial, const std::vector<Setting>& settings, const Device::Options& options, std::string& machine);

/// How long one quality's frames take, as a ratio to another's, in turn with them: two times of a long run lie minutes
/// apart, and the machine's own ups and downs between them.
double time_ratio(const Trial& trial, const Quality& one, const Quality& other, const Device::Options& options);

} // namespace starbow
