#pragma once
#include <filesystem>

namespace starbow {

/// Times the stages of a frame of the avenue at rest and in flight, beside a plain picture and a bare look-up, and the
/// spectral levels. Prints to stdout. json: also times the dome, bodies, worlds and the flight, and writes all figures to
/// this file, unless it is empty; throws InputError where it can't be written.
void bench_frame_stages(int rounds, const std::filesystem::path& json);

} // namespace starbow
