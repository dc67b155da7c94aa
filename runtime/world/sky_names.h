#pragma once
#include "config/model/scene_file.h"
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace starbow {

/// A name by languages' names, such as "de".
using NameByLanguage = std::map<std::string, std::string>;

/// A constellation's figure and its name. Unit directions, equatorial axes, J2000.
struct Constellation {
    NameByLanguage names;
    int rank = 1; ///< 1 to 3, the best known first
    glm::dvec3 middle{0, 0, 1}; ///< the place for its name
    std::vector<std::vector<glm::dvec3>> lines; ///< each through two or more stars
};
struct NamedStar {
    std::string name; ///< in all languages
    glm::dvec3 direction{0, 0, 1};
    double magnitude = 0;
};

/// The sky's names, as they are seen from the Sun.
struct SkyNames {
    std::vector<Constellation> constellations;
    std::vector<NamedStar> stars; ///< the brightest first
    std::map<std::string, NameByLanguage> globes; ///< by Globe::name
};

/// Reads a file of names; scenes/stars/README.md describes it. Throws InputError.
SkyNames load_sky_names(const std::filesystem::path& file);
/// A scene's names: of names.json beside its catalogue of stars; nothing where there is no such file.
SkyNames sky_names_of(const SceneFile& scene);

/// The name in a language, or else in English.
const std::string& name_in(const NameByLanguage& names, const std::string& language);

/// The lines of all constellations for a device that looks for those near a direction. The sphere is divided into
/// FIGURE_ROWS times FIGURE_COLUMNS cells, from +z to -z and from -x on around +z. First, for each cell, the index of its
/// first line in x and their number in y; then the lines, two entries each, from end to end: unit directions in the world.
/// A cell has all lines that come within FIGURE_REACH radians of any of its directions.
std::vector<glm::vec4> figure_table(const SkyNames& names, const glm::dmat3& world_from_equatorial);

} // namespace starbow
