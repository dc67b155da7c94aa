#include "colour.h"
#include "cie1931.h"
#include <algorithm>
#include <vector>

namespace starbow {
namespace {

/// The observer at every nanometre: a natural cubic spline through the table. CIE 015 allows it in place of Sprague's
/// interpolation; the two differ by less than 2e-4.
const std::vector<glm::dvec3>& observer()
{
    static const std::vector<glm::dvec3> fine = [] {
        constexpr int n = int(cie1931.size()), parts = int(cie1931_step_nm);
        auto at = [](int i) {
            return glm::dvec3(cie1931[std::size_t(i)][0], cie1931[std::size_t(i)][1], cie1931[std::size_t(i)][2]);
        };
        // Second derivatives in units of the step, zero at the ends: a tridiagonal system with 1, 4, 1 (Thomas' algorithm).
        std::vector<glm::dvec3> second(std::size_t(n), glm::dvec3(0));
        std::vector<double> above(std::size_t(n), 0.0);
        for (int i = 1; i < n - 1; ++i) {
            const double pivot = 4 - above[std::size_t(i - 1)];
            above[std::size_t(i)] = 1 / pivot;
            second[std::size_t(i)] = (6.0 * (at(i - 1) - 2.0 * at(i) + at(i + 1)) - second[std::size_t(i - 1)]) / pivot;
        }
        for (int i = n - 2; i > 0; --i)
            second[std::size_t(i)] -= above[std::size_t(i)] * second[std::size_t(i + 1)];
        std::vector<glm::dvec3> values;
        for (int i = 0; i < n - 1; ++i)
            for (int part = 0; part < parts; ++part) {
                const double b = double(part) / parts, a = 1 - b;
                values.push_back(glm::max(glm::dvec3(0),
                    a * at(i) + b * at(i + 1)
                        + ((a * a * a - a) * second[std::size_t(i)] + (b * b * b - b) * second[std::size_t(i + 1)]) / 6.0));
            }
        values.push_back(at(n - 1));
        return values;
    }();
    return fine;
}

} // namespace

glm::dvec3 xyz_response(double nm)
{
    const double at = nm - cie1931_first_nm;
    if (!(at >= 0) || at > double(observer().size() - 1))
        return glm::dvec3(0);
    const std::size_t i = std::min(std::size_t(at), observer().size() - 2);
    return glm::mix(observer()[i], observer()[i + 1], at - double(i));
}

} // namespace starbow
