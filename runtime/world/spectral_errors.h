#pragma once
#include "spectra.h"

namespace starbow {

/// The errors of colours that a level's coefficients give, against sums over every nanometre, at D from 1/8 to 8.
struct SpectralErrors {
    double median = 0, worst = 0; ///< CIEDE2000, at equal luminance
    double luminance = 0; ///< the worst, relative
    int worst_spectrum = 0;
};

/// The errors of spectra that surfaces reflect together. Light of less than a thousandth of the brightest one's luminance at
/// the same D does not count.
SpectralErrors spectral_errors(const std::vector<Spectrum>& spectra, int most, std::vector<double> importance = {});

/// The errors of a colour chart's eighteen coloured fields under the Sun.
SpectralErrors chart_errors(SpectralLevel level);

/// The errors of a scene's surfaces under its lights, and the name of the worst spectrum.
struct SceneErrors {
    SpectralErrors errors;
    std::string worst;
};
SceneErrors scene_errors(const World& world, const SceneFile& scene, SpectralLevel level);

} // namespace starbow
