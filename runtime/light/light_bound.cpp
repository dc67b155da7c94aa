#include "light_bound.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

/// The sum over all coefficients: none may be greater in a mixture.
double sum_at(const Response& response, std::vector<double>& one, double D)
{
    double sum = 0;
    for (double& coefficient : one) {
        coefficient = 1;
        const glm::dvec3 colour = glm::abs(seen(response, one, D));
        sum += std::max({colour.x, colour.y, colour.z});
        coefficient = 0;
    }
    return sum;
}

} // namespace

LightBound greatest_light(const Response& response)
{
    LightBound greatest{response.first_log2_D, response.per_octave, {}};
    std::vector<double> one(std::size_t(response.reflected + response.own), 0.0);
    const auto at
        = [&](double row) { return sum_at(response, one, std::exp2(response.first_log2_D + row / response.per_octave)); };
    double most = 0, end = at(0);
    for (int row = 0; row + 1 < RESPONSE_ROWS; ++row) {
        // Within a row a colour is a geometric function times a linear one: hardly more than the most of three points.
        constexpr double between = 1.02;
        const double begin = std::exchange(end, at(row + 1));
        most = std::max({most, between * begin, between * at(row + 0.5), between * end});
        greatest.log2_of_row.push_back(std::log2(std::max(most, 1e-300)));
    }
    return greatest;
}

double doppler_cutoff(const LightBound& greatest, bool doppler, bool headlight, double most, double least)
{
    const double limit = std::log2(least) - std::log2(most);
    const int last = int(greatest.log2_of_row.size()) - 1;
    if (!doppler) {
        if (!headlight)
            return 0;
        const double at_rest = std::clamp(-greatest.first_log2_D * greatest.per_octave, 0.0, double(last));
        // Base colours at rest are not read from the table; their greatest coefficient is a colour's.
        return std::exp2((limit - std::max(greatest.log2_of_row[std::size_t(at_rest)], 0.0)) / 3);
    }
    // The sum of two functions that never fall: the first row above the limit ends the dark.
    const auto log2_D = [&](int row) { return greatest.first_log2_D + row / greatest.per_octave; };
    int row = 0, end = last;
    while (row < end) {
        const int middle = (row + end) / 2;
        if (greatest.log2_of_row[std::size_t(middle)] + (headlight ? 3 * log2_D(middle + 1) : 0) < limit)
            row = middle + 1;
        else
            end = middle;
    }
    return row == 0 ? 0 : std::exp2(log2_D(row));
}

} // namespace starbow
