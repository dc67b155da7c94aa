#include "describe_layout.h"
#include "layout_reader.h"
#include <cmath>

namespace starbow {
namespace {

/// How far corners may lie off a rectangle or a plane, in metres per metre: as far as a tape errs.
constexpr double most_off = 0.02;

/// The factor f of a lens must be neither 0 nor infinite out to here, in halves of the picture's height from its centre.
constexpr double lens_reach = 1;

double lens_factor(Lens::Form form, const std::array<double, 4>& k, double r)
{
    const double r2 = r * r;
    return form == Lens::Form::panotools ? ((k[0] * r + k[1]) * r + k[2]) * r + k[3]
                                         : 1 / (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) + k[3];
}

} // namespace

Sides SidesWithin::read(const Place& place, const Folder&) const
{
    reject_unknown_members(place, {"left", "right", "down", "up"});
    const Place left = member(place, "left"), right = member(place, "right"), down = member(place, "down"),
                up = member(place, "up");
    const Sides sides{number(left, across), number(right, across), number(down, upright), number(up, upright)};
    if (sides.left_deg >= sides.right_deg)
        fail_at(left, "is not less than \"right\", " + shown(sides.right_deg) + "; angles that grow to the right are right");
    if (sides.down_deg >= sides.up_deg)
        fail_at(down, "is not less than \"up\", " + shown(sides.up_deg) + "; angles that grow upwards are right");
    if (sides.right_deg - sides.left_deg > 360)
        fail_at(right, "is more than a whole turn from \"left\"; at most 360 degrees between them is right");
    return sides;
}

Json SidesWithin::schema(Json& definitions) const
{
    const double values[4]{usual.left_deg, usual.right_deg, usual.down_deg, usual.up_deg};
    Json properties = Json::object();
    const char* const names[4]{"left", "right", "down", "up"};
    for (int i = 0; i < 4; ++i) {
        properties[names[i]] = Number{i < 2 ? across : upright}.schema(definitions);
        properties[names[i]]["description"] = says[i];
        if (usual.left_deg != usual.right_deg)
            properties[names[i]]["default"] = values[i];
    }
    return {{"type", "object"}, {"required", names}, {"additionalProperties", false}, {"properties", properties}};
}

void FovAcross::read_into(const Place& place, Planar& planar, const Folder&) const
{
    const double half_x = number(place, flat_fov) / 2, half_y = planar.fov_y_deg / 2;
    planar.sides = Sides{-half_x, half_x, -half_y, half_y};
}

void check_members(const Place& place, const Planar*)
{
    const auto x = find_member(place, "fov_x_deg"), y = find_member(place, "fov_y_deg"),
               sides = find_member(place, "sides_deg");
    if (sides && (x || y))
        fail_at(*sides,
            std::string("stands beside \"") + (y ? "fov_y_deg" : "fov_x_deg")
                + "\", which says the same; one of the two is right");
    if (x && !y)
        fail_at(*x, "stands without \"fov_y_deg\"; both, or \"fov_y_deg\" alone, is right");
}

void FourCorners::read_into(const Place& place, Wall& wall, const Folder&) const
{
    const std::vector<Place> all = items(place, 4, 4, "corners");
    wall.lower_left_m = vec3(all[0], room_m), wall.lower_right_m = vec3(all[1], room_m);
    wall.upper_right_m = vec3(all[2], room_m), wall.upper_left_m = vec3(all[3], room_m);
}

Json FourCorners::schema(Json& definitions) const
{
    return described::list_schema(4, 4, Numbers<3>{room_m}.schema(definitions));
}

void check_members(const Place& place, const Wall*)
{
    const auto all = find_member(place, "corners_m");
    for (const char* name : {"lower_left_m", "lower_right_m", "upper_left_m"})
        if (!all)
            member(place, name);
        else if (find_member(place, name))
            fail_at(*all, "stands beside \"" + std::string(name) + "\", which says the same; one of the two is right");
}

/// The corners of a picture that is no rectangle: their plane, their order and their distances.
static void check_four(const Place& place, const Wall& wall)
{
    const std::array<glm::dvec3, 4> at{wall.lower_left_m, wall.lower_right_m, *wall.upper_right_m, wall.upper_left_m};
    const glm::dvec3 rising = at[2] - at[0], falling = at[1] - at[3], facing = glm::cross(falling, rising);
    const double area = glm::length(facing), size = std::sqrt(glm::length(rising) * glm::length(falling));
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 &before = at[std::size_t(i + 3) % 4], &here = at[std::size_t(i)],
                         &after = at[std::size_t(i + 1) % 4];
        // A thousandth of the area: the sine of an angle of a twentieth of a degree in a square.
        if (!(glm::dot(glm::cross(after - here, before - here), facing) > 1e-3 * area * area))
            fail_at(elements(place)[std::size_t(i)],
                "makes no corner that bulges outwards; lower left, lower right, upper right, upper left, as the visitor "
                "sees "
                "them, are right");
    }
    const double off = std::abs(glm::dot(facing / area, at[1] - at[0])) / size; // between the diagonals
    if (off > most_off)
        fail_at(place,
            "lies in no plane (" + shown(std::round(off * 1e4) / 10)
                + " mm off per metre); corners of a flat wall, within 20 mm per metre, are right");
}

void check(const Place& place, const Wall& wall, const Folder&)
{
    if (wall.upper_right_m)
        return check_four(member(place, "corners_m"), wall);
    const glm::dvec3 right = wall.lower_right_m - wall.lower_left_m, up = wall.upper_left_m - wall.lower_left_m;
    const double width = glm::length(right), height = glm::length(up);
    for (const auto& [name, length] : {std::pair("lower_right_m", width), std::pair("upper_left_m", height)})
        if (length < 1e-3)
            fail_at(member(place, name),
                "is less than a millimetre from \"lower_left_m\"; two different corners of the wall are right");
    // The cosine of the angle at the corner: the sideways displacement of the upper edge per metre of height.
    const double slip = std::abs(glm::dot(right, up)) / (width * height);
    if (slip > most_off)
        fail_at(member(place, "upper_left_m"),
            "makes no right angle with the other corners (" + shown(std::round(slip * 1e4) / 10)
                + " mm off per metre); corners of a rectangle, within 20 mm per metre, or all four in \"corners_m\", are "
                  "right");
}

void check(const Place& place, const Fisheye& fisheye, const Folder&)
{
    // An orthographic picture folds back beyond a half sphere; a stereographic one grows without limit towards a whole
    // sphere.
    if (fisheye.mapping == FisheyeMapping::orthographic && fisheye.aperture_deg > 180)
        fail_at(
            member(place, "aperture_deg"), "is more than an orthographic picture can hold; a number from 1 to 180 is right");
    if (fisheye.mapping == FisheyeMapping::stereographic && fisheye.aperture_deg > 350)
        fail_at(
            member(place, "aperture_deg"), "is more than a stereographic picture can hold; a number from 1 to 350 is right");
}

void check(const Place& place, const SphericalMirror& mirror, const Folder&)
{
    if (glm::distance(mirror.projector_m, mirror.mirror_m) <= mirror.mirror_radius_m)
        fail_at(member(place, "projector_m"), "lies inside the mirror's sphere; a place before the mirror is right");
    if (glm::distance(mirror.mirror_m, mirror.dome_m) >= mirror.dome_radius_m)
        fail_at(member(place, "mirror_m"),
            "lies outside the dome, more than \"dome_radius_m\" from its centre; a mirror inside the dome is right");
}

std::array<double, 4> LensNumbers::read(const Place& place, const Folder&) const
{
    const glm::dvec4 numbers = vec4(place, {-1e3, 1e3});
    return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

void LensColour::read_into(const Place& place, Lens& lens, const Folder& folder) const
{
    const Lens::Colour colour = read<Lens::Colour>(place, folder);
    if (which == 1)
        lens.colours.fill(colour);
    else
        lens.colours[std::size_t(which)] = colour;
}

void check(const Place& place, const Lens& lens, const Folder&)
{
    for (const auto& [name, colour] :
        {std::pair("green", &lens.colours[1]), {"red", &lens.colours[0]}, {"blue", &lens.colours[2]}})
        if (const auto at = find_member(place, name)) {
            constexpr int steps = 200;
            for (int i = 0; i <= steps; ++i) {
                const double r = lens_reach * i / steps, factor = lens_factor(lens.form, colour->k, r);
                if (!(factor > 1e-3 && factor < 1e3))
                    fail_at(member(*at, "k"),
                        "makes the lens's factor " + shown(std::round(factor * 1e4) / 1e4) + " at radius " + shown(r)
                            + "; numbers that keep it from 0.001 to 1000 out to radius 1 are right");
            }
        }
}

std::string projection_key(const Projection& projection)
{
    std::string text;
    described::add_to_key(text, projection);
    return text;
}

std::string bend_key(const Viewport& viewport)
{
    std::string text;
    if (viewport.quad)
        described::add_to_key(text, *viewport.quad);
    if (viewport.grid)
        described::add_to_key(text, *viewport.grid);
    return text;
}

void check_eye(const Place& place, const Projection& projection, const glm::dvec3& eye_m, double eyes_apart_m)
{
    const std::string eye = std::string("[").append(shown(eye_m.x) + ", " + shown(eye_m.y) + ", " + shown(eye_m.z) + "]");
    if (const Wall* wall = std::get_if<Wall>(&projection)) {
        const glm::dvec3 towards_viewer
            = glm::normalize(glm::cross(wall->lower_right_m - wall->lower_left_m, wall->upper_left_m - wall->lower_left_m));
        const double distance = glm::dot(eye_m - wall->lower_left_m, towards_viewer);
        const double least = eyes_apart_m / 2 + 1e-3;
        if (distance < -least)
            fail_at(place, "is seen from behind by the eye at " + eye + "; corners as the visitor sees them are right");
        if (distance < least)
            fail_at(place,
                "is a wall that touches the eye at " + eye + "; an eye more than " + shown(least)
                    + " m before the wall's plane is right");
    }
    if (const SphericalMirror* mirror = std::get_if<SphericalMirror>(&projection))
        if (glm::distance(eye_m, mirror->dome_m) + eyes_apart_m / 2 > mirror->dome_radius_m * 0.999)
            fail_at(place, "is a dome whose eye, at " + eye + ", is outside; an \"eye_m\" inside the dome is right");
}

} // namespace starbow
