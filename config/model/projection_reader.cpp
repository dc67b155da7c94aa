#include "layout_reader.h"
#include <cmath>

namespace starbow {
namespace {

/// Limits of a flat picture's angles: the tangent stays below 600.
constexpr Range fov{0.1, 179};
constexpr Range whole_turn{-360, 360};

/// The factor f of a lens must be neither 0 nor infinite out to here, in halves of the picture's height from its centre.
constexpr double lens_reach = 1;

Turn read_turn(const Place& place)
{
    reject_unknown_members(place, {"yaw", "pitch", "roll"});
    Turn turn;
    take(place, "yaw", turn.yaw_deg, whole_turn);
    take(place, "pitch", turn.pitch_deg, whole_turn);
    take(place, "roll", turn.roll_deg, whole_turn);
    return turn;
}

void take_turn(const Place& place, Turn& turn)
{
    if (auto p = find_member(place, "turn_deg"))
        turn = read_turn(*p);
}

Sides read_sides(const Place& place, Range across, Range upright)
{
    reject_unknown_members(place, {"left", "right", "down", "up"});
    const Place left = member(place, "left"), right = member(place, "right"), down = member(place, "down"),
                up = member(place, "up");
    const Sides sides{number(left, across), number(right, across), number(down, upright), number(up, upright)};
    if (sides.left_deg >= sides.right_deg)
        complain(
            left, "is not less than \"right\", " + shown(sides.right_deg) + "; angles that grow to the right are right");
    if (sides.down_deg >= sides.up_deg)
        complain(down, "is not less than \"up\", " + shown(sides.up_deg) + "; angles that grow upwards are right");
    if (sides.right_deg - sides.left_deg > 360)
        complain(right, "is more than a whole turn from \"left\"; at most 360 degrees between them is right");
    return sides;
}

/// The members of a flat picture; the caller has checked the names.
Planar read_planar(const Place& place)
{
    Planar planar;
    const auto x = find_member(place, "fov_x_deg"), y = find_member(place, "fov_y_deg"),
               sides = find_member(place, "sides_deg");
    if (sides && (x || y))
        complain(*sides,
            std::string("stands beside \"") + (y ? "fov_y_deg" : "fov_x_deg")
                + "\", which says the same; one of the two is right");
    if (x && !y)
        complain(*x, "stands without \"fov_y_deg\"; both, or \"fov_y_deg\" alone, is right");
    take(place, "fov_y_deg", planar.fov_y_deg, fov);
    if (x) {
        const double half_x = number(*x, fov) / 2, half_y = planar.fov_y_deg / 2;
        planar.sides = Sides{-half_x, half_x, -half_y, half_y};
    }
    if (sides)
        planar.sides = read_sides(*sides, {-89.9, 89.9}, {-89.9, 89.9});
    take_turn(place, planar.turn);
    return planar;
}

Wall read_wall(const Place& place)
{
    const Place lower_left = member(place, "lower_left_m"), lower_right = member(place, "lower_right_m"),
                upper_left = member(place, "upper_left_m");
    const Wall wall{vec3(lower_left, room_m), vec3(lower_right, room_m), vec3(upper_left, room_m)};
    const glm::dvec3 right = wall.lower_right_m - wall.lower_left_m, up = wall.upper_left_m - wall.lower_left_m;
    const double width = glm::length(right), height = glm::length(up);
    for (const auto& [at, length] : {std::pair(lower_right, width), std::pair(upper_left, height)})
        if (length < 1e-3)
            complain(at, "is less than a millimetre from \"lower_left_m\"; two different corners of the wall are right");
    // The cosine of the angle at the corner: the sideways displacement of the upper edge per metre of height.
    const double slip = std::abs(glm::dot(right, up)) / (width * height);
    if (slip > 1e-3)
        complain(upper_left,
            "makes no right angle with the other corners (" + shown(std::round(slip * 1e4) / 10)
                + " mm off per metre); corners of a rectangle, within 1 mm per metre, are right");
    return wall;
}

Fisheye read_fisheye(const Place& place)
{
    Fisheye fisheye;
    take(place, "aperture_deg", fisheye.aperture_deg, {1, 360});
    take(place, "tilt_deg", fisheye.tilt_deg, {-180, 180});
    take(place, "rotation_deg", fisheye.rotation_deg, whole_turn);
    if (auto p = find_member(place, "mapping"))
        fisheye.mapping = chosen<FisheyeMapping>(*p,
            {{"equidistant", FisheyeMapping::equidistant}, {"equisolid", FisheyeMapping::equisolid},
                {"stereographic", FisheyeMapping::stereographic}, {"orthographic", FisheyeMapping::orthographic}});
    // An orthographic picture folds back beyond a half sphere; a stereographic one grows without limit towards a whole
    // sphere.
    const auto aperture = find_member(place, "aperture_deg");
    if (fisheye.mapping == FisheyeMapping::orthographic && fisheye.aperture_deg > 180)
        complain(*aperture, "is more than an orthographic picture can hold; a number from 1 to 180 is right");
    if (fisheye.mapping == FisheyeMapping::stereographic && fisheye.aperture_deg > 350)
        complain(*aperture, "is more than a stereographic picture can hold; a number from 1 to 350 is right");
    take(place, "centre", fisheye.centre, {-10, 10});
    take(place, "diameter", fisheye.diameter, {0.01, 100});
    return fisheye;
}

SphericalMirror read_mirror(const Place& place)
{
    SphericalMirror mirror;
    mirror.projector_m = vec3(member(place, "projector_m"), room_m);
    const Place projector = member(place, "projector");
    reject_unknown_members(projector, {"fov_y_deg", "fov_x_deg", "sides_deg", "turn_deg"});
    mirror.projector = read_planar(projector);
    mirror.mirror_m = vec3(member(place, "mirror_m"), room_m);
    mirror.mirror_radius_m = number(member(place, "mirror_radius_m"), {0.001, 1000});
    take(place, "dome_m", mirror.dome_m, room_m);
    mirror.dome_radius_m = number(member(place, "dome_radius_m"), {0.01, 1e4});
    take(place, "dome_tilt_deg", mirror.dome_tilt_deg, {-180, 180});
    take(place, "dome_aperture_deg", mirror.dome_aperture_deg, {1, 360});
    if (glm::distance(mirror.projector_m, mirror.mirror_m) <= mirror.mirror_radius_m)
        complain(member(place, "projector_m"), "lies inside the mirror's sphere; a place before the mirror is right");
    if (glm::distance(mirror.mirror_m, mirror.dome_m) >= mirror.dome_radius_m)
        complain(member(place, "mirror_m"),
            "lies outside the dome, more than \"dome_radius_m\" from its centre; a mirror inside the dome is right");
    return mirror;
}

double lens_factor(Lens::Form form, const std::array<double, 4>& k, double r)
{
    const double r2 = r * r;
    return form == Lens::Form::panotools ? ((k[0] * r + k[1]) * r + k[2]) * r + k[3]
                                         : 1 / (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) + k[3];
}

Lens::Colour read_lens_colour(const Place& place, Lens::Form form)
{
    reject_unknown_members(place, {"centre", "k"});
    Lens::Colour colour;
    take(place, "centre", colour.centre, {-1, 2});
    const Place k = member(place, "k");
    const glm::dvec4 numbers = vec4(k, {-1e3, 1e3});
    colour.k = {numbers[0], numbers[1], numbers[2], numbers[3]};
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
        const double r = lens_reach * i / steps, factor = lens_factor(form, colour.k, r);
        if (!(factor > 1e-3 && factor < 1e3))
            complain(k,
                "makes the lens's factor " + shown(std::round(factor * 1e4) / 1e4) + " at radius " + shown(r)
                    + "; numbers that keep it from 0.001 to 1000 out to radius 1 are right");
    }
    return colour;
}

Lens read_lens(const Place& place)
{
    Lens lens;
    if (auto p = find_member(place, "form"))
        lens.form = chosen<Lens::Form>(*p, {{"panotools", Lens::Form::panotools}, {"vive", Lens::Form::vive}});
    take(place, "fov_y_deg", lens.fov_y_deg, fov);
    take_turn(place, lens.turn);
    // A lens without dispersion is given once, as green.
    lens.colours.fill(read_lens_colour(member(place, "green"), lens.form));
    if (auto p = find_member(place, "red"))
        lens.colours[0] = read_lens_colour(*p, lens.form);
    if (auto p = find_member(place, "blue"))
        lens.colours[2] = read_lens_colour(*p, lens.form);
    return lens;
}

} // namespace

Projection read_projection(const Place& place)
{
    if (!place.json->is_object())
        reject_unknown_members(place, {});
    const std::string type = one_of(
        member(place, "type"), {"planar", "wall", "fisheye", "cylinder", "equirectangular", "cube", "mirror", "lens"});
    if (type == "planar") {
        reject_unknown_members(place, {"type", "fov_y_deg", "fov_x_deg", "sides_deg", "turn_deg"});
        return read_planar(place);
    }
    if (type == "wall") {
        reject_unknown_members(place, {"type", "lower_left_m", "lower_right_m", "upper_left_m"});
        return read_wall(place);
    }
    if (type == "fisheye") {
        reject_unknown_members(place, {"type", "aperture_deg", "tilt_deg", "rotation_deg", "mapping", "centre", "diameter"});
        return read_fisheye(place);
    }
    if (type == "cylinder") {
        reject_unknown_members(place, {"type", "sides_deg", "turn_deg"});
        Cylinder cylinder;
        if (auto p = find_member(place, "sides_deg"))
            cylinder.sides = read_sides(*p, whole_turn, {-89, 89});
        take_turn(place, cylinder.turn);
        return cylinder;
    }
    if (type == "equirectangular") {
        reject_unknown_members(place, {"type", "sides_deg", "turn_deg"});
        Equirectangular picture;
        if (auto p = find_member(place, "sides_deg"))
            picture.sides = read_sides(*p, whole_turn, {-90, 90});
        take_turn(place, picture.turn);
        return picture;
    }
    if (type == "cube") {
        reject_unknown_members(place, {"type", "arrangement", "turn_deg"});
        CubeFaces cube;
        if (auto p = find_member(place, "arrangement"))
            cube.arrangement = chosen<CubeFaces::Arrangement>(
                *p, {{"row", CubeFaces::Arrangement::row}, {"cross", CubeFaces::Arrangement::cross}});
        take_turn(place, cube.turn);
        return cube;
    }
    if (type == "mirror") {
        reject_unknown_members(place,
            {"type", "projector_m", "projector", "mirror_m", "mirror_radius_m", "dome_m", "dome_radius_m", "dome_tilt_deg",
                "dome_aperture_deg"});
        return read_mirror(place);
    }
    reject_unknown_members(place, {"type", "form", "fov_y_deg", "turn_deg", "red", "green", "blue"});
    return read_lens(place);
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
            complain(place, "is seen from behind by the eye at " + eye + "; corners as the visitor sees them are right");
        if (distance < least)
            complain(place,
                "is a wall that touches the eye at " + eye + "; an eye more than " + shown(least)
                    + " m before the wall's plane is right");
    }
    if (const SphericalMirror* mirror = std::get_if<SphericalMirror>(&projection))
        if (glm::distance(eye_m, mirror->dome_m) + eyes_apart_m / 2 > mirror->dome_radius_m * 0.999)
            complain(place, "is a dome whose eye, at " + eye + ", is outside; an \"eye_m\" inside the dome is right");
}

} // namespace starbow
