#pragma once

namespace starbow {

/// Times frames of one scene with more and more bodies of different velocities in view, and with as many out of view.
/// Returns the time with one in view over the time with all at rest.
double bench_bodies(int rounds);

} // namespace starbow
