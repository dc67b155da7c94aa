// The formulas of shaders/physics compared with independent relativity: double with boosts in 33 digits (quad.h), float with
// double, and both with published and hand-calculated numbers.
#include "config/model/angles.h"
#include "shaders/physics/physics.h"
#include "tests/support/quad.h"
#include "tests/support/speeds.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace physics_test {

namespace {

using starbow::pi, starbow::degree;

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::vec3;
namespace pd = starbow::physics_double;
namespace pf = starbow::physics_float;

// One rounding. A bound of "k roundings" counts the operations between input and result.
constexpr double round_double = 0x1p-53;
constexpr double round_float = 0x1p-24;

const std::vector<double> gammas = {1, 1 + 1e-7, 2, 4, 10, 1e2, 1e3, 1e4, 1e6};

using starbow::testing::u_of_beta, starbow::testing::u_of_gamma;
double E_of_gamma(double gamma) { return pd::exp_rapidity(u_of_gamma(gamma)); }

dvec3 at(double theta, double phi = 0) // radians from the motion
{
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
double angle_from_motion(const dvec3& n) { return std::atan2(std::hypot(n.x, n.y), n.z); }

pd::AberratedRay world(const dvec3& n, double beta)
{
    const double E = pd::exp_rapidity(u_of_beta(beta));
    return pd::world_from_camera(n, E, 1 / E);
}
pd::AberratedRay camera(const dvec3& n, double beta)
{
    const double E = pd::exp_rapidity(u_of_beta(beta));
    return pd::camera_from_world(n, E, 1 / E);
}
double camera_angle(double theta_w_deg, double beta)
{
    return angle_from_motion(camera(at(theta_w_deg * degree), beta).n) / degree;
}
double world_angle(double theta_c_deg, double beta)
{
    return angle_from_motion(world(at(theta_c_deg * degree), beta).n) / degree;
}

// A table's number differs from the truth by at most half of its last digit.
constexpr double half_1e5 = 0.5e-5, half_1e6 = 0.5e-6, half_1e7 = 0.5e-7;

// Directions everywhere: logarithmically close to both poles (down to `closest` radians), the poles, the axes, and the seam
// z = +-0 between the two half-angle branches.
std::vector<dvec3> directions(int count, double closest)
{
    std::vector<dvec3> list = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 0, -0.0},
        {0, -1, -0.0}, {0.6, 0.8, 0}, {0.6, 0.8, -0.0}, {0.6, -0.8, 1e-9}, {0.6, -0.8, -1e-9}, {-0.0, -0.0, -1}};
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> one(0, 1);
    for (int i = 0; i < count; ++i) {
        const double phi = 2 * pi * one(random);
        const double z = 2 * one(random) - 1;
        const double across = std::sqrt((1 - z) * (1 + z));
        list.push_back({across * std::cos(phi), across * std::sin(phi), z});
        dvec3 n = at(std::pow(closest, one(random)), phi);
        n.z = i % 2 ? n.z : -n.z;
        list.push_back(n);
    }
    return list;
}

struct Worst {
    double direction = 0, D = 0, length = 0;
    bool finite = true;
};
bool finite(const dvec3& n, double D)
{
    return std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z) && std::isfinite(D);
}

void report(const char* what, double gamma, const Worst& w)
{
    std::printf("  %-34s gamma-1 %8.1e  direction %.2e  D %.2e  length %.2e\n", what, gamma - 1, w.direction, w.D, w.length);
}

// ---------------------------------------------------------------- double compared with 33 digits

// The roundings of a direction or a D: E and 1/E 4, the input's length 2, the half angle 4, A or B 1, their sum 1, the
// quotient 1, the product 1.
constexpr double ray_double = 14 * round_double;

TEST(AberratedRay, WorldFromCameraInDoubleAgreesWithLorentzBoost)
{
    auto list = gammas;
    list.push_back(1e9);
    for (double gamma : list) {
        const double u = u_of_gamma(gamma), E = pd::exp_rapidity(u);
        Worst worst;
        for (const dvec3& n : directions(20000, 1e-18)) {
            const auto got = pd::world_from_camera(n, E, 1 / E);
            const auto expected = quad::world_from_camera(quad::of(n), {0, 0, u});
            worst.finite &= finite(got.n, got.D);
            worst.direction = std::max(worst.direction, quad::angle(quad::of(got.n), expected.n) / got.D);
            worst.D = std::max(worst.D, double(fabsq(got.D / expected.D - 1)));
            worst.length = std::max(worst.length, double(fabsq(quad::length(quad::of(got.n)) - 1)));
        }
        report("double-quad world_from_camera", gamma, worst);
        EXPECT_TRUE(worst.finite) << gamma;
        EXPECT_LE(worst.direction, ray_double) << gamma;
        EXPECT_LE(worst.D, ray_double) << gamma;
        EXPECT_LE(worst.length, ray_double) << gamma;
    }
}

TEST(AberratedRay, CameraFromWorldInDoubleAgreesWithLorentzBoost)
{
    auto list = gammas;
    list.push_back(1e9);
    for (double gamma : list) {
        const double u = u_of_gamma(gamma), E = pd::exp_rapidity(u);
        Worst worst;
        for (const dvec3& n : directions(20000, 1e-18)) {
            const auto got = pd::camera_from_world(n, E, 1 / E);
            const auto expected = quad::camera_from_world(quad::of(n), {0, 0, u});
            worst.finite &= finite(got.n, got.D);
            // The result is a camera direction, so that its error counts as it is.
            worst.direction = std::max(worst.direction, quad::angle(quad::of(got.n), expected.n));
            worst.D = std::max(worst.D, double(fabsq(got.D / expected.D - 1)));
            worst.length = std::max(worst.length, double(fabsq(quad::length(quad::of(got.n)) - 1)));
        }
        report("double-quad camera_from_world", gamma, worst);
        EXPECT_TRUE(worst.finite) << gamma;
        EXPECT_LE(worst.direction, ray_double) << gamma;
        EXPECT_LE(worst.D, ray_double) << gamma;
        EXPECT_LE(worst.length, ray_double) << gamma;
    }
}

// ---------------------------------------------------------------- float compared with double

constexpr double ray_float = 1e-6; // required; the 14 roundings of a float make 8e-7

// The expected value for a float direction is the double formula, and the boost in 33 digits, of the same numbers. E is
// computed in double and passed as float, as for the shader.
TEST(AberratedRay, FloatAgreesWithDoubleAtEveryGamma)
{
    for (double gamma : gammas) {
        const double u = u_of_gamma(gamma), E = E_of_gamma(gamma);
        const float E_float = float(E), inverse_E_float = float(1 / E);
        Worst to_world, to_camera, of_boost;
        for (const dvec3& drawn : directions(50000, 1e-18)) {
            const vec3 n(drawn);
            const auto got = pf::world_from_camera(n, E_float, inverse_E_float);
            const auto expected = pd::world_from_camera(dvec3(n), E, 1 / E);
            to_world.finite &= finite(got.n, got.D);
            to_world.direction
                = std::max(to_world.direction, quad::angle(quad::of(got.n), quad::of(expected.n)) / expected.D);
            to_world.D = std::max(to_world.D, std::abs(got.D / expected.D - 1));
            to_world.length = std::max(to_world.length, std::abs(glm::length(dvec3(got.n)) - 1));

            const auto boost = quad::world_from_camera(quad::of(n), {0, 0, u});
            of_boost.direction = std::max(of_boost.direction, quad::angle(quad::of(got.n), boost.n) / expected.D);
            of_boost.D = std::max(of_boost.D, double(fabsq(got.D / boost.D - 1)));

            const auto got_back = pf::camera_from_world(n, E_float, inverse_E_float);
            const auto expected_back = pd::camera_from_world(dvec3(n), E, 1 / E);
            to_camera.finite &= finite(got_back.n, got_back.D);
            to_camera.direction
                = std::max(to_camera.direction, quad::angle(quad::of(got_back.n), quad::of(expected_back.n)));
            to_camera.D = std::max(to_camera.D, std::abs(got_back.D / expected_back.D - 1));
            to_camera.length = std::max(to_camera.length, std::abs(glm::length(dvec3(got_back.n)) - 1));
        }
        report("float-double world_from_camera", gamma, to_world);
        report("float-double camera_from_world", gamma, to_camera);
        report("float-quad   world_from_camera", gamma, of_boost);
        for (const Worst& worst : {to_world, to_camera, of_boost}) {
            EXPECT_TRUE(worst.finite) << gamma;
            EXPECT_LE(worst.direction, ray_float) << gamma;
            EXPECT_LE(worst.D, ray_float) << gamma;
            EXPECT_LE(worst.length, ray_float) << gamma;
        }
    }
}

TEST(AberratedRay, FloatThereAndBackReturnsTheDirection)
{
    for (double gamma : gammas) {
        const double E = E_of_gamma(gamma);
        const float E_float = float(E), inverse_E_float = float(1 / E);
        Worst worst;
        for (const dvec3& drawn : directions(50000, 1e-18)) {
            const vec3 n(drawn);
            const auto there = pf::world_from_camera(n, E_float, inverse_E_float);
            const auto back = pf::camera_from_world(there.n, E_float, inverse_E_float);
            worst.finite &= finite(back.n, back.D);
            worst.direction = std::max(worst.direction, quad::angle(quad::of(back.n), quad::of(n)));
            worst.D = std::max(worst.D, std::abs(double(back.D) / there.D - 1));
        }
        report("float there and back", gamma, worst);
        EXPECT_TRUE(worst.finite);
        EXPECT_LE(worst.direction, 2 * ray_float) << gamma; // two transformations
        EXPECT_LE(worst.D, 2 * ray_float) << gamma;
    }
}

TEST(AberratedRay, DoubleThereAndBackReturnsTheDirectionBothWays)
{
    auto list = gammas;
    list.push_back(1e9);
    for (double gamma : list) {
        const double E = E_of_gamma(gamma);
        double from_camera = 0, from_world = 0;
        for (const dvec3& n : directions(20000, 1e-18)) {
            const auto there = pd::world_from_camera(n, E, 1 / E);
            const auto back = pd::camera_from_world(there.n, E, 1 / E);
            from_camera = std::max(from_camera, quad::angle(quad::of(back.n), quad::of(n)));
            const auto seen = pd::camera_from_world(n, E, 1 / E);
            const auto again = pd::world_from_camera(seen.n, E, 1 / E);
            from_world = std::max(from_world, quad::angle(quad::of(again.n), quad::of(n)) / seen.D);
        }
        EXPECT_LE(from_camera, 2 * ray_double) << gamma;
        EXPECT_LE(from_world, 2 * ray_double) << gamma;
    }
}

template <class Vec, class Real, class Transform> void expect_identity(Transform transform)
{
    std::mt19937_64 random(2);
    std::uniform_real_distribution<Real> one(-1, 1);
    for (int i = 0; i < 100000; ++i) {
        Vec n(one(random), one(random), one(random)); // of any length: no operation may change it
        if (i % 7 == 0)
            n[i % 3] = Real(-0.0);
        if (i % 11 == 0)
            n[i % 3] = std::numeric_limits<Real>::denorm_min();
        const auto ray = transform(n);
        ASSERT_EQ(std::memcmp(&ray.n, &n, sizeof n), 0) << n.x << ' ' << n.y << ' ' << n.z;
        ASSERT_EQ(ray.D, Real(1));
    }
}

TEST(AberratedRay, AtRestIsTheIdentityToTheBit)
{
    ASSERT_EQ(pd::exp_rapidity(0.0), 1.0);
    ASSERT_EQ(pf::exp_rapidity(0.0f), 1.0f);
    expect_identity<vec3, float>([](const vec3& n) { return pf::world_from_camera(n, 1, 1); });
    expect_identity<vec3, float>([](const vec3& n) { return pf::camera_from_world(n, 1, 1); });
    expect_identity<dvec3, double>([](const dvec3& n) { return pd::world_from_camera(n, 1, 1); });
    expect_identity<dvec3, double>([](const dvec3& n) { return pd::camera_from_world(n, 1, 1); });
}

// Leaving rest makes no jump: the first float E above 1 moves directions by no more than its last bit.
TEST(AberratedRay, LeavingRestIsSmooth)
{
    const float E = std::nextafter(1.0f, 2.0f);
    for (const dvec3& drawn : directions(20000, 1e-12)) {
        const vec3 n(drawn);
        const auto ray = pf::world_from_camera(n, E, 1 / E);
        EXPECT_LE(quad::angle(quad::of(ray.n), quad::of(n)), 8 * round_float);
        EXPECT_NEAR(ray.D, 1, 8 * round_float);
    }
}

TEST(AberratedRay, DenormalComponentsAndExtremeGammasStayFinite)
{
    const float f = std::numeric_limits<float>::denorm_min();
    const double d = std::numeric_limits<double>::denorm_min();
    for (double gamma : {1.0, 1 + 1e-7, 2.0, 1e3, 1e6, 1e9}) {
        const double E = E_of_gamma(gamma);
        for (double z : {1.0, -1.0})
            for (double size : {d, 1e-310, 1e-200, double(f), 1e-40, 1e-30}) {
                const dvec3 n(size, -size, z);
                for (const auto& ray : {pd::world_from_camera(n, E, 1 / E), pd::camera_from_world(n, E, 1 / E)}) {
                    EXPECT_TRUE(finite(ray.n, ray.D));
                    EXPECT_NEAR(glm::length(ray.n), 1, ray_double);
                    EXPECT_NEAR(ray.n.z, z, 4 * round_double); // a direction this close to a pole stays there
                }
                const vec3 n_float(n);
                for (const auto& ray : {pf::world_from_camera(n_float, float(E), float(1 / E)),
                         pf::camera_from_world(n_float, float(E), float(1 / E))}) {
                    EXPECT_TRUE(finite(ray.n, ray.D));
                    EXPECT_NEAR(glm::length(dvec3(ray.n)), 1, ray_float);
                    EXPECT_NEAR(ray.n.z, z, ray_float);
                }
            }
    }
}

TEST(AberratedRay, PlusAndMinusZeroOfZAreOneDirection)
{
    for (double gamma : gammas) {
        const double E = E_of_gamma(gamma);
        const auto plus = pd::world_from_camera({0.6, 0.8, 0.0}, E, 1 / E);
        const auto minus = pd::world_from_camera({0.6, 0.8, -0.0}, E, 1 / E);
        EXPECT_EQ(plus.n, minus.n);
        EXPECT_EQ(plus.D, minus.D);
    }
}

// In (ln tan(theta/2), azimuth) a boost is a translation by the rapidity, all over the sky.
TEST(AberratedRay, BoostShiftsLogTanHalfAngleByTheRapidity)
{
    for (double eta : {0.1, 1.0, 5.0, 14.5}) {
        const double E = std::exp(eta);
        for (double s = -20; s <= 20; s += 0.5) {
            const dvec3 n(std::cos(2.0) / std::cosh(s), std::sin(2.0) / std::cosh(s), -std::tanh(s)); // ln tan(theta/2) = s
            const auto ray = pd::world_from_camera(n, E, 1 / E);
            const double across = std::hypot(ray.n.x, ray.n.y);
            // Near a pole 1 - |z| loses digits that `across` still has.
            const double shifted = ray.n.z > 0 ? std::log(across / (1 + ray.n.z)) : -std::log(across / (1 - ray.n.z));
            EXPECT_NEAR(shifted - s, eta, 1e-14) << s; // logarithms up to 35 with 53 bits
            EXPECT_NEAR(std::atan2(ray.n.y, ray.n.x), 2.0, 4 * round_double);
        }
    }
}

// ---------------------------------------------------------------- the table of numbers

TEST(Numbers, AberrationHasItsTabulatedValues)
{
    const double b4 = std::sqrt(15.0) / 4;
    const struct {
        double beta, world, camera, half_digit;
    } table[] = {{.5, 90, 60, 1e-12}, {.5, 120, 90, 1e-12}, {.8, 120, 60, 1e-12}, {.9, 60, 15.09019, half_1e5},
        {.9, 90, 25.84193, half_1e5}, {.9, 150, 81.13969, half_1e5}, {b4, 90, 14.47751, half_1e5},
        {b4, 150, 50.72495, half_1e5}, {.99, 90, 8.10961, half_1e5}, {.999, 90, 2.56256, half_1e5}};
    for (const auto& row : table) {
        EXPECT_NEAR(camera_angle(row.world, row.beta), row.camera, row.half_digit) << row.beta << ' ' << row.world;
        EXPECT_NEAR(camera_angle(world_angle(row.camera, row.beta), row.beta), row.camera, 1e-12);
        // the textbook's cos theta_c = (cos theta_w + b) / (1 + b cos theta_w)
        const double cosine = std::cos(row.world * degree);
        EXPECT_NEAR(
            camera_angle(row.world, row.beta), std::acos((cosine + row.beta) / (1 + row.beta * cosine)) / degree, 1e-11);
    }
}

TEST(Numbers, DopplerFactorsHaveTheirTabulatedValues)
{
    const double b4 = std::sqrt(15.0) / 4;
    const struct {
        double beta, ahead, half_digit;
    } table[]
        = {{.6, 2, 1e-14}, {.8, 3, 1e-14}, {.9, 4.358899, half_1e6}, {b4, 7.872983, half_1e6}, {.99, 14.106736, half_1e6}};
    for (const auto& row : table) {
        EXPECT_NEAR(world({0, 0, 1}, row.beta).D, row.ahead, row.half_digit);
        EXPECT_NEAR(camera({0, 0, 1}, row.beta).D, row.ahead, row.half_digit);
        EXPECT_NEAR(world({0, 0, -1}, row.beta).D * world({0, 0, 1}, row.beta).D, 1, 8 * round_double);
    }
    EXPECT_NEAR(world({0, 0, 1}, b4).D, 4 + std::sqrt(15.0), 1e-14);
    EXPECT_NEAR(world({1, 0, 0}, .5).D, .8660254, half_1e7);
    EXPECT_NEAR(world({1, 0, 0}, .6).D, .8, 8 * round_double);
    EXPECT_NEAR(world({0, 1, 0}, b4).D, .25, 8 * round_double);
    EXPECT_NEAR(camera({1, 0, 0}, .6).D, 1.25, 8 * round_double); // gamma (1 + b cos theta_w)
}

TEST(Numbers, UnshiftedAngleHasItsTabulatedValues)
{
    const double b4 = std::sqrt(15.0) / 4;
    const struct {
        double beta, angle;
    } table[] = {{.1, 87.12681}, {.25, 82.70277}, {.5, 74.45773}, {.8, 60}, {.9, 51.18638}, {b4, 39.23152}, {.99, 29.81806}};
    for (const auto& row : table) {
        const double E = pd::exp_rapidity(u_of_beta(row.beta));
        const double angle = std::acos(pd::unshifted_cosine(E)) / degree;
        EXPECT_NEAR(angle, row.angle, half_1e5) << row.beta;
        EXPECT_NEAR(world(at(angle * degree), row.beta).D, 1, 1e-14);
        EXPECT_NEAR(world_angle(angle, row.beta), 180 - angle, 1e-12);
    }
    EXPECT_EQ(pd::unshifted_cosine(1.0), 0); // 90 degrees at rest
}

// Small circles show the magnification 1/D. 1e-5 rad is small enough for 1e-10, and large compared with 1e-16.
TEST(Numbers, SizeStraightAheadIsOneOverD)
{
    const struct {
        double beta, size;
    } table[] = {{.1, .9045340}, {.5, .5773503}, {std::sqrt(15.0) / 4, .1270167}};
    for (const auto& row : table)
        EXPECT_NEAR(angle_from_motion(camera(at(1e-5), row.beta).n) / 1e-5, row.size, half_1e7);
}

TEST(Numbers, ASphereSeenHeadOnHasTheTabulatedRadius)
{
    const double b4 = std::sqrt(15.0) / 4;
    EXPECT_NEAR(camera_angle(30, .5), 17.58795, half_1e5);
    EXPECT_NEAR(camera_angle(30, .9), 7.03529, half_1e5);
    EXPECT_NEAR(180 - camera_angle(150, .5), 49.79218, half_1e5);
    EXPECT_NEAR(180 - camera_angle(150, .9), 98.86031, half_1e5);
    EXPECT_NEAR(camera_angle(10, b4), 1.27335, half_1e5);
    EXPECT_NEAR(180 - camera_angle(170, b4), 69.11789, half_1e5);
}

struct Circle {
    double centre_deg, radius_deg, residual;
};

// Fits a circle to the camera's image of a world circle: a circle on a sphere is a plane cut.
template <class Real, class Transform> Circle seen_circle(double centre, double radius, Transform transform)
{
    using Vec = glm::vec<3, Real>;
    std::vector<dvec3> seen;
    for (int i = 0; i < 360; ++i) {
        const double a = i * degree;
        const dvec3 axis = at(centre), up(std::cos(centre), 0, -std::sin(centre)), side(0, 1, 0);
        const Vec edge(axis * std::cos(radius) + (up * std::cos(a) + side * std::sin(a)) * std::sin(radius));
        seen.push_back(glm::normalize(dvec3(transform(edge))));
    }
    glm::dmat3 squares(0);
    dvec3 sum(0);
    for (const dvec3& n : seen) {
        squares += glm::outerProduct(n, n);
        sum += n;
    }
    const dvec3 plane = glm::inverse(squares) * sum; // least squares of dot(plane, n) = 1
    const dvec3 pole = glm::normalize(plane);
    const double size = std::acos(1 / glm::length(plane));
    double residual = 0;
    for (const dvec3& n : seen)
        residual = std::max(residual, std::abs(std::acos(glm::dot(pole, n)) - size));
    return {angle_from_motion(pole) / degree, size / degree, residual};
}

TEST(Numbers, CirclesStayCircles)
{
    const double E = pd::exp_rapidity(u_of_beta(.9));
    const auto in_double
        = seen_circle<double>(90 * degree, 20 * degree, [&](dvec3 n) { return pd::camera_from_world(n, E, 1 / E).n; });
    EXPECT_NEAR(in_double.centre_deg, 27.26680, half_1e5);
    EXPECT_NEAR(in_double.radius_deg, 9.01490, half_1e5);
    EXPECT_LE(in_double.residual, 1e-12); // inverting the 3 x 3 matrix of so small a circle loses two digits
    const auto in_float = seen_circle<float>(
        90 * degree, 20 * degree, [&](vec3 n) { return pf::camera_from_world(n, float(E), float(1 / E)).n; });
    EXPECT_NEAR(in_float.centre_deg, 27.26680, 1e-6 / degree);
    EXPECT_NEAR(in_float.radius_deg, 9.01490, 1e-6 / degree);
    EXPECT_LE(in_float.residual, 1e-6);
}

// The mean of f(D) over the camera's sky. z = tanh s: the trapezoid rule in s converges faster than any power, and a step of
// 1/64 is far beyond double. Beyond |s| = 40 the sky is below 1e-34.
double sky_mean(double gamma, const std::function<double(double)>& f)
{
    const double E = E_of_gamma(gamma), h = 1.0 / 64;
    double sum = 0;
    for (int i = -40 * 64; i <= 40 * 64; ++i) {
        const double s = i * h, across = 1 / std::cosh(s);
        sum += across * across * f(pd::world_from_camera({across, 0, std::tanh(s)}, E, 1 / E).D);
    }
    return 0.5 * sum * h;
}

TEST(Numbers, MeansOverTheCamerasSkyHaveClosedForms)
{
    const struct {
        double gamma, fourth;
    } table[] = {{2, 5}, {4, 21}, {10, 133}};
    for (const auto& row : table) {
        const double g = row.gamma, b2 = 1 - 1 / (g * g);
        EXPECT_NEAR(sky_mean(g, [](double) { return 1; }), 1, 1e-13);
        EXPECT_NEAR(sky_mean(g, [](double D) { return D * D; }), 1, 1e-13);
        EXPECT_NEAR(sky_mean(g, [](double D) { return pd::headlight(D); }) / g, 1, 1e-13);
        EXPECT_NEAR(sky_mean(g, [](double D) { return D * D * D * D; }) / (g * g * (1 + b2 / 3)), 1, 1e-13);
        EXPECT_NEAR(sky_mean(g, [](double D) { return D * D * D * D; }) / row.fourth, 1, 1e-13);
    }
}

// The fraction of the world's sky that appears in the camera's front half: D^2 transforms solid angle from the camera's sky
// to the world's. Simpson's rule over [0, 20] in 20000 steps is beyond double for this smooth function; the rest is below
// 1e-16.
TEST(Numbers, IsotropicSkyCrowdsIntoTheFrontHalf)
{
    const struct {
        double gamma, share;
    } table[] = {{2, .9330127}, {4, .9841229}, {10, .9974937}};
    for (const auto& row : table) {
        const double E = E_of_gamma(row.gamma), h = 1e-3;
        double sum = 0;
        for (int i = 0; i <= 20000; ++i) {
            const double s = i * h, across = 1 / std::cosh(s);
            const double D = pd::world_from_camera({0, across, std::tanh(s)}, E, 1 / E).D;
            sum += (i == 0 || i == 20000 ? 1 : i % 2 ? 4 : 2) * across * across * D * D;
        }
        EXPECT_NEAR(0.5 * sum * h / 3, row.share, half_1e7);
        const double cap = pd::world_from_camera({1, 0, 0}, E, 1 / E).n.z; // the edge of that half is a circle in the world
        EXPECT_NEAR(0.5 * (1 - cap), row.share, half_1e7);
    }
}

TEST(Numbers, HeadlightSpansTheStopsOfTheTable)
{
    for (const auto& [gamma, stops] : {std::pair{4.0, 18}, {10.0, 26}, {100.0, 46}}) {
        const double E = E_of_gamma(gamma);
        const double ahead = pd::headlight(pd::world_from_camera({0, 0, 1}, E, 1 / E).D);
        const double behind = pd::headlight(pd::world_from_camera({0, 0, -1}, E, 1 / E).D);
        EXPECT_EQ(std::lround(std::log2(ahead / behind)), stops);
    }
    const double E = E_of_gamma(20.5); // half precision ends at 65504: above gamma 20 it can't hold the gain
    EXPECT_GT(pd::headlight(pd::world_from_camera({0, 0, 1}, E, 1 / E).D), 65504);
    EXPECT_LT(pd::headlight(pd::world_from_camera({0, 0, 1}, E_of_gamma(20), 1 / E_of_gamma(20)).D), 65504);
    EXPECT_EQ(pf::headlight(3.0f), 27.0f);
}

TEST(Numbers, GammaFourShiftsToTheTabulatedWavelengths)
{
    const double E = E_of_gamma(4);
    const double ahead = pd::world_from_camera({0, 0, 1}, E, 1 / E).D,
                 behind = pd::world_from_camera({0, 0, -1}, E, 1 / E).D;
    EXPECT_NEAR(380 * behind, 48, 0.5); // wavelength in nm that is seen at 380 nm behind
    EXPECT_NEAR(0.78 * ahead, 6.1, 0.05); // um, seen at 780 nm ahead
    EXPECT_NEAR(288 * ahead, 2267, 0.5); // K
}

// The camera's rear half is the cone of acos(b) about the rear axis. D varies by at most a factor of 2 in it.
TEST(Numbers, RearHalfIsOneNarrowCone)
{
    for (double gamma : {2.0, 4.0, 100.0, 1e6}) {
        const double E = E_of_gamma(gamma);
        const auto edge = pd::world_from_camera({1, 0, 0}, E, 1 / E), rear = pd::world_from_camera({0, 0, -1}, E, 1 / E);
        const double half_angle = std::atan2(std::hypot(edge.n.x, edge.n.y), -edge.n.z);
        EXPECT_NEAR(half_angle * gamma, std::asin(1 / gamma) * gamma, 1e-14 * gamma); // acos(b) = asin(1/gamma)
        EXPECT_LE(edge.D / rear.D, 2 * (1 + 4 * round_double));
    }
}

TEST(Numbers, ASmallBodySeenAbeamAppearsRotated)
{
    for (const auto& [beta, turn] : {std::pair{.5, 30.0}, {.8, 53.1301}, {.99, 81.8904}})
        EXPECT_NEAR(world_angle(90, beta) - 90, turn, 0.5e-4); // the body shows the face that the world's direction meets
}

// A body passes at the distance L with b. In its own frame, the light left from abeam a time L before. A boost by the body's
// u gives the event in the observer's frame. "Behind" is against the body's motion, which is along the observer's own motion
// in the body's frame: the z axis of these formulas.
TEST(Numbers, APassingBodyHasTheTextbooksValues)
{
    const double L = 3;
    for (double beta : {.3, .5, .9, .999}) {
        const double u = u_of_beta(beta), gamma = std::sqrt(1 + u * u);
        const dvec3 body_u(0, 0, -u);
        const double t = pd::world_time(body_u, -L, {L, 0, 0});
        const dvec3 place = pd::world_place(body_u, -L, {L, 0, 0});
        EXPECT_NEAR(t / (-gamma * L), 1, 8 * round_double);
        EXPECT_NEAR(std::atan2(place.z, place.x), std::atan(gamma * beta), 8 * round_double);
        EXPECT_NEAR(glm::length(place), -t, 1e-14 * gamma * L); // on the light cone
        EXPECT_NEAR(place.z - -beta * t, 0, 1e-14 * gamma * L); // it flies on and is abeam at time 0

        const auto seen = camera(at(90 * degree), beta);
        EXPECT_NEAR(angle_from_motion(seen.n), angle_from_motion(place), 1e-14);
        EXPECT_NEAR(seen.D / gamma, 1, 8 * round_double);
        EXPECT_NEAR(world(at(90 * degree), beta).D * gamma, 1, 8 * round_double); // when it is seen abeam

        // Apparent speed along the line of sight: the distance b gamma for each tick of the body, whose ticks appear D times
        // as fast.
        EXPECT_NEAR(beta * gamma * world({0, 0, 1}, beta).D / (beta / (1 - beta)), 1, 1e-12); // 1 - b loses 3 digits at .999
        EXPECT_NEAR(beta * gamma * world({0, 0, -1}, beta).D / (beta / (1 + beta)), 1, 1e-12);
    }
}

// Five clocks in a row along the motion, 5 apart and 31 away. The camera sees the middle one at 90 degrees.
TEST(Numbers, ClocksHaveThePapersReadings)
{
    const double away = 31, apart = 5, beta = .5;
    const double delays_at_rest[] = {32.57299, 31.40064, 31, 31.40064, 32.57299};
    const double readings[] = {-5.90909, -2.74403, 0, 2.21961, 3.80547};
    const double seen[] = {-14.70466, -7.69614, 0, 8.24497, 16.78385}; // from the perpendicular, positive ahead
    const double stopped[] = {131.985, 126.451, 120, 112.590, 104.293}; // from the motion

    // The world's direction of the middle clock and the row's distance determine the camera's place, and with it the light
    // cone.
    const dvec3 centre = world(at(90 * degree), beta).n;
    const double to_centre = away / centre.x;
    EXPECT_NEAR(to_centre, 35.79572, half_1e5);
    EXPECT_NEAR(angle_from_motion(centre) / degree, 120, 1e-12);
    double first_tangent = 0, last_tangent = 0;
    for (int k = -2; k <= 2; ++k) {
        EXPECT_NEAR(std::hypot(away, apart * k), delays_at_rest[k + 2], half_1e5);

        const dvec3 clock(away, 0, centre.z * to_centre + apart * k);
        EXPECT_NEAR(to_centre - glm::length(clock), readings[k + 2], half_1e5);
        EXPECT_NEAR(angle_from_motion(clock) / degree, stopped[k + 2], 0.5e-3); // after an immediate stop

        const double angle = angle_from_motion(camera(glm::normalize(clock), beta).n);
        EXPECT_NEAR(90 - angle / degree, seen[k + 2], half_1e5);
        (k == -2 ? first_tangent : last_tangent) = std::tan(90 * degree - angle);

        // Backwards: from the angle seen, along the world's line of sight, to the clock and its reading.
        const dvec3 back = world(at((90 - seen[k + 2]) * degree), beta).n;
        const double delay = away / back.x;
        EXPECT_NEAR(delay * back.z - centre.z * to_centre, apart * k, 2e-5); // seen[] is printed to 1e-7 rad, times 45
        EXPECT_NEAR(to_centre - delay, readings[k + 2], 2e-5);
    }
    EXPECT_NEAR(away * (last_tangent - first_tangent), 17.4853, 0.5e-4);
    EXPECT_NEAR(readings[4] - readings[0], 9.71455, 1.5e-5);
}

TEST(Numbers, RainbowHasThePapersWavelengths)
{
    EXPECT_NEAR(450 / world(at(90 * degree), .5).D, 520, 0.5);
    EXPECT_NEAR(450 / world(at(105.5 * degree), .5).D, 589, 0.5);
    EXPECT_NEAR(450 / world(at(120 * degree), .5).D, 650, 0.5);
    EXPECT_LT(world(at((90 - 15.53) * degree), .5).D, 1);
    EXPECT_GT(world(at((90 - 15.55) * degree), .5).D, 1);
}

// ---------------------------------------------------------------- boosts

std::vector<dvec3> velocities(int count, double most)
{
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> one(0, 1);
    std::vector<dvec3> list = {{0, 0, 0}, {0, 0, most}, {-most, 0, 0}, {0, 1e-12, 0}};
    for (int i = 0; i < count; ++i)
        list.push_back(
            at(std::acos(2 * one(random) - 1), 7 * one(random)) * std::pow(10.0, -6 + (6 + std::log10(most)) * one(random)));
    return list;
}

// Errors are relative to the size of the summands: gamma times the event, a dozen roundings.
TEST(Boost, EventsAgreeWithTheTextbookBoost)
{
    const auto places = velocities(50, 1e3);
    for (const dvec3& u : velocities(400, 1e9))
        for (const dvec3& x : places) {
            const double t = x.x - 2 * x.y;
            const auto expected = quad::boosted(quad::of(u), {t, quad::of(x)});
            const double size = std::sqrt(1 + glm::dot(u, u)) * (std::abs(t) + glm::length(x));
            EXPECT_LE(double(fabsq(pd::world_time(u, t, x) - expected.t)), 12 * round_double * size);
            EXPECT_LE(double(quad::length(quad::of(pd::world_place(u, t, x)) - expected.x)), 12 * round_double * size);
        }
}

// Two eyes simultaneous in the ship: the part across the motion is the same, the part along it gamma times, the time u .
// offset.
TEST(Boost, EyesAreSimultaneousInTheShip)
{
    const dvec3 left(-.032, .01, 0), right(.032, .01, .002);
    double worst = 0;
    for (const dvec3& u : velocities(2000, 1e9)) {
        const auto l = quad::boosted(quad::of(u), {0, quad::of(left)}), r = quad::boosted(quad::of(u), {0, quad::of(right)});
        const double size = std::sqrt(1 + glm::dot(u, u)) * glm::length(right);
        const double later = pd::eye_time(u, right) - pd::eye_time(u, left);
        const dvec3 apart = pd::eye_place(u, right) - pd::eye_place(u, left);
        worst = std::max(
            {worst, double(fabsq(later - (r.t - l.t))) / size, double(quad::length(quad::of(apart) - (r.x - l.x))) / size});
        // The interval is the ship's own distance at any speed; the difference of squares loses a factor of gamma^2.
        if (size < 1e3 * glm::length(right)) {
            const double interval = std::sqrt(glm::dot(apart, apart) - later * later);
            EXPECT_NEAR(interval / glm::length(right - left), 1, 1e-14 * (1 + glm::dot(u, u)));
        }
    }
    EXPECT_LE(worst, 24 * round_double); // two events with a dozen roundings each
    const dvec3 place = pd::eye_place({0, 0, std::sqrt(15.0)}, {1, 2, 3});
    EXPECT_NEAR(place.x, 1, 1e-14);
    EXPECT_NEAR(place.y, 2, 1e-14);
    EXPECT_NEAR(place.z, 4 * 3, 1e-13);
    EXPECT_NEAR(pd::eye_time({0, 0, std::sqrt(15.0)}, {1, 2, 3}), 3 * std::sqrt(15.0), 1e-13);
}

TEST(Boost, ExpRapidityIsTheExponentialOfTheRapidity)
{
    for (double gamma : {1 + 1e-15, 1 + 1e-7, 2.0, 4.0, 1e3, 1e6, 1e9}) {
        const double u = u_of_gamma(gamma);
        EXPECT_LE(double(fabsq(pd::exp_rapidity(u) / expq(asinhq(u)) - 1)), 4 * round_double);
        EXPECT_LE(std::abs(pf::exp_rapidity(float(u)) / double(expq(asinhq(float(u)))) - 1), 4 * round_float);
    }
}

TEST(Boost, VelocitiesAdd)
{
    const struct {
        double first, second, sum, half_digit;
    } table[] = {{.5, .5, .8, 1e-15}, {.9, .9, .99447514, 0.5e-8}};
    for (const auto& row : table) {
        const dvec3 u = pd::composed({0, u_of_beta(row.first), 0}, {0, u_of_beta(row.second), 0});
        EXPECT_NEAR(u.y / pd::gamma_of(u), row.sum, row.half_digit);
        EXPECT_EQ(u.x, 0);
        EXPECT_EQ(u.z, 0);
    }
    for (double first : {.001, 1.0, 5.0, 14.0}) // rapidities add
        for (double second : {.01, 2.0, 6.0}) {
            const dvec3 u = pd::composed({std::sinh(first), 0, 0}, {std::sinh(second), 0, 0});
            EXPECT_NEAR(std::asinh(u.x), first + second, 1e-14 * (first + second));
        }
}

TEST(Boost, CompositionAgreesWithTheTextbookBoost)
{
    for (const dvec3& u : velocities(300, 1e6))
        for (const dvec3& w : velocities(30, 1e6)) {
            const auto expected = quad::boosted(quad::of(u), {quad::gamma(quad::of(w)), quad::of(w)});
            const double size = std::sqrt((1 + glm::dot(u, u)) * (1 + glm::dot(w, w)));
            EXPECT_LE(double(quad::length(quad::of(pd::composed(u, w)) - expected.x)), 12 * round_double * size);
        }
}

// boost(u) boost(w) = boost(composed) turn holds for the three axes. In 33 digits the inverse boost leaves about 1e-33
// (gamma_u gamma_w)^2, far below double for these velocities.
TEST(Boost, WignerTurnIsTheRotationInTwoBoosts)
{
    double worst = 0;
    for (const dvec3& u : velocities(200, 300))
        for (const dvec3& w : velocities(40, 300)) {
            const dvec4 q = pd::wigner_turn(u, w);
            EXPECT_NEAR(glm::length(q), 1, 4 * round_double);
            const quad::V3 both = quad::boosted(quad::of(u), {quad::gamma(quad::of(w)), quad::of(w)}).x;
            for (const quad::V3& axis : {quad::V3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
                const quad::V4 there = quad::boosted(quad::of(u), quad::boosted(quad::of(w), {0, axis}));
                const quad::V4 turned = quad::boosted(both * -1, there);
                ASSERT_LE(double(fabsq(turned.t)), 1e-20); // a pure rotation
                worst = std::max(worst, double(quad::length(turned.x - quad::turned(q, axis))));
            }
        }
    std::printf("  wigner_turn, worst error of an axis %.2e rad\n", worst);
    // Scalar and axis of two boosts that nearly cancel lose a factor of gamma_u gamma_w / (gamma_u + gamma_w), here up to
    // 150.
    EXPECT_LE(worst, 150 * 8 * round_double);
}

TEST(Boost, WignerAnglesHaveTheirTabulatedValues)
{
    const struct {
        double first, second, angle;
    } table[] = {{.5, .5, 8.21321}, {.8, .6, 18.92464}, {.9, .9, 42.89620}};
    for (const auto& row : table) {
        const double u1 = u_of_beta(row.first), u2 = u_of_beta(row.second);
        const double g1 = std::sqrt(1 + u1 * u1), g2 = std::sqrt(1 + u2 * u2);
        const dvec4 q = pd::wigner_turn({u1, 0, 0}, {0, u2, 0});
        const double angle = 2 * std::atan2(glm::length(dvec3(q)), q.w);
        EXPECT_NEAR(angle / degree, row.angle, half_1e5);
        EXPECT_NEAR(std::cos(angle), (g1 + g2) / (1 + g1 * g2), 1e-15);
        EXPECT_EQ(q.x, 0);
        EXPECT_EQ(q.y, 0);
        EXPECT_LT(q.z, 0); // against the turn of the velocity
        const dvec3 u = pd::composed({u1, 0, 0}, {0, u2, 0});
        EXPECT_NEAR(pd::gamma_of(u), g1 * g2, 8 * round_double * g1 * g2);
        EXPECT_NEAR(u.x, u1 * g2, 8 * round_double * g1 * g2);
        EXPECT_NEAR(u.y, u2, 8 * round_double * g1 * g2);
    }
}

// The angle of any two boosts up to gamma 1e6, from the textbook's symmetric cosine formula in 33 digits.
TEST(Boost, WignerAngleAtHighGammaAgreesWithTheCosineFormula)
{
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> one(0, 1);
    for (int i = 0; i < 3000; ++i) {
        const double between = 0.01 + 3.0 * one(random);
        const dvec3 u = at(0.3, 1) * std::pow(10, 6 * one(random));
        const dvec3 side = glm::normalize(glm::cross(u, dvec3(1, 2, 3)));
        const dvec3 w = (glm::normalize(u) * std::cos(between) + side * std::sin(between)) * std::pow(10, 6 * one(random));
        const quad::Q g1 = quad::gamma(quad::of(u)), g2 = quad::gamma(quad::of(w)),
                      g = g1 * g2 + quad::dot(quad::of(u), quad::of(w));
        const quad::Q sum = 1 + g + g1 + g2;
        const double expected = double(acosq(sum * sum / ((1 + g) * (1 + g1) * (1 + g2)) - 1));
        const dvec4 q = pd::wigner_turn(u, w);
        const double got = 2 * std::atan2(glm::length(dvec3(q)), q.w);
        EXPECT_NEAR(got, expected, 1e-13)
            << i; // nearly opposite, 0.13 apart: roundings of 1e-15 grow by 1 / (1 - cos) < 120
    }
}

// Many small boosts around a circle of velocities. The polygon differs from the circle by 1/n^2.
TEST(Boost, ACircularOrbitTurnsByThomasPrecession)
{
    for (double gamma : {1.01, 1.5, 2.0, 4.0}) {
        double turn[2];
        for (int fine = 0; fine < 2; ++fine) {
            const int steps = fine ? 40000 : 20000;
            const double speed = u_of_gamma(gamma);
            double total = 0;
            for (int i = 0; i < steps; ++i) {
                const double a = 2 * pi * i / steps, b = 2 * pi * (i + 1) / steps;
                const dvec3 u(speed * std::cos(a), speed * std::sin(a), 0),
                    next(speed * std::cos(b), speed * std::sin(b), 0);
                const auto w = quad::boosted(quad::of(u) * -1, {quad::gamma(quad::of(next)), quad::of(next)}).x;
                const dvec4 t = pd::wigner_turn(u, {double(w.x), double(w.y), double(w.z)});
                total += 2 * std::atan2(t.z, t.w);
            }
            turn[fine] = total / degree;
        }
        EXPECT_LT(turn[1], 0); // against the orbit
        const double limit = turn[1] + (turn[1] - turn[0]) / 3; // Richardson's extrapolation
        EXPECT_NEAR(limit, -360 * (gamma - 1), 1e-8);
    }
}

// ---------------------------------------------------------------- motion

TEST(Motion, HelpersAgreeWithHyperbolicFunctions)
{
    for (double x : {0.0, 1e-300, 1e-9, 1e-3, .02, .3, .7, .999, 1.0, 1.001, 1.5, 1.999, 2.0, 2.001, 10.0, 30.0})
        for (double sign : {1., -1.}) {
            const quad::Q s = x == 0 ? quad::Q(1) : sinhq(x) / x;
            const quad::Q half = sinhq(quad::Q(x) / 2);
            const quad::Q c = x == 0 ? quad::Q(0) : 2 * half * half / x * sign;
            EXPECT_LE(double(fabsq(pd::sinh_ratio(sign * x) - s) / s), 4 * round_double) << x;
            EXPECT_LE(double(fabsq(pd::cosh_less_one_ratio(sign * x) - c)), 8 * round_double * double(fabsq(c))) << x;
        }
}

// The worldline of a ship under thrust, integrated: dX = U, dU = a A, dA = a U (Fermi-Walker), by Runge-Kutta in 33 digits.
struct Course {
    quad::V4 X, U, A;
};
Course along(const Course& c, const Course& rate, quad::Q h)
{
    const auto sum = [h](quad::V4 a, quad::V4 b) { return quad::V4{a.t + h * b.t, a.x + b.x * h}; };
    return {sum(c.X, rate.X), sum(c.U, rate.U), sum(c.A, rate.A)};
}
Course integrated(quad::V3 u, quad::V3 way, quad::Q strength, quad::Q tau, int steps)
{
    const auto rate = [&](const Course& c) {
        return Course{c.U, {c.A.t * strength, c.A.x * strength}, {c.U.t * strength, c.U.x * strength}};
    };
    Course c{{0, {0, 0, 0}}, {quad::gamma(u), u}, quad::boosted(u, {0, way})};
    const quad::Q h = tau / steps;
    for (int i = 0; i < steps; ++i) {
        const Course k1 = rate(c), k2 = rate(along(c, k1, h / 2)), k3 = rate(along(c, k2, h / 2)),
                     k4 = rate(along(c, k3, h));
        c = along(along(along(along(c, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
    return c;
}

TEST(Motion, ThrustSegmentAgreesWithIntegration)
{
    const dvec3 way = glm::normalize(dvec3(1, -2, 2.5));
    for (const dvec3& u : {dvec3(0), dvec3(.3, .1, -.2), dvec3(-3, 4, 1), dvec3(100, 5, 0), dvec3(-1e6, 2e6, 0)})
        for (const auto& [strength, tau] : {std::pair{1., .005}, {1.03, 2.}, {.01, 3.}, {5., .4}, {-1., .7}, {0., 1.}}) {
            const auto segment = pd::thrust_segment(u, way, strength, tau);
            // 4000 steps of fourth-order Runge-Kutta over at most 2.06 of rapidity: 2.06 (5e-4)^4 / 120 = 1e-15.
            const Course expected = integrated(quad::of(u), quad::of(way), strength, tau, 4000);
            const double size = double(expected.U.t) + std::sqrt(1 + glm::dot(u, u));
            EXPECT_LE(double(quad::length(quad::of(segment.du) - (expected.U.x - quad::of(u)))), 4e-15 * size);
            EXPECT_LE(double(quad::length(quad::of(segment.dx) - expected.X.x)), 4e-15 * size * tau);
            EXPECT_LE(double(fabsq(segment.dt - expected.X.t)), 4e-15 * size * tau);
        }
}

// One g in years and light years; the closed form was evaluated with 40 decimal digits.
TEST(Motion, OneGHasTheTabulatedTimesAndDistances)
{
    const double year_s = 365.25 * 86400, g = 9.80665 * year_s / 299792458;
    const struct {
        double tau, t, x, v;
    } table[] = {{1, 1.187312401712, .5636424650787, .7748272626425}, {2, 3.756289449781, 2.910475472067, .9683178487310},
        {5, 84.47972636444, 83.51656515027, .9999342623307}};
    for (const auto& row : table) {
        const auto segment = pd::thrust_segment({0, 0, 0}, {0, 0, 1}, g, row.tau);
        EXPECT_NEAR(segment.dt / row.t, 1, 1e-12);
        EXPECT_NEAR(segment.dx.z / row.x, 1, 1e-12);
        EXPECT_NEAR(segment.du.z / std::sqrt(1 + segment.du.z * segment.du.z) / row.v, 1, 1e-12);
    }
}

// "It seems to move backwards": a small body ahead first shrinks while the ship thrusts towards it.
TEST(Motion, UnderThrustABodyAheadFirstShrinks)
{
    const double L = 8;
    for (double a : {.2, 1.0, 5.0}) {
        const auto size = [&](double eta) {
            const auto segment = pd::thrust_segment({0, 0, 0}, {0, 0, 1}, a, eta / a);
            const double E = pd::exp_rapidity(segment.du.z);
            // The body's apparent size relative to the world's, from the direction of its edge.
            const double edge = 1e-6;
            const double shrink = angle_from_motion(pd::camera_from_world(at(edge), E, 1 / E).n) / edge;
            return L / (L - segment.dx.z) * shrink;
        };
        const double least = std::log(1 + a * L);
        EXPECT_NEAR(size(least), 2 / (2 + a * L), 1e-10); // the edge of 1e-6 is not quite small: 1e-12
        EXPECT_NEAR(size(std::log(1 + 2 * a * L)), 1, 1e-10);
        double low = 0, high = std::log(1 + 2 * a * L); // golden section finds the minimum by itself
        while (high - low > 1e-4) {
            const double p = high - .618 * (high - low), q = low + .618 * (high - low);
            (size(p) < size(q) ? high : low) = size(p) < size(q) ? q : p;
        }
        EXPECT_NEAR(.5 * (low + high), least, 1e-4); // a minimum is flat: 1e-4 there is 1e-8 of the size
    }
}

// The float versions of boosts and motion run on the device; each is compared with double of the same numbers.
TEST(Motion, FloatAgreesWithDouble)
{
    double place = 0, turn = 0, segment_worst = 0;
    for (const dvec3& drawn : velocities(500, 1e4))
        for (const dvec3& other : velocities(20, 10)) {
            const vec3 u(drawn), w(other);
            const dvec3 ud(u), wd(w);
            const double size = std::sqrt((1 + glm::dot(ud, ud)) * (1 + glm::dot(wd, wd)));
            place = std::max(place, glm::length(dvec3(pf::composed(u, w)) - pd::composed(ud, wd)) / size);
            turn = std::max(turn, glm::length(dvec4(pf::wigner_turn(u, w)) - pd::wigner_turn(ud, wd)));
            for (float strength : {.001f, .5f, 2.f}) {
                const vec3 way = glm::normalize(vec3(1, 2, -1));
                const auto got = pf::thrust_segment(u, way, strength, .7f);
                const auto expected = pd::thrust_segment(ud, dvec3(way), strength, double(.7f));
                const double reach = std::sqrt(1 + glm::dot(ud, ud)) * std::exp(strength * .7);
                segment_worst = std::max({segment_worst, glm::length(dvec3(got.du) - expected.du) / reach,
                    glm::length(dvec3(got.dx) - expected.dx) / reach, std::abs(got.dt - expected.dt) / reach});
            }
        }
    std::printf("  float: composed %.2e  wigner_turn %.2e  thrust_segment %.2e\n", place, turn, segment_worst);
    EXPECT_LE(place, 12 * round_float);
    EXPECT_LE(segment_worst, 12 * round_float);
    EXPECT_LE(turn, 20 * 12 * round_float); // boosts that nearly cancel lose up to the smaller gamma, doubled: 20
}

} // namespace

TEST(Physics, AnEclipseLeavesTheSumOverTheRestOfTheDisc)
{
    // Neckel and Labs 1994, table 1, at 550 nm between its rows.
    const std::array<double, 6> powers{0.26444, 1.30550, -1.43067, 1.67079, -1.12347, 0.31323};
    const auto sum = [&](double disc, double apart) {
        double whole = 0, left = 0;
        constexpr int n = 600;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const dvec2 at(2 * (i + 0.5) / n - 1, 2 * (j + 0.5) / n - 1);
                const double square = glm::dot(at, at);
                if (square >= 1)
                    continue;
                const double mu = std::sqrt(1 - square);
                double light = 0;
                for (std::size_t k = 6; k-- > 0;)
                    light = light * mu + powers[k];
                whole += light;
                left += std::hypot(at.x - apart, at.y) >= disc ? light : 0;
            }
        return left / whole;
    };
    double worst = 0;
    for (const double disc : {0.27, 0.93, 0.999, 1.0, 1.04, 3.67})
        for (int i = 0; i <= 24; ++i) {
            const double apart = (1.02 + disc) * i / 24, expected = sum(disc, apart);
            worst = std::max(worst, std::abs(pd::left_of_sun(disc, apart) - expected));
            EXPECT_NEAR(pf::left_of_sun(float(disc), float(apart)), pd::left_of_sun(disc, apart), 2e-4)
                << disc << ' ' << apart;
        }
    std::printf("an eclipse's light is off by at most %.4f\n", worst);
    EXPECT_LT(worst, 0.004);
    EXPECT_EQ(pd::left_of_sun(1.04, 0), 0);
    EXPECT_EQ(pd::left_of_sun(1.04, 2.05), 1);
}

/// Moments over places that are spread evenly, far from each other. A mean of 40,000 places of variance 1 is off by 0.005
/// (one standard deviation); the logistic curve and the noise, which is not normal, by 0.012.
TEST(Physics, DetailKeepsTheMeanOfTheMaps)
{
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-600, 600);
    constexpr int count = 40000;
    for (const double octaves : {0.5, 1.0, 3.0, 9.0}) {
        glm::dvec2 mean(0), square(0), said(0);
        double both = 0, spots = 0;
        std::vector<double> parts = {0.02, 0.2, 0.5, 0.8, 0.98}, covers(parts.size());
        for (int i = 0; i < count; ++i) {
            const pd::Detail here = pd::detail_at(dvec3(place(random), place(random), place(random)), dvec3(0), octaves);
            mean += here.value / double(count), square += here.value * here.value / double(count);
            both += here.value.x * here.value.y / count;
            spots += pd::detail_spots(here.value.x, here.variance.x, 1.2) / count;
            for (std::size_t k = 0; k < parts.size(); ++k)
                covers[k] += pd::detail_cover(parts[k], here.value.x, here.variance.x) / count;
            said = here.variance;
        }
        for (int field = 0; field < 2; ++field) {
            EXPECT_NEAR(mean[field], 0, 0.02) << octaves;
            EXPECT_NEAR(square[field], said[field], 0.03) << octaves;
        }
        EXPECT_NEAR(both, 0, 0.02) << octaves << ": the fields should be independent";
        EXPECT_NEAR(spots, 1, 0.04) << octaves;
        for (std::size_t k = 0; k < parts.size(); ++k)
            EXPECT_NEAR(covers[k], parts[k], 0.018) << octaves;
    }
}

/// A unit direction, even over the sphere.
static dvec3 random_direction(std::mt19937_64& random)
{
    std::normal_distribution<double> number;
    return glm::normalize(dvec3(number(random), number(random), number(random)));
}

TEST(Physics, TheSunsSurfaceKeepsItsLight)
{
    std::mt19937_64 random(5);
    constexpr int count = 200000;
    for (const double pixel : {1e-4, 5e-3}) {
        double mean = 0, calm = 0, square = 0, spots = 0, umbra = 1;
        int quiet = 0;
        for (int i = 0; i < count; ++i) {
            const dvec3 at = random_direction(random);
            const double light = pd::sun_surface(at, pixel, 1);
            mean += light / count, umbra = std::min(umbra, light);
            spots += light < 0.7 * (1 - 3 * 0.14) ? 1.0 / count : 0;
            if (std::abs(at.z) > 0.75)
                calm += light, square += light * light, ++quiet;
            EXPECT_GT(light, 0.1);
            EXPECT_LT(light, 1.7);
            // A float knows the place to 3e-5 of a granule's cell, and lanes are as steep as a root.
            EXPECT_NEAR(
                pf::sun_surface(glm::vec3(at), float(pixel), 1), pd::sun_surface(dvec3(glm::vec3(at)), pixel, 1), 0.02);
        }
        calm /= quiet;
        const double spread = std::sqrt(square / quiet - calm * calm);
        std::printf("  pixel %g: mean %.4f, without spots %.4f +- %.3f, umbras %.4f of the ground, darkest %.2f\n", pixel,
            mean, calm, spread, spots, umbra);
        EXPECT_NEAR(mean, 1, 0.005); // spots dim the whole Sun by 0.1 to 0.3 %
        EXPECT_NEAR(calm, 1, 0.003);
        EXPECT_NEAR(spread, pixel < 1e-3 ? 0.14 : 0, 0.005) << "granules finer than a pixel are not seen";
        EXPECT_LT(umbra, 0.35);
        EXPECT_GT(spots, 1e-4);
        EXPECT_LT(spots, 3e-3);
    }
}

// No place of the Sun has an edge that is not a spot's: no sector, no pole and no equator is seen.
TEST(Physics, TheSunsSurfaceHasNoSeams)
{
    const double pixel = 2e-3; // without granules
    const auto at = [](double latitude, double longitude) {
        return dvec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    };
    for (int i = 0; i < 400; ++i) {
        const double latitude = (i - 199.5) / 200 * 0.8;
        for (int sector = 0; sector < 12; ++sector) {
            const double side = sector * pi / 6;
            EXPECT_NEAR(pd::sun_surface(at(latitude, side - 1e-6), pixel, 0.2),
                pd::sun_surface(at(latitude, side + 1e-6), pixel, 0.2), 1e-4)
                << latitude << ' ' << sector;
        }
        const double longitude = i * pi / 200;
        for (const double edge : {0.0, std::asin(0.7), -std::asin(0.7)})
            EXPECT_NEAR(pd::sun_surface(at(edge - 1e-6, longitude), pixel, 0.2),
                pd::sun_surface(at(edge + 1e-6, longitude), pixel, 0.2), 1e-4)
                << edge << ' ' << longitude;
    }
}

TEST(Physics, DetailsSlopeIsItsDifference)
{
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> place(-600, 600);
    const dvec3 along(0.3, -0.4, 0.2);
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p(place(random), place(random), place(random));
        const double octaves = i % 9 + 0.5, step = 1e-6;
        const pd::Detail here = pd::detail_at(p, along, octaves), next = pd::detail_at(p + step * along, dvec3(0), octaves),
                         before = pd::detail_at(p - step * along, dvec3(0), octaves);
        // The second derivative jumps at the cells' sides: by 6 of the finest octave, of 0.02 * 512 * 512.
        for (int field = 0; field < 2; ++field)
            EXPECT_NEAR((next.value[field] - before.value[field]) / (2 * step), here.slope[field], 0.05);
        // A float knows the place to 3e-5 of a cell. The slopes of all octaves together are below 1,000, or 200 of the
        // ground.
        const glm::vec3 rough(p);
        const pd::Detail exact = pd::detail_at(dvec3(rough), along, octaves);
        const pf::Detail floats = pf::detail_at(rough, glm::vec3(along), float(octaves));
        EXPECT_NEAR(floats.value.x, exact.value.x, 0.03);
        EXPECT_NEAR(floats.value.y, exact.value.y, 0.006);
    }
}

// An arc's light between two places is the mean of its light at the places between; a wider pixel has as much light.
TEST(Physics, AnAurorasArcIsTheMeanOfItsPlaces)
{
    const double width = 0.0035;
    for (const double from : {-0.03, -0.004, -1e-5, 0.002})
        for (const double length : {1e-6, 5e-5, 1e-3, 0.02}) {
            double mean = 0;
            constexpr int count = 2000;
            for (int i = 0; i < count; ++i)
                mean += std::pow(std::cosh((from + length * (i + 0.5) / count) / width), -2) / count;
            EXPECT_NEAR(pd::aurora_arc(from, from + length, width), mean, 1e-4) << from << " " << length;
            EXPECT_NEAR(pd::aurora_arc(from + length, from, width), mean, 1e-4);
            EXPECT_NEAR(pf::aurora_arc(float(from), float(from + length), float(width)), mean, 1e-3);
        }
    const pd::AuroraPlace far{-0.15, -0.13, 1}, farther{0.15, 0.17, 1};
    EXPECT_NEAR(pd::aurora(far, farther, 1, 0), pd::aurora(far, farther, 1, 0.01), 1e-4);
}

// An oval's light lies within 8 degrees of its circle, on some of it.
TEST(Physics, AurorasLieInTheirOvals)
{
    const dvec3 centre = glm::normalize(dvec3(0.1, 0.2, 0.95));
    std::mt19937_64 random(11);
    int bright = 0, near = 0;
    for (int i = 0; i < 100000; ++i) {
        std::normal_distribution<double> number;
        const dvec3 up = glm::normalize(dvec3(number(random), number(random), number(random)));
        const double off_deg = std::acos(glm::dot(up, centre)) / degree;
        const pd::AuroraPlace at = pd::aurora_place(up, centre);
        const double light = at.strength > 0 ? pd::aurora(at, at, 1, 0) : 0;
        EXPECT_GE(light, 0);
        if (light > 0.05) {
            ++bright;
            EXPECT_NEAR(off_deg, 20.6, 8.0);
        }
        near += std::abs(off_deg - 20.6) < 8;
    }
    EXPECT_GT(bright, near / 20);
    EXPECT_LT(bright, near * 6 / 10);
}

TEST(Physics, DetailIsTheMapWhereAPixelIsWider)
{
    const pd::Detail none = pd::detail_at(dvec3(12.3, 4.5, 6.7), dvec3(1, 0, 0), 0);
    EXPECT_EQ(none.value, glm::dvec2(0));
    EXPECT_EQ(none.variance, glm::dvec2(0));
    for (const double part : {0.001, 0.3, 0.999})
        EXPECT_NEAR(pd::detail_cover(part, 0, 0), part, 1e-12);
    EXPECT_EQ(pd::detail_spots(0, 0, 1.2), 1);
}

} // namespace physics_test
