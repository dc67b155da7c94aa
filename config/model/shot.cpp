#include "shot.h"
#include "describe_shot.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double most_gamma = 1e9;

/// Normalises a vector, also where the squares of the components overflow or underflow. Zero stays zero.
glm::dvec3 unit(const glm::dvec3& v)
{
    const glm::dvec3 size = glm::abs(v);
    const double largest = std::max(size.x, std::max(size.y, size.z));
    return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

/// gamma beta from the one of the three that the file has; each form is free of cancellation.
double read_proper_speed(const Place& place)
{
    const auto gamma = find_member(place, "gamma"), beta = find_member(place, "beta"),
               rapidity = find_member(place, "rapidity");
    if (gamma.has_value() + beta.has_value() + rapidity.has_value() != 1)
        fail_at(place,
            std::string(gamma || beta || rapidity ? "has more than one speed" : "has no speed")
                + "; exactly one of \"gamma\", \"beta\" and \"rapidity\" is right");
    if (gamma) {
        const double g = number(*gamma, {-1e308, 1e308});
        if (g < 1)
            fail_at(*gamma, "is less than gamma ever is; 1 at rest and up to 1e9 is right");
        if (g > most_gamma)
            fail_at(*gamma, "is beyond any flight here; a gamma from 1 to 1e9 is right");
        return std::sqrt((g - 1) * (g + 1));
    }
    if (beta) {
        const double b = number(*beta, {-1e308, 1e308});
        if (b >= 1)
            fail_at(*beta, "can't be flown: nothing reaches the speed of light; a beta from 0 to below 1 is right");
        if (b < 0)
            fail_at(*beta, "is negative; a beta from 0 to below 1, with the heading in \"direction\", is right");
        return b / std::sqrt((1 - b) * (1 + b));
    }
    return std::sinh(number(*rapidity, {0, std::acosh(most_gamma)}));
}

} // namespace

glm::dvec3 unit_direction(const Place& place)
{
    const glm::dvec3 direction = unit(vec3(place, {-1e300, 1e300}));
    if (direction == glm::dvec3(0))
        fail_at(place, "points nowhere; a direction of any length above 0 is right");
    return direction;
}

glm::dquat orientation(const glm::dvec3& look, const glm::dvec3& up)
{
    const glm::dvec3 ahead = unit(look);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, unit(up)));
    return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(right, ahead), -ahead)));
}

glm::dquat read_orientation(const Place& place)
{
    glm::dvec3 look{0, 0, -1}, up{0, 1, 0};
    const auto look_at = find_member(place, "look"), up_at = find_member(place, "up");
    if (look_at)
        look = unit_direction(*look_at);
    if (up_at)
        up = unit_direction(*up_at);
    if (glm::length(glm::cross(look, up)) < 1e-6)
        fail_at(up_at ? *up_at : *look_at,
            std::string("is parallel to \"") + (up_at ? "look" : "up")
                + "\"; a direction that is not parallel to it is right");
    return orientation(look, up);
}

Json UnitDirection::schema(Json&) const { return described::list_schema(3, 3, {{"type", "number"}}); }

glm::dvec3 read_velocity(const Place& place)
{
    reject_unknown_members(place, {"direction", "gamma", "beta", "rapidity"});
    const glm::dvec3 direction = unit_direction(member(place, "direction"));
    return direction * read_proper_speed(place);
}

Json velocity_schema(Json& definitions)
{
    const auto speed = [&](Json shape, const char* says) {
        shape["description"] = says;
        return shape;
    };
    Json properties = Json::object();
    properties["direction"]
        = speed(UnitDirection{}.schema(definitions), "The direction of the motion, [x, y, z] of any length.");
    properties["beta"]
        = speed({{"type", "number"}, {"minimum", 0}, {"exclusiveMaximum", 1}}, "Speed over that of light. No unit.");
    properties["gamma"] = speed(Number{{1, most_gamma}}.schema(definitions), "Lorentz factor. No unit.");
    properties["rapidity"] = speed(Number{{0, std::acosh(most_gamma)}}.schema(definitions), "Rapidity. No unit.");
    Json one_speed = Json::array();
    for (const char* name : {"beta", "gamma", "rapidity"})
        one_speed.push_back({{"required", {name}}});
    return {{"type", "object"}, {"additionalProperties", false}, {"required", {"direction"}}, {"oneOf", one_speed},
        {"properties", properties}};
}

void check(const Place& place, Shot& shot, const Folder&) { shot.ship_from_cockpit = read_orientation(place); }

Shot read_shot(const Place& place, bool with_scene)
{
    return read<Shot>(place, {}, {.without = with_scene ? nullptr : "scene"});
}

Shot load_shot(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read_shot(root(document), true);
}

} // namespace starbow
