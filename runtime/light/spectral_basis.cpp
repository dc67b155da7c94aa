#include "spectral_basis.h"
#include "colour_fit.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// The D of the fits: those at which a picture has colours, three octaves either way, eight rows each.
constexpr int fitted_octaves = 3, fitted_per_octave = 8;

ColourTable fitted_table(std::span<const Spectrum> spectra, const StandardObserver& observer)
{
    return colour_table(spectra, observer, -fitted_octaves, fitted_per_octave, 2 * fitted_octaves * fitted_per_octave + 1);
}

} // namespace

SpectralBasis spectral_basis(
    std::vector<Spectrum> spectra, int most, std::vector<Emission> own, std::vector<double> importance)
{
    const int n = int(spectra.size());
    importance.resize(spectra.size(), 1.0);
    SpectralBasis basis{std::min(n, most), std::move(spectra), std::move(importance), {}, std::move(own)};
    if (n > most)
        basis.columns = fit_columns(
            fitted_table(basis.spectra, eye()), fitted_table(basis.spectra, false_colours()), basis.importance, most);
    else
        for (int i = 0; i < n * n; ++i)
            basis.columns.push_back(i / n == i % n);
    return basis;
}

ColourTable response_table(const SpectralBasis& basis, const StandardObserver& observer, int rows)
{
    double first = -6, last = 10;
    std::vector<EmissionLaw> laws;
    for (const Emission& own : basis.own) {
        const double octaves = laws.emplace_back(law_of(own)).octaves;
        first = std::min(first, -6 - octaves), last = std::max(last, 10 - octaves);
    }
    first = std::floor(first);
    const int per_octave = int(std::floor((rows - 1) / (std::ceil(last) - first)));
    const ColourTable of_spectra = colour_table(basis.spectra, observer, first, per_octave, rows);
    ColourTable table{basis.size(), first, per_octave, {}};
    table.seen.reserve(std::size_t(rows) * std::size_t(basis.size()));
    for (int row = 0; row < rows; ++row) {
        const std::vector<glm::dvec3> fitted = basis.exact()
            ? std::vector<glm::dvec3>(of_spectra.row(row), of_spectra.row(row) + of_spectra.spectra)
            : fit_row(
                {of_spectra.row(row), std::size_t(of_spectra.spectra)}, basis.importance, basis.columns, basis.reflected);
        table.seen.insert(table.seen.end(), fitted.begin(), fitted.end());
        const double D = std::exp2(first + double(row) / per_octave);
        for (const EmissionLaw& own : laws)
            table.seen.push_back(seen(observer, own, D));
    }
    return table;
}

} // namespace starbow
