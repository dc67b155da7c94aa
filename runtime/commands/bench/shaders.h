#pragma once
#include <filesystem>
#include <string>

namespace starbow {

/// Prints what each pass's shaders cost on a graphics card that need not be there (shader_costs).
/// pass: all variants of this pass alone, or empty. scene: a name, or empty for all that are shipped. json: the file for the
/// figures of each pipeline, or empty. against: such a file of another time, or empty: what changed is printed.
/// Throws InputError.
void bench_shaders(const std::string& family, const std::string& pass, const std::string& scene,
    const std::filesystem::path& json, const std::filesystem::path& against);

} // namespace starbow
