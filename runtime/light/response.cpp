#include "response.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace starbow {
namespace {

constexpr double least_log2 = -1000; // stands for no light, yet finite and interpolated without NaN

double peak(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

struct Scaled {
    double log2;
    glm::dvec3 over(const glm::dvec3& value) const { return value * std::exp2(-log2); }
};
Scaled scale_of(double value) { return {std::max(std::log2(value), least_log2)}; }

/// A row's colours over its scale, by basis coefficient, rounded to halves; and the scale's logarithm.
struct ScaledRow {
    std::array<float, 3 * MOST_REFLECTED> values{};
    float log2 = 0;
};
ScaledRow row_of(const glm::dvec3* seen, int reflected, const StandardObserver& observer)
{
    double most = 0;
    for (int k = 0; k < reflected; ++k)
        most = std::max({most, std::abs(seen[k].x), std::abs(seen[k].y), std::abs(seen[k].z)});
    // Halves keep eleven bits down to 2^-14: with the greatest value at 2^12, of 26 octaves of light.
    const Scaled scale = scale_of(most * std::exp2(-12));
    ScaledRow row;
    row.log2 = float(scale.log2);
    for (int k = 0; k < reflected; ++k)
        for (int c = 0; c < 3; ++c)
            row.values[std::size_t(3 * k + c)]
                = glm::unpackHalf1x16(glm::packHalf1x16(float((observer.rec709 * scale.over(seen[k]))[c])));
    return row;
}

template <class AnyResponse> auto& word(AnyResponse& response, int row, int k)
{
    return response.rows[std::size_t(row * RESPONSE_TEXELS(response.reflected) + k / 4)][k % 4];
}

} // namespace

Response response_of(const SpectralBasis& basis, const StandardObserver& observer)
{
    const ColourTable table = response_table(basis, observer, RESPONSE_ROWS);
    Response response{basis.reflected, int(basis.own.size()), table.first_log2_D, double(table.per_octave), {}, {}, {}};
    const glm::dvec3* at_rest = table.row(int(std::lround(-table.first_log2_D * table.per_octave)));
    for (int k = 0; k < basis.size(); ++k)
        response.unshifted.push_back(observer.rec709 * at_rest[k]);
    response.rows.assign(std::size_t(RESPONSE_ROWS * RESPONSE_TEXELS(basis.reflected)), glm::uvec4(0));
    response.own_rows.assign(MOST_OWN_ROWS, glm::vec4(0, 0, 0, float(least_log2)));
    std::vector<ScaledRow> rows;
    for (int row = 0; row < RESPONSE_ROWS; ++row)
        rows.push_back(row_of(table.row(row), basis.reflected, observer));
    for (int row = 0; row < RESPONSE_ROWS; ++row) {
        const ScaledRow &here = rows[std::size_t(row)], &next = rows[std::size_t(std::min(row + 1, RESPONSE_ROWS - 1))];
        for (int k = 0; k < 3 * basis.reflected; ++k) {
            const float value = here.values[std::size_t(k)];
            word(response, row, k) = glm::packHalf2x16({value, next.values[std::size_t(k)] - value});
        }
        word(response, row, 3 * basis.reflected) = std::bit_cast<std::uint32_t>(here.log2);
        word(response, row, 3 * basis.reflected + 1) = std::bit_cast<std::uint32_t>(next.log2 - here.log2);
    }
    const int own_step = RESPONSE_OWN_STEP(response.own);
    for (int row = 0; row < RESPONSE_ROWS; row += own_step)
        for (int i = 0; i < response.own; ++i) {
            const glm::dvec3 own = table.row(row)[basis.reflected + i];
            const Scaled scale = scale_of(peak(own));
            response.own_rows[std::size_t(row / own_step * response.own + i)]
                = glm::vec4(observer.rec709 * scale.over(own), scale.log2);
        }
    return response;
}

std::vector<glm::u16vec4> picture_of(const Response& response)
{
    std::vector<glm::u16vec4> picture;
    for (int k = 0; k < response.reflected; ++k)
        for (int row = 0; row < RESPONSE_ROWS; ++row) {
            const float log2 = std::bit_cast<float>(word(response, row, 3 * response.reflected));
            const float nearest = glm::unpackHalf1x16(glm::packHalf1x16(log2));
            glm::u16vec4& texel = picture.emplace_back(0);
            for (int c = 0; c < 3; ++c)
                texel[c] = std::uint16_t(word(response, row, 3 * k + c) & 0xffff); // the lower half is the value
            texel.w = glm::packHalf1x16(k == 0 ? nearest : k == 1 ? log2 - nearest : 0);
        }
    return picture;
}

glm::dvec3 seen(const Response& response, std::span<const double> coefficients, double D)
{
    const double unclamped = (std::log2(D) - response.first_log2_D) * response.per_octave;
    const double at = std::clamp(unclamped, 0.0, RESPONSE_ROWS - 1.001);
    const int i = int(at);
    const double part = at - i;
    glm::dvec3 light(0);
    for (int k = 0; k < 3 * response.reflected; ++k) {
        const glm::dvec2 pair = glm::unpackHalf2x16(word(response, i, k));
        light[k % 3] += (pair.x + part * pair.y) * coefficients[std::size_t(k / 3)];
    }
    auto real = [&](int k) { return double(std::bit_cast<float>(word(response, i, k))); };
    light *= std::exp2(real(3 * response.reflected) + part * real(3 * response.reflected + 1));
    const int own_step = RESPONSE_OWN_STEP(response.own);
    const double own_at = std::min(at / own_step, RESPONSE_ROWS / own_step - 1.001);
    const std::size_t j = std::size_t(own_at), own = std::size_t(response.own);
    for (int k = 0; k < response.own; ++k) {
        const glm::dvec4 row = glm::mix(glm::dvec4(response.own_rows[j * own + std::size_t(k)]),
            glm::dvec4(response.own_rows[(j + 1) * own + std::size_t(k)]), own_at - double(j));
        light += glm::dvec3(row) * (std::exp2(row.w) * coefficients[std::size_t(response.reflected + k)]);
    }
    // Beyond the table every tail falls as 1 / D^2.
    const double beyond = std::exp2(std::min(0.0, (at - unclamped) / response.per_octave));
    return light * (beyond * beyond);
}

} // namespace starbow
