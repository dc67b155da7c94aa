#pragma once
#include "spectra.h"

namespace starbow {

enum class ChartFields { colours, greys };

/// The errors of a level against sums over every nanometre. They are taken over the fields of a colour chart under the Sun,
/// at D from 1/8 to 8.
struct SpectralErrors {
    double median = 0, worst = 0; ///< CIEDE2000, at equal luminance
    double luminance = 0; ///< the worst, relative
};
SpectralErrors chart_errors(SpectralLevel level, ChartFields fields);

} // namespace starbow
