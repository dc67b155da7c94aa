#pragma once

namespace starbow {

/// Times frames of one scene with more and more bodies of different velocities in view, and with as many out of view.
void bench_bodies(int rounds);

} // namespace starbow
