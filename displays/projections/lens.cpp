#include "lens.h"
#include "config/model/turn.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace starbow {
namespace {

/// No picture extends farther from its lens's centre, in halves of its height.
constexpr double farthest = 1e5;

using Polynomial = std::vector<double>; ///< coefficients from the constant one on

double value(const Polynomial& p, double x)
{
    double sum = 0;
    for (auto c = p.rbegin(); c != p.rend(); ++c)
        sum = sum * x + *c;
    return sum;
}

Polynomial product(const Polynomial& a, const Polynomial& b)
{
    Polynomial c(a.size() + b.size() - 1, 0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            c[i + j] += a[i] * b[j];
    return c;
}

/// The places where the polynomial changes its sign between 0 and `end`, in order. The sign changes of its derivative divide
/// the range into pieces with at most one each.
std::vector<double> sign_changes(const Polynomial& p, double end)
{
    if (p.size() < 2)
        return {};
    Polynomial derivative(p.size() - 1);
    for (std::size_t i = 1; i < p.size(); ++i)
        derivative[i - 1] = p[i] * double(i);
    std::vector<double> stops = sign_changes(derivative, end), changes;
    stops.push_back(end);
    double low = 0;
    for (double high : stops) {
        const double stop = high;
        if (const bool rising = value(p, low) < 0; rising != (value(p, high) < 0)) {
            for (double middle; middle = low + (high - low) / 2, middle > low && middle < high;)
                ((value(p, middle) < 0) == rising ? low : high) = middle;
            changes.push_back(low);
        }
        low = stop;
    }
    return changes;
}

double first_sign_change(const Polynomial& p, double end)
{
    const std::vector<double> changes = sign_changes(p, end);
    return changes.empty() ? end : changes.front();
}

/// The greatest r up to which g grows. For vive let s = r² and D = 1 + k0 s + k1 s² + k2 s³. Then g = r / D + k3 r, so that
/// g' = ((1 - k0 s - 3 k1 s² - 5 k2 s³) + k3 D²) / D² up to the first pole of D.
double reach(Lens::Form form, const std::array<double, 4>& k)
{
    if (form == Lens::Form::panotools)
        return k[3] > 0 ? first_sign_change({k[3], 2 * k[2], 3 * k[1], 4 * k[0]}, farthest) : 0;
    const Polynomial D{1, k[0], k[1], k[2]};
    Polynomial slope = product(D, D);
    for (double& c : slope)
        c *= k[3];
    const double inner[]{1, -k[0], -3 * k[1], -5 * k[2]};
    for (int i = 0; i < 4; ++i)
        slope[i] += inner[i];
    if (!(slope[0] > 0))
        return 0;
    const double end = farthest * farthest;
    return std::sqrt(std::min(first_sign_change(D, end), first_sign_change(slope, end)));
}

} // namespace

LensRays::LensRays(const Lens& lens, glm::ivec2 size, int colour)
    : form_(lens.form)
    , k_(lens.colours[colour].k)
    , centre_(lens.colours[colour].centre * glm::dvec2(size))
    , half_height_(size.y * 0.5)
    , reach_(reach(form_, k_))
    , flat_([&] {
        const glm::dmat3 turned = cockpit_from_picture(lens.turn);
        const double edge = std::tan(glm::radians(lens.fov_y_deg) / 2);
        return Plane(-turned[2], turned[0] * edge, turned[1] * -edge, {0, 0});
    }())
{
}

LensRays::Growth LensRays::growth(double r) const
{
    const auto& [k0, k1, k2, k3] = k_;
    if (form_ == Lens::Form::panotools)
        return {((k0 * r + k1) * r + k2) * r + k3, ((4 * k0 * r + 3 * k1) * r + 2 * k2) * r + k3};
    const double s = r * r, D = 1 + s * (k0 + s * (k1 + s * k2));
    return {1 / D + k3, (1 - s * (k0 + s * (3 * k1 + s * 5 * k2))) / (D * D) + k3};
}

std::optional<glm::dvec3> LensRays::direction(glm::dvec2 pixel) const
{
    const glm::dvec2 p = (pixel - centre_) / half_height_;
    const double r = glm::length(p);
    if (!(r < reach_))
        return {};
    return flat_.direction(p * growth(r).f);
}

std::optional<glm::dvec2> LensRays::pixel(const glm::dvec3& direction) const
{
    const auto flat = flat_.pixel(direction);
    if (!flat || !(reach_ > 0))
        return {};
    const double wanted = glm::length(*flat);
    if (wanted == 0)
        return centre_;
    double low = 0, high = std::nextafter(reach_, 0.0);
    const double most = high * growth(high).f;
    if (!(wanted <= most) && std::isfinite(most))
        return {};
    double r = std::clamp(wanted / growth(0).f, low, high);
    for (int i = 0; i < 200; ++i) {
        const Growth at = growth(r);
        const double beyond = r * at.f - wanted;
        if (beyond == 0)
            break;
        (beyond < 0 ? low : high) = r;
        const double next = r - beyond / at.slope;
        const bool close = beyond < wanted; // towards a pole Newton's steps are small although the root is far
        if (close && std::abs(next - r) <= 4e-16 * r)
            break;
        r = close && next > low && next < high ? next : low + (high - low) / 2;
    }
    return centre_ + *flat * (r / wanted * half_height_);
}

double LensRays::pixel_angle(glm::dvec2 pixel) const
{
    const glm::dvec2 p = (pixel - centre_) / half_height_;
    const double r = glm::length(p);
    if (!(r < reach_))
        return 0;
    // A pixel is magnified by f across the radius and by g' along it. The flat picture is at distance 1 / cosine and seen
    // obliquely.
    const Growth at = growth(r);
    const glm::dvec3 seen = flat_.point(p * at.f);
    const double far2 = glm::dot(seen, seen), side = glm::length(flat_.right()) / half_height_;
    return side * std::sqrt(std::max(at.f * at.slope, 0.0) / (far2 * std::sqrt(far2)));
}

} // namespace starbow
