#pragma once
#include "config/model/layout.h"
#include "sgct_report.h"
#include <glm/glm.hpp>

namespace starbow {

/// The settings that shape a viewport's picture, beside its projection.
struct SgctView {
    glm::dvec2 pixels{1}; ///< of the viewport
    glm::dvec3 eye_m{0};
    bool two_eyes = false; ///< it shows the picture of a left or right eye, or of both
    double window_aspect = 1; ///< width over height
    std::filesystem::path folder; ///< of the configuration, for the names of meshes
};

/// A part of a viewport with a projection of its own: x, y, width and height as fractions from its top left.
struct SgctPart {
    glm::dvec4 rect{0, 0, 1, 1};
    nlohmann::ordered_json projection;
    nlohmann::ordered_json warp; ///< null: none of its own
    int order = 0;
};

struct SgctPicture {
    /// One, six for a cube map's faces, four for a mirror's meshes, none for a projection that is not mapped.
    std::vector<SgctPart> parts;
};

/// True for a flat projection, which SGCT draws without a cube map.
bool is_flat_in_sgct(const std::string& type);

/// True if the eyes do not look through a flat picture from the origin, as it was computed: the picture is then a wall.
bool looks_askew(const SgctView& view);

/// The wall of a picture whose frustum a mesh file brings: SGCT puts its plane 10 m from the origin.
nlohmann::ordered_json sgct_wall(const Planar& frustum);

/// Makes the projections of an SGCT viewport's "projection", and a report line for each of its members. Every direction is
/// the one that SGCT's own formulas give: src/projection/*.cpp and BaseViewport::setViewPlaneCoordsUsingFOVs of its sources.
SgctPicture sgct_projection(SgctReport& report, const Place& projection, const SgctView& view);

} // namespace starbow
