#pragma once
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace starbow {

/// CIE 1976 L*a*b* of XYZ before a white (CIE 015).
inline glm::dvec3 cielab(const glm::dvec3& xyz, const glm::dvec3& white)
{
    auto f = [](double t) {
        constexpr double d = 6.0 / 29;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
    };
    const glm::dvec3 r = xyz / white;
    return {116 * f(r.y) - 16, 500 * (f(r.x) - f(r.y)), 200 * (f(r.y) - f(r.z))};
}

/// CIEDE2000 (ISO/CIE 11664-6), in the form of Sharma, Wu and Dalal, "The CIEDE2000 color-difference formula", Color
/// Research and Application 30 (2005).
inline double ciede2000(const glm::dvec3& one, const glm::dvec3& two)
{
    const double mean_C = 0.5 * (std::hypot(one.y, one.z) + std::hypot(two.y, two.z));
    const double C7 = std::pow(mean_C, 7), G = 0.5 * (1 - std::sqrt(C7 / (C7 + 6103515625.0)));
    const double a1 = (1 + G) * one.y, a2 = (1 + G) * two.y;
    const double C1 = std::hypot(a1, one.z), C2 = std::hypot(a2, two.z);
    auto hue = [&](double a, double b) { return a == 0 && b == 0 ? 0 : std::fmod(std::atan2(b, a) / degree + 360, 360); };
    const double h1 = hue(a1, one.z), h2 = hue(a2, two.z);
    double dh = h2 - h1, mean_h = h1 + h2;
    if (C1 * C2 != 0) {
        if (std::abs(h1 - h2) > 180)
            mean_h += mean_h < 360 ? 360 : -360;
        mean_h *= 0.5;
        dh += dh > 180 ? -360 : dh < -180 ? 360 : 0;
    } else {
        dh = 0;
    }
    const double dL = two.x - one.x, dC = C2 - C1, dH = 2 * std::sqrt(C1 * C2) * std::sin(0.5 * dh * degree);
    const double L = 0.5 * (one.x + two.x), C = 0.5 * (C1 + C2);
    const double T = 1 - 0.17 * std::cos((mean_h - 30) * degree) + 0.24 * std::cos(2 * mean_h * degree)
        + 0.32 * std::cos((3 * mean_h + 6) * degree) - 0.20 * std::cos((4 * mean_h - 63) * degree);
    const double turn = 30 * std::exp(-std::pow((mean_h - 275) / 25, 2)), c7 = std::pow(C, 7);
    const double SL = 1 + 0.015 * (L - 50) * (L - 50) / std::sqrt(20 + (L - 50) * (L - 50)), SC = 1 + 0.045 * C,
                 SH = 1 + 0.015 * C * T, RT = -std::sin(2 * turn * degree) * 2 * std::sqrt(c7 / (c7 + 6103515625.0));
    return std::sqrt(
        std::max(0.0, std::pow(dL / SL, 2) + std::pow(dC / SC, 2) + std::pow(dH / SH, 2) + RT * (dC / SC) * (dH / SH)));
}

} // namespace starbow
