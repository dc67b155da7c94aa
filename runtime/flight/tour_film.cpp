#include "tour_film.h"
#include <cmath>

namespace starbow {

long TourFilm::frames() const { return std::lround(std::ceil(length_s(show_.tour) * double(frames_per_s_) - 1e-6)); }

std::int64_t TourFilm::time_ns(long frame) const { return std::llround(double(frame) * 1e9 / double(frames_per_s_)); }

const Touring& TourFilm::at(long frame)
{
    while (frame_ < frame) {
        const std::int64_t before = time_ns(frame_), after = time_ns(++frame_);
        touring_ = advance(std::move(touring_), show_, {}, after - before);
    }
    return touring_;
}

} // namespace starbow
