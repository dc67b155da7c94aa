#include "colour_fit.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Matrix = std::vector<double>; // row by row

/// One sensor's values of all spectra in one row of a table, with their weights.
struct Line {
    std::vector<double> value, weight;
};

/// The variance of a number's rounding to 11 bits, relative to its square, times a factor for the sum of neighbours in
/// filtered pictures.
constexpr double rounding = 1.0 / (1 << 24);
constexpr int rounds = 40;
constexpr double least_part = 1e-4; // of the brightest spectrum: a darker one beside it is black on a screen
constexpr double darkness = 1e-100; // rows below it have no colours, and the squares of their weights would overflow
/// Rows count as one over their octaves from D = 1, plus this: every picture at rest, and a part of every other, has that D.
/// With few coefficients the picture at rest is right, and the others pay for it.
double least_octaves(int count) { return count > 5 ? 0.02 : 0.005; }
constexpr double greatest_coefficient = 0.25; // pre-exposed light of 1 is a quarter of a half's greatest number

/// The three sensors' lines of a row. A weight is one over the sensor's value that makes a just visible difference, up to
/// a common factor; a spectrum below `least_part` of the brightest spectrum's luminance is dark beside the others.
std::array<Line, 3> lines_of(std::span<const glm::dvec3> seen, std::span<const double> importance)
{
    double brightest = 0;
    for (const glm::dvec3& colour : seen)
        brightest = std::max({brightest, colour.x, colour.y, colour.z});
    std::array<Line, 3> lines;
    for (std::size_t j = 0; j < seen.size(); ++j) {
        const glm::dvec3& colour = seen[j];
        const double luminance = std::max({colour.y, 0.1 * std::max(colour.x, colour.z), least_part * brightest});
        for (int c = 0; c < 3; ++c) {
            lines[std::size_t(c)].value.push_back(colour[c]);
            const double part = std::max(colour[c] / luminance, 0.05);
            lines[std::size_t(c)].weight.push_back(
                brightest < darkness ? 0 : importance[j] * std::pow(part, -2.0 / 3) / luminance);
        }
    }
    return lines;
}

/// Solves a x = b in place for a symmetric positive definite a of n x n (Cholesky).
void solve(Matrix& a, int n, double* b)
{
    auto A = [&](int i, int j) -> double& { return a[std::size_t(i * n + j)]; };
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < j; ++k)
            A(j, j) -= A(j, k) * A(j, k);
        A(j, j) = std::sqrt(std::max(A(j, j), 1e-300));
        for (int i = j + 1; i < n; ++i) {
            for (int k = 0; k < j; ++k)
                A(i, j) -= A(i, k) * A(j, k);
            A(i, j) /= A(j, j);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < i; ++k)
            b[i] -= A(i, k) * b[k];
        b[i] /= A(i, i);
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k)
            b[i] -= A(k, i) * b[k];
        b[i] /= A(i, i);
    }
}

/// The normal equations of weighted least squares: sum of (weight (factors . x - value))^2, and of the rounding of each
/// term.
struct Equations {
    int n;
    Matrix square;
    std::vector<double> right;
    explicit Equations(int n)
        : n(n)
        , square(std::size_t(n * n), 0.0)
        , right(std::size_t(n), 0.0)
    {
    }
    void add(const double* factors, double value, double weight)
    {
        const double w = weight * weight;
        for (int k = 0; k < n; ++k) {
            for (int j = 0; j <= k; ++j)
                square[std::size_t(k * n + j)] += w * factors[k] * factors[j];
            square[std::size_t(k * n + k)] += w * rounding * factors[k] * factors[k];
            right[std::size_t(k)] += w * factors[k] * value;
        }
    }
    void solution(double* x)
    {
        double trace = 0;
        for (int k = 0; k < n; ++k)
            trace += square[std::size_t(k * n + k)];
        for (int k = 0; k < n; ++k)
            square[std::size_t(k * n + k)] += 1e-14 * trace;
        std::copy(right.begin(), right.end(), x);
        solve(square, n, x);
    }
};

void fit_line(const Line& line, std::span<const double> columns, int count, double* values)
{
    Equations equations(count);
    for (std::size_t j = 0; j < line.value.size(); ++j)
        equations.add(&columns[j * std::size_t(count)], line.value[j], line.weight[j]);
    equations.solution(values);
}

/// The spectra that differ most from each other: each is the farthest from the span of those before (Gram and Schmidt
/// with pivots) in weighted colours.
std::vector<std::size_t> most_different(const std::vector<Line>& lines, int count)
{
    const std::size_t spectra = lines[0].value.size();
    std::vector<std::vector<double>> rest(spectra);
    for (std::size_t j = 0; j < spectra; ++j)
        for (const Line& line : lines)
            rest[j].push_back(line.value[j] * line.weight[j]);
    auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += a[i] * b[i];
        return sum;
    };
    std::vector<std::size_t> chosen;
    for (int k = 0; k < count; ++k) {
        std::size_t farthest = 0;
        double most = -1;
        for (std::size_t j = 0; j < spectra; ++j)
            if (const double square = dot(rest[j], rest[j]); square > most)
                most = square, farthest = j;
        chosen.push_back(farthest);
        if (most <= 0)
            continue;
        const std::vector<double> unit = rest[farthest];
        for (std::vector<double>& one : rest) {
            const double along = dot(one, unit) / most;
            for (std::size_t i = 0; i < one.size(); ++i)
                one[i] -= along * unit[i];
        }
    }
    return chosen;
}

} // namespace

std::vector<glm::dvec3> fit_row(
    std::span<const glm::dvec3> seen, std::span<const double> importance, std::span<const double> columns, int count)
{
    const std::array<Line, 3> lines = lines_of(seen, importance);
    std::vector<double> values(std::size_t(count), 0.0);
    std::vector<glm::dvec3> row{std::size_t(count), glm::dvec3(0)};
    for (int c = 0; c < 3; ++c) {
        fit_line(lines[std::size_t(c)], columns, count, values.data());
        for (int k = 0; k < count; ++k)
            row[std::size_t(k)][c] = values[std::size_t(k)];
    }
    return row;
}

std::vector<double> fit_columns(
    const ColourTable& first, const ColourTable& second, std::span<const double> importance, int count)
{
    std::vector<Line> lines;
    auto add = [&](const ColourTable& table, double factor) {
        for (int row = 0; row < table.rows(); ++row)
            for (Line line : lines_of({table.row(row), std::size_t(table.spectra)}, importance)) {
                for (double& weight : line.weight)
                    weight
                        *= factor / (least_octaves(count) + std::abs(table.first_log2_D + double(row) / table.per_octave));
                lines.push_back(std::move(line));
            }
    };
    add(first, 1);
    add(second, 0.1);
    const std::size_t spectra = std::size_t(first.spectra), n = std::size_t(count);
    std::vector<std::vector<double>> values(lines.size(), std::vector<double>(n));
    const std::vector<std::size_t> start = most_different(lines, count);
    for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t k = 0; k < n; ++k)
            values[i][k] = lines[i].value[start[k]];
    std::vector<double> columns(spectra * n);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t j = 0; j < spectra; ++j) {
            Equations equations(count);
            for (std::size_t i = 0; i < lines.size(); ++i)
                equations.add(values[i].data(), lines[i].value[j], lines[i].weight[j]);
            equations.solution(&columns[j * n]);
        }
        if (round + 1 < rounds)
            for (std::size_t i = 0; i < lines.size(); ++i)
                fit_line(lines[i], columns, count, values[i].data());
    }
    // Stored coefficients are pre-exposed for light of about 1 and have a greatest number; shifted light grows as D.
    for (std::size_t k = 0; k < n; ++k) {
        double most = 0;
        for (std::size_t j = 0; j < spectra; ++j)
            most = std::max(most, std::abs(columns[j * n + k]));
        for (std::size_t j = 0; j < spectra && most > 0; ++j)
            columns[j * n + k] *= greatest_coefficient / most;
    }
    return columns;
}

} // namespace starbow
