#pragma once
#include "config/model/scene_file.h"
#include "runtime/world/sky_names.h"
#include "runtime/world/world.h"

namespace starbow {

/// A name in the sky, at the unit direction in which its thing is seen, cockpit axes.
struct SkyLabel {
    std::string name;
    glm::dvec3 towards{0, 0, -1};
};

/// Metres from the Sun up to which the constellations' figures fit the stars: half a light-year.
constexpr double figures_fit_m = 4.73e15;
/// True where the ship is so near the Sun.
bool figures_fit(const Shot& shot, const SceneFile& scene);

/// The most names in one picture.
constexpr std::size_t most_sky_labels = 28;
/// The names of globes, constellations and bright stars around the look's direction, the best known first, none over
/// another: as they are seen, with aberration. Left out are names of globes that fill much of the picture, and of what is
/// behind a globe, or below the horizon of a world that has one. language: such as "de".
std::vector<SkyLabel> sky_labels(
    const SkyNames& names, const Shot& shot, const World& world, const SceneFile& scene, const std::string& language);

} // namespace starbow
