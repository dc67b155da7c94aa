#include "sky_labels.h"
#include "config/model/angles.h"
#include "instruments.h"
#include "runtime/world/globes.h"
#include "runtime/world/stars.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double farthest_deg = 80; ///< of names, from the look's direction
constexpr double largest_globe_deg = 12; ///< the radius of one with a name
constexpr double horizon_deg = 8; ///< in a world with a horizon, hills hide what is lower

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) { return angle_between(a, b) / degree; }

/// True if the plates of two names would touch: of letters that are 1.6 degrees high, and half as wide.
bool touches(const SkyLabel& a, const SkyLabel& b)
{
    const glm::dvec2 at = azimuth_elevation_deg(a.towards), apart = at - azimuth_elevation_deg(b.towards);
    const double across = std::abs(std::remainder(apart.x, 360)) * std::cos(at.y * degree);
    return std::abs(apart.y) < 2.8 && across < 0.45 * double(a.name.size() + b.name.size()) + 1.5;
}

/// A globe's disc in the world's directions.
struct Disc {
    std::string name;
    glm::dvec3 towards;
    double radius_deg, distance;
};

std::vector<Disc> discs(const Shot& shot, const World& world, const SceneFile& scene)
{
    std::vector<Disc> all;
    if (!world.globes)
        return all;
    for (const SeenGlobe& seen : globes_seen(*world.globes, scene, shot)) {
        const Globe& globe = world.globes->system.globes[seen.globe];
        const double sine = globe.radius_m / scene.unit_m / seen.distance;
        all.push_back({globe.name, seen.from_eye / seen.distance, std::asin(std::min(sine, 1.0)) / degree, seen.distance});
    }
    return all;
}

/// Chooses names one after the other.
struct Chosen {
    const Shot& shot;
    const SceneFile& scene;
    const std::vector<Disc>& discs;
    const MeasuringObserver observer = measuring_observer_of(shot);
    std::vector<SkyLabel> labels{};

    /// towards, distance: in the world.
    void add(const std::string& name, const glm::dvec3& towards, double distance)
    {
        const SkyLabel label{name, glm::conjugate(shot.ship_from_cockpit) * ray_from_world(observer, towards).ship};
        const auto covers = [&](const Disc& disc) {
            return disc.distance < distance && angle_deg(disc.towards, towards) < disc.radius_deg;
        };
        const auto beside = [&](const SkyLabel& other) { return touches(other, label); };
        const bool has_horizon = glm::length(scene.sky.horizon) > 0;
        if (labels.size() < most_sky_labels && angle_deg(label.towards, {0, 0, -1}) < farthest_deg
            && !(has_horizon && towards.y < std::sin(horizon_deg * degree)) && std::ranges::none_of(discs, covers)
            && std::ranges::none_of(labels, beside))
            labels.push_back(label);
    }
};

} // namespace

bool figures_fit(const Shot& shot, const SceneFile& scene)
{
    return scene.stars && glm::length(shot.position) * scene.unit_m < figures_fit_m;
}

std::vector<SkyLabel> sky_labels(
    const SkyNames& names, const Shot& shot, const World& world, const SceneFile& scene, const std::string& language)
{
    const glm::dmat3 turn = world_from_equatorial(scene.stars ? scene.stars->ahead_deg : glm::dvec2(0));
    const std::vector<Disc> globes = discs(shot, world, scene);
    Chosen chosen{shot, scene, globes};
    for (const Disc& disc : globes)
        if (const auto named = names.globes.find(disc.name);
            named != names.globes.end() && disc.radius_deg < largest_globe_deg)
            chosen.add(name_in(named->second, language), disc.towards, disc.distance);
    if (!figures_fit(shot, scene))
        return chosen.labels;
    constexpr double faintest_of_rank[]{0.5, 1.6, 9}, infinite = std::numeric_limits<double>::infinity();
    std::size_t star = 0;
    for (int rank = 1; rank <= 3; ++rank) { // the best known constellations, then the brightest stars, and so on
        for (const Constellation& one : names.constellations)
            if (one.rank == rank)
                chosen.add(name_in(one.names, language), turn * one.middle, infinite);
        for (; star < names.stars.size() && names.stars[star].magnitude < faintest_of_rank[rank - 1]; ++star)
            chosen.add(names.stars[star].name, turn * names.stars[star].direction, infinite);
    }
    return chosen.labels;
}

} // namespace starbow
