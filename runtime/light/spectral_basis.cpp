#include "spectral_basis.h"
#include "colour.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace starbow {
namespace {

// Samples from 280 to 1250 nm represent a reflectance, which is constant beyond them.
constexpr double grid_from_nm = 280, grid_to_nm = 1250, grid_step = 0.006;
const int grid_points = int(std::log(grid_to_nm / grid_from_nm) / grid_step) + 1;
double grid_nm(int point) { return grid_from_nm * std::exp(grid_step * point); }

// The outermost basis functions' middles. In trials they gave the least errors of colour charts.
constexpr double first_basis_nm = 340, last_basis_nm = 830;

using Row = std::vector<double>;

double dot(const Row& a, const Row& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// The contribution of each sample of a sunlit reflectance to the colour seen at D: nothing but from `first` to before
/// `end`. At most D these are few, because the seen wavelengths lie beyond the grid.
struct ResponseWindow {
    std::array<Row, 3> rows;
    std::size_t first = std::size_t(grid_points), end = 0;
    double of(std::size_t sensor, const Row& samples) const
    {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i)
            sum += rows[sensor][i] * samples[i];
        return sum;
    }
};

ResponseWindow sight_at(const StandardObserver& observer, double D)
{
    static const Spectrum sun = sunlit_white();
    ResponseWindow sight;
    sight.rows.fill(Row(std::size_t(grid_points), 0.0));
    for (const StandardObserver::Sample& s : observer.samples) {
        const double at = std::clamp(std::log(D * s.nm / grid_from_nm) / grid_step, 0.0, double(grid_points - 1));
        const int i = std::min(int(at), grid_points - 2);
        const glm::dvec3 add = s.response * (sun(D * s.nm) * s.width_nm / (s.nm * s.nm));
        for (int c = 0; c < 3; ++c) {
            sight.rows[std::size_t(c)][std::size_t(i)] += add[c] * (1 - (at - i));
            sight.rows[std::size_t(c)][std::size_t(i + 1)] += add[c] * (at - i);
        }
        sight.first = std::min(sight.first, std::size_t(i));
        sight.end = std::max(sight.end, std::size_t(i + 2));
    }
    return sight;
}

double basis_function(int k, int basis_functions, double nm)
{
    const double at = std::clamp(std::log(nm / first_basis_nm) / std::log(last_basis_nm / first_basis_nm), 0.0, 1.0)
        * (basis_functions - 1);
    return std::max(0.0, 1 - std::abs(at - k));
}

/// The reflectance of basis function k.
double shape(int k, int reflected, double nm)
{
    if (reflected > 5)
        return basis_function(k, reflected, nm);
    glm::dvec3 rgb(0);
    if (k < 3)
        rgb[k] = 1;
    const double beyond = reflected == 3 ? 1.0 / 3 : 0; // with three coefficients, the primaries' mean
    return base_reflectance(rgb, k == 3 ? 1 : beyond, k == 4 ? 1 : beyond, nm);
}

std::vector<Row> shapes(int reflected)
{
    std::vector<Row> all{std::size_t(reflected), Row(std::size_t(grid_points), 0.0)};
    for (int k = 0; k < reflected; ++k)
        for (int i = 0; i < grid_points; ++i)
            all[std::size_t(k)][std::size_t(i)] = shape(k, reflected, grid_nm(i));
    return all;
}

/// Solves a x = b for a symmetric positive definite a (Cholesky), for n columns of b at once, row by row.
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

/// Smooth reflectances like pigments': steps and bumps on a level, and other values beyond the visible.
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

const std::vector<Row>& learned()
{
    static const std::vector<Row> samples = pigments(200);
    return samples;
}

/// The coefficients of the primaries: the sunlit colour without the contributions of ultraviolet and infrared, which are
/// means over their own ranges.
Row colours_of_grid(int reflected)
{
    const std::array<Row, 3> seen = sight_at(eye(), 1).rows;
    std::vector<glm::dvec3> colours;
    for (std::size_t i = 0; i < std::size_t(grid_points); ++i)
        colours.push_back(eye().rec709 * glm::dvec3(seen[0][i], seen[1][i], seen[2][i]));
    Row rows(std::size_t(reflected * grid_points), 0.0);
    auto analysis = [&](int k, int i) -> double& { return rows[std::size_t(k * grid_points + i)]; };
    for (int k = 3; k < reflected; ++k) {
        auto inside = [&](int i) { return k == 3 ? grid_nm(i) < 340 : grid_nm(i) > 900; };
        int count = 0;
        for (int i = 0; i < grid_points; ++i)
            count += inside(i);
        for (int i = 0; i < grid_points; ++i)
            analysis(k, i) = inside(i) ? 1.0 / count : 0;
    }
    std::vector<glm::dvec3> of_each;
    for (const Row& shape : shapes(reflected)) {
        of_each.push_back(glm::dvec3(0));
        for (std::size_t i = 0; i < shape.size(); ++i)
            of_each.back() += colours[i] * shape[i];
    }
    const glm::dmat3 back = glm::inverse(glm::dmat3(of_each[0], of_each[1], of_each[2]));
    for (int i = 0; i < grid_points; ++i) {
        glm::dvec3 rest = colours[std::size_t(i)];
        for (int k = 3; k < reflected; ++k)
            rest -= of_each[std::size_t(k)] * analysis(k, i);
        for (int k = 0; k < 3; ++k)
            analysis(k, i) = (back * rest)[k];
    }
    return rows;
}

/// The coefficients of basis functions, fitted so that colours match best at every D from 1/10 to 10. Colours are
/// weighted by their brightness there. The spectra themselves have a small weight, so that every coefficient is
/// determined.
Row learned_coefficients(int n)
{
    const std::vector<Row> basis_functions = shapes(n);
    std::vector<double> normal(std::size_t(n * n), 0.0), right(std::size_t(n * grid_points), 0.0);
    const double sample_weight = 1e-3;
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j)
            normal[std::size_t(k * n + j)]
                += sample_weight * dot(basis_functions[std::size_t(k)], basis_functions[std::size_t(j)]);
        for (int i = 0; i < grid_points; ++i)
            right[std::size_t(k * grid_points + i)] += sample_weight * basis_functions[std::size_t(k)][std::size_t(i)];
    }
    constexpr int steps = 53;
    for (int step = -steps; step <= steps; ++step) {
        const ResponseWindow sight = sight_at(eye(), std::exp(step * std::log(10) / steps));
        double weight = 0;
        for (const Row& sample : learned())
            weight += 1 / std::pow(std::max(sight.of(1, sample), 1e-12), 2);
        weight /= double(learned().size());
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<double> seen;
            for (const Row& one : basis_functions)
                seen.push_back(sight.of(c, one));
            for (int k = 0; k < n; ++k) {
                for (int j = 0; j < n; ++j)
                    normal[std::size_t(k * n + j)] += weight * seen[std::size_t(k)] * seen[std::size_t(j)];
                for (int i = 0; i < grid_points; ++i)
                    right[std::size_t(k * grid_points + i)] += weight * seen[std::size_t(k)] * sight.rows[c][std::size_t(i)];
            }
        }
    }
    solve(normal, n, right, grid_points);
    return right;
}

/// A correction of the basis functions' seen light, [coefficient * 3 + sensor], that minimises the error of pigments.
/// coefficients: those of each pigment; seen: the basis functions' light. A grey has equal coefficients, and the
/// correction leaves it unchanged.
Row correction(const std::vector<Row>& coefficients, const ResponseWindow& sight, const std::array<Row, 3>& seen)
{
    const int n = int(seen[0].size());
    std::vector<double> square(std::size_t(n * n), 0.0), miss(std::size_t(n * 3), 0.0);
    for (std::size_t s = 0; s < learned().size(); ++s) {
        std::array<double, 3> truth;
        for (std::size_t c = 0; c < 3; ++c)
            truth[c] = sight.of(c, learned()[s]);
        const double weight = 1 / std::max(truth[1] * truth[1], 1e-30);
        double mean = 0;
        for (double value : coefficients[s])
            mean += value / n;
        for (int k = 0; k < n; ++k) {
            const double from = coefficients[s][std::size_t(k)] - mean;
            for (int j = 0; j < n; ++j)
                square[std::size_t(k * n + j)] += weight * from * (coefficients[s][std::size_t(j)] - mean);
            for (std::size_t c = 0; c < 3; ++c)
                miss[std::size_t(k) * 3 + c] += weight * from * (truth[c] - dot(seen[c], coefficients[s]));
        }
    }
    double trace = 0;
    for (int k = 0; k < n; ++k)
        trace += square[std::size_t(k * n + k)];
    for (int k = 0; k < n; ++k)
        square[std::size_t(k * n + k)] += 1e-4 * trace / n; // differences alone leave the sum undetermined
    solve(square, n, miss, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        double mean = 0;
        for (int k = 0; k < n; ++k)
            mean += miss[std::size_t(k) * 3 + c] / n;
        for (int k = 0; k < n; ++k)
            miss[std::size_t(k) * 3 + c] -= mean;
    }
    return miss;
}

Row coefficients_of(const SpectralBasis& basis, const std::function<double(double nm)>& reflectance)
{
    Row coefficients(std::size_t(basis.size()), 0.0);
    for (int i = 0; i < grid_points; ++i) {
        const double sample = reflectance(grid_nm(i));
        for (int k = 0; k < basis.reflected; ++k)
            coefficients[std::size_t(k)] += basis.analysis[std::size_t(k * grid_points + i)] * sample;
    }
    return coefficients;
}

} // namespace

SpectralBasis spectral_basis(int reflected, std::span<const EmissionSpectrum> own)
{
    SpectralBasis basis;
    basis.own.assign(own.begin(), own.end());
    basis.reflected = reflected;
    basis.analysis = reflected > 5 ? learned_coefficients(reflected) : colours_of_grid(reflected);
    return basis;
}

std::vector<double> lit(
    const SpectralBasis& basis, const std::optional<Emission>& light, const std::function<double(double nm)>& reflectance)
{
    if (!light)
        return coefficients_of(basis, reflectance);
    auto index_of = [&](const EmissionSpectrum& own) {
        return std::size_t(basis.reflected + (std::find(basis.own.begin(), basis.own.end(), own) - basis.own.begin()));
    };
    Row coefficients(std::size_t(basis.size()), 0.0);
    const double part = sunlit_part(*light);
    if (const auto* line = std::get_if<SpectralLine>(&*light)) {
        coefficients[index_of({*light})] = part * reflectance(line->nm);
        return coefficients;
    }
    // The basis functions are weighted by sunlight, and a lamp's light over the Sun's grows or falls without limit beyond
    // the visible: there they must not contribute.
    const double even = reflectance(shortest_nm);
    const std::size_t infrared = index_of({*light, true});
    const double more = infrared < coefficients.size() ? reflectance(longest_nm) - even : 0;
    const Spectrum spectrum = spectrum_of(*light), sun = sunlit_white();
    coefficients = coefficients_of(basis,
        [&](double nm) { return (reflectance(nm) - even - more * infrared_part(nm)) * part * spectrum(nm) / sun(nm); });
    coefficients[index_of({*light})] += part * even;
    if (more != 0)
        coefficients[infrared] += part * more;
    return coefficients;
}

Emission shifted(const std::optional<Emission>& light, double D)
{
    if (!light)
        return BlackBody{sun_K * D};
    if (const auto* body = std::get_if<BlackBody>(&*light))
        return BlackBody{body->kelvin * D};
    if (const auto* line = std::get_if<SpectralLine>(&*light))
        return SpectralLine{line->nm / D};
    SpectralTable table = std::get<SpectralTable>(*light);
    for (auto& point : table.points)
        point.first /= D;
    return table;
}

std::vector<double> lit_shifted(const SpectralBasis& basis, const std::optional<Emission>& light, double D,
    const std::function<double(double nm)>& reflectance)
{
    const Emission there = shifted(light, D);
    // The amount of `there`, in the unit of emissions, that equals this light: the energy per frequency stays, the width
    // grows as D.
    const double strength = D;
    if (std::find(basis.own.begin(), basis.own.end(), EmissionSpectrum{there}) != basis.own.end()) {
        std::vector<double> coefficients = lit(basis, there, reflectance);
        for (double& coefficient : coefficients)
            coefficient *= strength;
        return coefficients;
    }
    if (std::holds_alternative<SpectralLine>(there))
        throw std::logic_error("a line's light is not among the basis' own");
    const Spectrum spectrum = spectrum_of(there), sun = sunlit_white();
    const double part = strength * sunlit_part(there);
    return coefficients_of(basis, [&](double nm) { return reflectance(nm) * part * spectrum(nm) / sun(nm); });
}

ResponseTable response_table(const SpectralBasis& basis, const StandardObserver& observer, int rows)
{
    double first = -6, last = 10;
    for (const EmissionSpectrum& own : basis.own)
        if (const auto* body = std::get_if<BlackBody>(&own.emission)) {
            const double octaves = std::log2(body->kelvin / sun_K);
            first = std::min(first, -6 - octaves), last = std::max(last, 10 - octaves);
        }
    // D = 1 is a row.
    first = std::floor(first);
    ResponseTable table{basis.size(), first, std::floor((rows - 1) / (std::ceil(last) - first)), {}};
    const int n = basis.reflected;
    const std::vector<Row> reflectances = shapes(n);
    std::vector<Row> coefficients;
    if (n > 5)
        for (const Row& sample : learned()) {
            Row row;
            for (int k = 0; k < n; ++k) {
                double sum = 0;
                for (int i = 0; i < grid_points; ++i)
                    sum += basis.analysis[std::size_t(k * grid_points + i)] * sample[std::size_t(i)];
                row.push_back(sum);
            }
            coefficients.push_back(std::move(row));
        }
    for (int row = 0; row < rows; ++row) {
        const double D = std::exp2(first + row / table.per_octave);
        const ResponseWindow sight = sight_at(observer, D);
        std::array<Row, 3> of_each;
        for (std::size_t c = 0; c < 3; ++c)
            for (const Row& one : reflectances)
                of_each[c].push_back(sight.of(c, one));
        if (n > 5) {
            const Row add = correction(coefficients, sight, of_each);
            for (int k = 0; k < n; ++k)
                for (std::size_t c = 0; c < 3; ++c)
                    of_each[c][std::size_t(k)] += add[std::size_t(k) * 3 + c];
        }
        for (std::size_t k = 0; k < std::size_t(n); ++k)
            table.seen.push_back({of_each[0][k], of_each[1][k], of_each[2][k]});
        for (const EmissionSpectrum& own : basis.own) {
            if (own.infrared)
                table.seen.push_back(seen(
                    observer, [&, all = spectrum_of(own.emission)](double nm) { return infrared_part(nm) * all(nm); }, D));
            else
                table.seen.push_back(seen(observer, own.emission, D));
        }
    }
    return table;
}

} // namespace starbow
