#pragma once
#include <nlohmann/json_fwd.hpp>

namespace starbow {

/// Times the stages of a frame of the avenue at rest and in flight, beside a plain picture and a bare look-up, and the
/// spectral levels. Prints to stdout. all: also times the dome, bodies, worlds and the flight, and returns all figures;
/// else null.
nlohmann::ordered_json bench_frame_stages(int rounds, bool all);

} // namespace starbow
