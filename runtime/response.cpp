#include "response.h"
#include "runtime/shared.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace starbow {
namespace {

constexpr double least_log2 = -1000; // no light, and still numbers on the way

double peak(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

struct Scaled {
    double log2;
    glm::dvec3 over(const glm::dvec3& value) const { return value * std::exp2(-log2); }
};
Scaled scale_of(double value) { return {std::max(std::log2(value), least_log2)}; }

} // namespace

Response response_of(const SpectralBasis& basis, const Observer& observer)
{
    const ResponseTable table = response_table(basis, observer, RESPONSE_ROWS);
    Response response{basis.reflected, int(basis.own.size()), {}, {}};
    for (auto& rows : response.rows)
        rows.assign(2 * RESPONSE_ROWS, glm::uvec4(0));
    response.own_rows.assign(MOST_OWN_ROWS, glm::vec4(0, 0, 0, float(least_log2)));
    const int own_step = RESPONSE_OWN_STEP(response.own);
    for (int row = 0; row < RESPONSE_ROWS; ++row) {
        const glm::dvec3* seen = &table.seen[std::size_t(row * table.numbers)];
        glm::dvec3 grey(0);
        for (int k = 0; k < basis.reflected; ++k)
            grey += seen[k];
        const Scaled scale = scale_of(peak(grey));
        std::array<std::array<float, 12>, 3> values{};
        for (int k = 0; k < basis.reflected; ++k)
            for (int c = 0; c < 3; ++c)
                values[std::size_t(c)][std::size_t(k)] = float((observer.rec709 * scale.over(seen[k]))[c]);
        for (std::size_t c = 0; c < 3; ++c)
            for (int word = 0; word < 6; ++word)
                response.rows[c][std::size_t(2 * row + word / 4)][word % 4]
                    = glm::packHalf2x16({values[c][std::size_t(2 * word)], values[c][std::size_t(2 * word + 1)]});
        response.rows[0][std::size_t(2 * row + 1)].z = std::bit_cast<std::uint32_t>(float(scale.log2));
        if (row % own_step == 0)
            for (int i = 0; i < response.own; ++i) {
                const glm::dvec3 own = seen[basis.reflected + i];
                const Scaled scale_own = scale_of(peak(own));
                response.own_rows[std::size_t(row / own_step * response.own + i)]
                    = glm::vec4(observer.rec709 * scale_own.over(own), scale_own.log2);
            }
    }
    response.rows[0][1].w = std::bit_cast<std::uint32_t>(float(table.first_log2_D));
    response.rows[0][3].w = std::bit_cast<std::uint32_t>(float(table.per_octave));
    return response;
}

glm::dvec3 seen(const Response& response, std::span<const double> numbers, double D)
{
    auto real = [](std::uint32_t word) { return double(std::bit_cast<float>(word)); };
    const double first = real(response.rows[0][1].w), per_octave = real(response.rows[0][3].w);
    const double asked = (std::log2(D) - first) * per_octave;
    const double at = std::clamp(asked, 0.0, RESPONSE_ROWS - 1.001);
    const std::size_t i = std::size_t(at);
    const double part = at - double(i);
    glm::dvec3 light(0);
    for (std::size_t row : {i, i + 1})
        for (std::size_t c = 0; c < 3; ++c)
            for (int k = 0; k < response.reflected; ++k) {
                const glm::vec2 two = glm::unpackHalf2x16(response.rows[c][2 * row + std::size_t(k / 8)][k / 2 % 4]);
                light[int(c)] += (row == i ? 1 - part : part) * double(two[k % 2]) * numbers[std::size_t(k)];
            }
    light *= std::exp2(std::lerp(real(response.rows[0][2 * i + 1].z), real(response.rows[0][2 * i + 3].z), part));
    const int own_step = RESPONSE_OWN_STEP(response.own);
    const double own_at = std::min(at / own_step, RESPONSE_ROWS / own_step - 1.001);
    const std::size_t j = std::size_t(own_at), own = std::size_t(response.own);
    for (int k = 0; k < response.own; ++k) {
        const glm::dvec4 row = glm::mix(glm::dvec4(response.own_rows[j * own + std::size_t(k)]),
            glm::dvec4(response.own_rows[(j + 1) * own + std::size_t(k)]), own_at - double(j));
        light += glm::dvec3(row) * (std::exp2(row.w) * numbers[std::size_t(response.reflected + k)]);
    }
    // Beyond the table every tail falls as 1 / D^2.
    const double beyond = std::exp2(std::min(0.0, (at - asked) / per_octave));
    return light * (beyond * beyond);
}

} // namespace starbow
