#pragma once
#include "film.h"

namespace starbow {

struct TourOptions {
    std::string tour, layout, size, language; ///< layout, size: "" for the desk, and as the layout's
    FilmOptions film;
    double bloom = 0;
};

/// Draws a tour frame by frame off-screen and makes a movie of it; continues an interrupted one. Returns the exit status.
int render_tour(const TourOptions& options);

} // namespace starbow
