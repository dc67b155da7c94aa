#include "spectral_basis.h"
#include "colour.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace starbow {
namespace {

// Reflectances are told by their samples from 280 to 1250 nm, beyond which they are level.
constexpr double grid_from_nm = 280, grid_to_nm = 1250, grid_step = 0.006;
const int grid_points = int(std::log(grid_to_nm / grid_from_nm) / grid_step) + 1;
double grid_nm(int point) { return grid_from_nm * std::exp(grid_step * point); }

// The outermost hats' middles. Found by trying: the errors of colour checkers' colours are least there.
constexpr double first_hat_nm = 340, last_hat_nm = 830;

constexpr int steps = int((response_below + response_above) * response_per_octave) + 1;
double step_D(int step) { return std::exp2(double(step) / response_per_octave - response_below); }

using Row = std::vector<double>;

/// How much each sample of a sunlit reflectance adds to XYZ at D.
std::array<Row, 3> eye_on_grid(double D)
{
    static const Spectrum sun = sunlit_white();
    static const double scale = seen_xyz(sun, 1).y / [] {
        double y = 0;
        for (int nm = 360; nm <= 830; ++nm)
            y += xyz_response(nm).y * sun(nm) / (double(nm) * nm);
        return y;
    }();
    std::array<Row, 3> rows;
    rows.fill(Row(std::size_t(grid_points), 0.0));
    for (int nm = 360; nm <= 830; ++nm) {
        const double at = std::clamp(std::log(D * nm / grid_from_nm) / grid_step, 0.0, double(grid_points - 1));
        const int i = std::min(int(at), grid_points - 2);
        const glm::dvec3 add = xyz_response(nm) * (scale * sun(D * nm) / (double(nm) * nm));
        for (int c = 0; c < 3; ++c) {
            rows[std::size_t(c)][std::size_t(i)] += add[c] * (1 - (at - i));
            rows[std::size_t(c)][std::size_t(i + 1)] += add[c] * (at - i);
        }
    }
    return rows;
}

double dot(const Row& a, const Row& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

double hat(int k, int hats, double nm)
{
    const double at = std::clamp(std::log(nm / first_hat_nm) / std::log(last_hat_nm / first_hat_nm), 0.0, 1.0) * (hats - 1);
    return std::max(0.0, 1 - std::abs(at - k));
}

/// x of a x = b for a symmetric positive a (Cholesky), n columns of b at once: all row by row.
void solve(std::vector<double> a, int n, std::vector<double>& b, int columns)
{
    auto A = [&](int i, int j) -> double& { return a[std::size_t(i * n + j)]; };
    auto B = [&](int i, int j) -> double& { return b[std::size_t(i * columns + j)]; };
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < j; ++k)
            A(j, j) -= A(j, k) * A(j, k);
        A(j, j) = std::sqrt(A(j, j));
        for (int i = j + 1; i < n; ++i) {
            for (int k = 0; k < j; ++k)
                A(i, j) -= A(i, k) * A(j, k);
            A(i, j) /= A(j, j);
        }
    }
    for (int c = 0; c < columns; ++c) {
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < i; ++k)
                B(i, c) -= A(i, k) * B(k, c);
            B(i, c) /= A(i, i);
        }
        for (int i = n - 1; i >= 0; --i) {
            for (int k = i + 1; k < n; ++k)
                B(i, c) -= A(k, i) * B(k, c);
            B(i, c) /= A(i, i);
        }
    }
}

/// Smooth reflectances as pigments have them: steps and bumps on a level, other values beyond the visible.
std::vector<Row> pigments(int count)
{
    std::mt19937 random(1);
    auto between = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
    auto logistic = [](double x) { return 1 / (1 + std::exp(-x)); };
    std::vector<Row> all;
    for (int n = 0; n < count; ++n) {
        struct Feature {
            bool step;
            double height, middle_nm, width_nm;
        };
        std::vector<Feature> features;
        const double level = between(0.02, 0.5);
        for (int i = 1 + int(random() % 4); i > 0; --i) {
            const bool step = random() % 2;
            features.push_back({step, between(-0.6, 0.8), between(390, 750), step ? between(12, 40) : between(15, 60)});
        }
        auto visible = [&](double nm) {
            double value = level;
            for (const Feature& f : features) {
                const double x = (nm - f.middle_nm) / f.width_nm;
                value += f.height * (f.step ? logistic(x) : std::exp(-0.5 * x * x));
            }
            return std::clamp(value, 0.01, 0.98);
        };
        const double uv = between(0, 1) * visible(400), ir = between(0.2, 1) * visible(750) + between(0, 0.2);
        Row row;
        for (int i = 0; i < grid_points; ++i) {
            const double nm = grid_nm(i), below = logistic(-std::log(nm / 360) / 0.035),
                         above = logistic(std::log(nm / 820) / 0.05);
            row.push_back(below * uv + above * ir + (1 - below - above) * visible(std::clamp(nm, 330.0, 900.0)));
        }
        all.push_back(std::move(row));
    }
    return all;
}

} // namespace

SpectralBasis spectral_basis(int size, std::span<const double> thermal_K)
{
    SpectralBasis basis;
    basis.thermal_K.assign(thermal_K.begin(), thermal_K.end());
    const int n = basis.hats = size - int(thermal_K.size());
    const std::vector<Row> samples = pigments(200);
    std::vector<Row> hats{std::size_t(n), Row(std::size_t(grid_points), 0.0)};
    for (int k = 0; k < n; ++k)
        for (int i = 0; i < grid_points; ++i)
            hats[std::size_t(k)][std::size_t(i)] = hat(k, n, grid_nm(i));

    // The hats' numbers: those whose light looks most alike at every D from 1/10 to 10, colours weighed by how bright they
    // are there; a little by the spectra themselves, so that no number is left to chance.
    std::vector<double> normal(std::size_t(n * n), 0.0), right(std::size_t(n * grid_points), 0.0);
    const double sample_weight = 1e-3;
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j)
            normal[std::size_t(k * n + j)] += sample_weight * dot(hats[std::size_t(k)], hats[std::size_t(j)]);
        for (int i = 0; i < grid_points; ++i)
            right[std::size_t(k * grid_points + i)] += sample_weight * hats[std::size_t(k)][std::size_t(i)];
    }
    for (int step = 0; step < steps; step += 8) {
        const double D = step_D(step);
        if (std::abs(std::log(D)) > std::log(10))
            continue;
        const std::array<Row, 3> eye = eye_on_grid(D);
        double weight = 0;
        for (const Row& sample : samples)
            weight += 1 / std::pow(std::max(dot(eye[1], sample), 1e-12), 2);
        weight /= double(samples.size());
        for (const Row& row : eye) {
            std::vector<double> seen;
            for (const Row& one : hats)
                seen.push_back(dot(row, one));
            for (int k = 0; k < n; ++k) {
                for (int j = 0; j < n; ++j)
                    normal[std::size_t(k * n + j)] += weight * seen[std::size_t(k)] * seen[std::size_t(j)];
                for (int i = 0; i < grid_points; ++i)
                    right[std::size_t(k * grid_points + i)] += weight * seen[std::size_t(k)] * row[std::size_t(i)];
            }
        }
    }
    solve(normal, n, right, grid_points);
    basis.analysis = right;

    std::vector<Row> numbers;
    for (const Row& sample : samples) {
        Row row;
        for (int k = 0; k < n; ++k) {
            double sum = 0;
            for (int i = 0; i < grid_points; ++i)
                sum += right[std::size_t(k * grid_points + i)] * sample[std::size_t(i)];
            row.push_back(sum);
        }
        numbers.push_back(std::move(row));
    }

    // What the eye sees of each: the hats' own light, and on it the correction that brings pigments closest to what they
    // are; of numbers that are all alike, a grey, it changes nothing.
    for (int step = 0; step < steps; ++step) {
        const double D = step_D(step);
        const std::array<Row, 3> eye = eye_on_grid(D);
        std::array<std::vector<double>, 3> seen;
        for (std::size_t c = 0; c < 3; ++c)
            for (const Row& one : hats)
                seen[c].push_back(dot(eye[c], one));
        if (n > 3) {
            std::vector<double> square(std::size_t(n * n), 0.0), miss(std::size_t(n * 3), 0.0);
            for (std::size_t s = 0; s < samples.size(); ++s) {
                const double bright = dot(eye[1], samples[s]), weight = 1 / std::max(bright * bright, 1e-30);
                double mean = 0;
                for (double value : numbers[s])
                    mean += value / n;
                std::array<double, 3> gap;
                for (std::size_t c = 0; c < 3; ++c)
                    gap[c] = dot(eye[c], samples[s]) - dot(seen[c], numbers[s]);
                for (int k = 0; k < n; ++k) {
                    const double from = numbers[s][std::size_t(k)] - mean;
                    for (int j = 0; j < n; ++j)
                        square[std::size_t(k * n + j)] += weight * from * (numbers[s][std::size_t(j)] - mean);
                    for (std::size_t c = 0; c < 3; ++c)
                        miss[std::size_t(k) * 3 + c] += weight * from * gap[c];
                }
            }
            double trace = 0;
            for (int k = 0; k < n; ++k)
                trace += square[std::size_t(k * n + k)];
            for (int k = 0; k < n; ++k)
                square[std::size_t(k * n + k)] += 1e-4 * trace / n; // the sum of all is not told by differences
            solve(square, n, miss, 3);
            for (std::size_t c = 0; c < 3; ++c) {
                double mean = 0;
                for (int k = 0; k < n; ++k)
                    mean += miss[std::size_t(k) * 3 + c] / n;
                for (int k = 0; k < n; ++k)
                    seen[c][std::size_t(k)] += miss[std::size_t(k) * 3 + c] - mean;
            }
        }
        for (int k = 0; k < n; ++k)
            basis.response.push_back({seen[0][std::size_t(k)], seen[1][std::size_t(k)], seen[2][std::size_t(k)]});
        for (double kelvin : thermal_K)
            basis.response.push_back(seen_xyz(black_body(kelvin), D));
    }
    return basis;
}

std::vector<double> sunlit(const SpectralBasis& basis, const std::function<double(double nm)>& reflectance)
{
    std::vector<double> numbers(std::size_t(basis.size()), 0.0);
    for (int i = 0; i < grid_points; ++i) {
        const double sample = reflectance(grid_nm(i));
        for (int k = 0; k < basis.hats; ++k)
            numbers[std::size_t(k)] += basis.analysis[std::size_t(k * grid_points + i)] * sample;
    }
    return numbers;
}

glm::dvec3 seen_xyz(const SpectralBasis& basis, std::span<const double> numbers, double D)
{
    const double at = (std::log2(D) + response_below) * response_per_octave, inside = std::clamp(at, 0.0, double(steps - 1));
    const int i = std::min(int(inside), steps - 2);
    glm::dvec3 xyz(0);
    for (std::size_t k = 0; k < numbers.size(); ++k)
        xyz += numbers[k]
            * glm::mix(basis.response[std::size_t(i) * numbers.size() + k],
                basis.response[std::size_t(i + 1) * numbers.size() + k], inside - i);
    // Above the table all light is that of the tail that every black body has (Rayleigh and Jeans): as 1 / D^2.
    const double beyond = at > steps - 1 ? std::exp2(response_above) / D : 1;
    return xyz * (beyond * beyond);
}

} // namespace starbow
