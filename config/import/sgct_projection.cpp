#include "sgct_projection.h"
#include "config/model/turn.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;

constexpr Range sgct_turn_range{-360, 360};

/// The distance of a flat picture's plane from the origin, where the configuration names none.
constexpr double default_distance_m = 10;

/// The azimuth of a panorama's middle column. SGCT turns the cube map of its panoramas by 45 degrees, and neither shader
/// turns it back: sampled along +y, the cube map shows the direction 45 degrees to the right of straight ahead.
constexpr double cube_map_azimuth_deg = 45;

Json json_of_turn(const Turn& turn) { return {{"yaw", turn.yaw_deg}, {"pitch", turn.pitch_deg}, {"roll", turn.roll_deg}}; }

Turn read_sgct_turn(SgctReport& report, const Place& place)
{
    Turn turn;
    if (find_member(place, "w")) {
        const double x = number(member(place, "x"), {-1.01, 1.01}), y = number(member(place, "y"), {-1.01, 1.01}),
                     z = number(member(place, "z"), {-1.01, 1.01}), w = number(member(place, "w"), {-1.01, 1.01});
        const double length = std::sqrt(x * x + y * y + z * z + w * w);
        if (std::abs(length - 1) > 0.01)
            fail_at(place, "is a quaternion of length " + shown(length) + "; length 1 is right");
        turn = turn_of(x / length, y / length, z / length, w / length);
    } else
        turn = {number(member(place, "yaw"), sgct_turn_range), number(member(place, "pitch"), sgct_turn_range),
            number(member(place, "roll"), sgct_turn_range)};
    report.became(
        place, "turned by yaw " + shown(turn.yaw_deg) + " pitch " + shown(turn.pitch_deg) + " roll " + shown(turn.roll_deg));
    return turn;
}

/// A flat picture in the configuration. Its plane stays where it is when the user stands elsewhere.
struct FlatPicture {
    std::optional<Sides> sides;
    Turn turn;
    glm::dvec3 offset_m{0};
    double distance_m = default_distance_m;
};

/// The new place of a plane's distance.
const char* about_distance(bool wall)
{
    return wall ? "the distance of the wall from the origin, m"
                : "nothing: one eye at the origin sees the same at any distance";
}

Sides read_fov(SgctReport& report, const Place& place, FlatPicture& flat, bool distance_beside, bool wall)
{
    const Range whole{0.1, 179}, angle{-89.9, 89.9};
    Sides s{};
    // Angles to one side replace those of the whole field of view.
    const auto side = [&](const char* one, const char* both) {
        if (const auto at = find_member(place, one))
            return number(*at, angle);
        if (const auto at = find_member(place, both))
            return number(*at, whole) / 2;
        return number(member(place, one), angle);
    };
    s = {-side("left", "hfov"), side("right", "hfov"), -side("down", "vfov"), side("up", "vfov")};
    if (!(s.left_deg < s.right_deg && s.down_deg < s.up_deg))
        fail_at(place, "spans nothing; angles to each side that count from the axis outwards are right");
    report.members(place, {}, [&](const std::string& name, const Place& at) {
        if (name == "distance") {
            if (distance_beside) {
                report.not_mapped(at, "the \"distance\" beside \"fov\" counts");
                return true;
            }
            flat.distance_m = number(at, {0.001, 1000});
            report.became(at, about_distance(wall));
            return true;
        }
        for (const char* known : {"hfov", "vfov", "left", "right", "down", "up"})
            if (name == known) {
                report.became(at, "the picture's edges");
                return true;
            }
        return false;
    });
    return s;
}

Json as_planar(const FlatPicture& flat)
{
    const Sides& s = *flat.sides;
    return {{"type", "planar"},
        {"sides_deg", {{"left", s.left_deg}, {"right", s.right_deg}, {"down", s.down_deg}, {"up", s.up_deg}}},
        {"turn_deg", json_of_turn(flat.turn)}};
}

Json as_wall(const FlatPicture& flat)
{
    const glm::dmat3 axes = cockpit_from_picture(flat.turn);
    const auto corner = [&](double across_deg, double upright_deg) {
        const glm::dvec3 on_axis(std::tan(glm::radians(across_deg)), std::tan(glm::radians(upright_deg)), -1);
        return json_of(axes * (on_axis * flat.distance_m) + flat.offset_m);
    };
    const Sides& s = *flat.sides;
    return {{"type", "wall"}, {"lower_left_m", corner(s.left_deg, s.down_deg)},
        {"lower_right_m", corner(s.right_deg, s.down_deg)}, {"upper_left_m", corner(s.left_deg, s.up_deg)}};
}

/// A planar picture for one eye at the origin of its plane. Any other eye looks askew through the plane: it is a wall.
Json read_flat(SgctReport& report, const Place& place, const SgctView& view)
{
    FlatPicture flat;
    const auto beside = find_member(place, "distance");
    if (beside)
        flat.distance_m = number(*beside, {0.001, 1000});
    if (const auto offset = find_member(place, "offset"))
        flat.offset_m = sgct_xyz(*offset);
    const bool wall = looks_askew(view) || flat.offset_m != glm::dvec3(0);
    report.members(place, {}, [&](const std::string& name, const Place& at) {
        if (name == "type")
            report.became(at,
                !wall               ? "projection planar"
                    : view.two_eyes ? "projection wall, one plane through which both eyes look, as SGCT's do"
                                    : "projection wall, which stays where it is for eyes off the origin");
        else if (name == "fov")
            flat.sides = read_fov(report, at, flat, beside.has_value(), wall);
        else if (name == "orientation")
            flat.turn = read_sgct_turn(report, at);
        else if (name == "offset")
            report.became(at, wall ? "added to the wall's corners" : "nothing, it is 0");
        else if (name == "distance")
            report.became(at, about_distance(wall));
        else
            return false;
        return true;
    });
    if (!flat.sides)
        fail_at(place, "lacks \"fov\"; an object with this member is right");
    return wall ? as_wall(flat) : as_planar(flat);
}

Json read_plane(SgctReport& report, const Place& place)
{
    const glm::dvec3 ll = sgct_xyz(member(place, "lowerleft")), ul = sgct_xyz(member(place, "upperleft")),
                     ur = sgct_xyz(member(place, "upperright"));
    report.members(place, {}, [&](const std::string& name, const Place& at) {
        if (name == "type")
            report.became(at, "projection wall");
        else if (name == "lowerleft")
            report.became(at, "lower_left_m");
        else if (name == "upperleft")
            report.became(at, "upper_left_m");
        else if (name == "upperright")
            report.became(at, "lower_right_m, below it");
        else
            return false;
        return true;
    });
    return {{"type", "wall"}, {"lower_left_m", json_of(ll)}, {"lower_right_m", json_of(ll + ur - ul)},
        {"upper_left_m", json_of(ul)}};
}

/// Says of a round picture that SGCT's is skewed for a user off the origin: there the faces of its cube map stay in the
/// room.
void report_skew(SgctReport& report, const Place& place, const SgctView& view)
{
    if (view.eye_m != glm::dvec3(0))
        report.not_mapped(place,
            "in its skew: SGCT's cube map stays around the origin while the user is elsewhere; this picture is round the "
            "eye");
}

/// The place of a cropped dome's circle in its viewport. The rest of the square fills the viewport's width or height and
/// stands in its middle.
void read_crop(SgctReport& report, const Place& place, glm::dvec2 pixels, Json& out)
{
    const Range part{0, 1};
    const double left = number(member(place, "left"), part), right = number(member(place, "right"), part),
                 bottom = number(member(place, "bottom"), part), top = number(member(place, "top"), part);
    const double wide = 1 - left - right, high = 1 - bottom - top;
    if (!(wide > 0 && high > 0))
        fail_at(place, "leaves nothing; less than 1 from opposite sides is right");
    const double side = std::min(pixels.x / wide, pixels.y / high);
    const glm::dvec2 centre(0.5 + side / pixels.x * (0.5 - left - wide / 2), 0.5 + side / pixels.y * (0.5 - top - high / 2));
    out["centre"] = Json::array({centre.x, centre.y});
    out["diameter"] = side / std::min(pixels.x, pixels.y);
    report.became(place, "centre and diameter; the circle goes on where SGCT's cut leaves a margin");
}

SgctPicture read_fisheye(SgctReport& report, const Place& place, const SgctView& view)
{
    Json out{{"type", "fisheye"}, {"aperture_deg", 180}};
    report.members(place,
        {{"quality", sgct_choice_of_program}, {"interpolation", sgct_choice_of_program},
            {"diameter", "SGCT uses it for two eyes; stereo, baseline and full_from_zenith_deg do that here"},
            {"background", "outside the circle is black"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                report.became(at, "projection fisheye, equidistant");
            else if (name == "fov") {
                out["aperture_deg"] = number(at, {1, 360});
                report.became(at, "aperture_deg " + shown(number(at, {1, 360})));
            } else if (name == "tilt") {
                out["tilt_deg"] = number(at, {-180, 180});
                report.became(at, "tilt_deg " + shown(number(at, {-180, 180})));
            } else if (name == "keepaspectratio") {
                if (boolean(at))
                    report.became(at, "a circle");
                else
                    report.not_mapped(at, "a circle stays a circle, whatever the window's shape");
            } else if (name == "crop") {
                read_crop(report, at, view.pixels, out);
            } else if (name == "offset") {
                if (sgct_xyz(at) == glm::dvec3(0))
                    report.became(at, "nothing, it is 0");
                else
                    report.not_mapped(at, "a dome's picture is made for its centre");
            } else
                return false;
            return true;
        });
    report_skew(report, place, view);
    return {{{.projection = out}}};
}

Json read_cylinder(SgctReport& report, const Place& place, const SgctView& view)
{
    double rotation = 0, height = 0;
    report.members(place, {{"quality", sgct_choice_of_program}, {"radius", "SGCT uses it for two eyes only"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                report.became(at,
                    "projection cylinder, once around, 45 degrees left of ahead in its middle, from the horizon to 45 "
                    "degrees "
                    "unless heightoffset says otherwise");
            else if (name == "rotation") {
                rotation = number(at, sgct_turn_range);
                report.became(at, "turn_deg/yaw");
            } else if (name == "heightoffset") {
                height = number(at, {-50, 50});
                report.became(at, "sides_deg, down and up");
            } else
                return false;
            return true;
        });
    report_skew(report, place, view);
    // SGCT's rows show the heights 0 to 1 above heightoffset on a cylinder of radius 1. Its columns begin along the cube
    // map's +x, 90 degrees to the right of +y, and go to the right; half a turn farther is the middle.
    const double middle = cube_map_azimuth_deg + 90 + 180 - rotation;
    return {{"type", "cylinder"},
        {"sides_deg",
            {{"left", -180}, {"right", 180}, {"down", glm::degrees(std::atan(height))},
                {"up", glm::degrees(std::atan(height + 1))}}},
        {"turn_deg", json_of_turn({std::remainder(middle, 360.0), 0, 0})}};
}

Json read_equirectangular(SgctReport& report, const Place& place, const SgctView& view)
{
    report.members(place, {{"quality", sgct_choice_of_program}}, [&](const std::string& name, const Place& at) {
        if (name == "type")
            report.became(at, "projection equirectangular, the whole sphere, 45 degrees right of ahead in its middle");
        return name == "type";
    });
    report_skew(report, place, view);
    return {{"type", "equirectangular"}, {"turn_deg", json_of_turn({cube_map_azimuth_deg, 0, 0})}};
}

/// The six pictures of a cube in a viewport of three columns and two rows. In the shader their names are those of the
/// textures' units; here they are the directions in which initViewports turns them.
std::vector<SgctPart> read_cube_map(SgctReport& report, const Place& place, const SgctView& view)
{
    struct Face {
        const char* channel;
        int column, row;
        Turn turn;
    };
    const std::array<Face, 6> faces{{{"left", 0, 0, {-90, 0, 0}}, {"bottom", 1, 0, {0, -90, 0}}, {"right", 2, 0, {90, 0, 0}},
        {"zright", 0, 1, {180, 0, 0}}, {"top", 1, 1, {0, 90, 0}}, {"zleft", 2, 1, {0, 0, 0}}}};
    std::array<bool, 6> drawn{true, true, true, true, true, true};
    report.members(place,
        {{"quality", sgct_choice_of_program}, {"spout", "pictures are not shared with other programs"},
            {"ndi", "pictures are not sent over the network"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                report.became(at, "six viewports, three beside each other in two rows, each planar");
            else if (name == "channels")
                report.members(at, {}, [&](const std::string& channel, const Place& flag) {
                    for (std::size_t i = 0; i < faces.size(); ++i)
                        if (channel == faces[i].channel) {
                            drawn[i] = boolean(flag);
                            report.became(flag, drawn[i] ? "a viewport" : "no viewport");
                            return true;
                        }
                    return false;
                });
            else if (name == "orientation") {
                const Turn turn = read_sgct_turn(report, at);
                if (turn.yaw_deg != 0 || turn.pitch_deg != 0 || turn.roll_deg != 0)
                    report.not_mapped(at, "the faces are not turned; set their turn_deg by hand");
            } else
                return false;
            return true;
        });
    report_skew(report, place, view);
    std::vector<SgctPart> parts;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (drawn[i])
            parts.push_back({{faces[i].column / 3.0, faces[i].row / 2.0, 1 / 3.0, 0.5},
                as_planar({.sides = Sides{-45, 45, -45, 45}, .turn = faces[i].turn})});
    return parts;
}

/// A mirror's four meshes, drawn over each other: initViewports and render of SGCT's projection/sphericalmirror.cpp. Each
/// shows one side of a cube whose front is 45 degrees up, less the tilt; the front's mesh is called bottom. SGCT's reader
/// of Bourke meshes divides x by the window's aspect, and the projection's matrix divides it by the viewport's once more.
SgctPicture read_mirror_meshes(SgctReport& report, const Place& place, const SgctView& view)
{
    double tilt = 0;
    if (const auto at = find_member(place, "tilt"))
        tilt = number(*at, {-180, 180});
    const double up = 45 - tilt, aspect = view.window_aspect * view.pixels.x / view.pixels.y;
    struct Face {
        const char* mesh;
        const char* side;
        Turn turn;
    };
    const std::array<Face, 4> faces{{{"bottom", "front", {0, up, 0}}, {"left", "left", {-90, 0, -up}},
        {"right", "right", {90, 0, up}}, {"top", "top", {0, 90 + up, 0}}}};
    SgctPicture picture;
    const Place geometry = member(place, "geometry");
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Place at = member(geometry, faces[i].mesh);
        const std::filesystem::path name = text(at);
        if (name.extension() != ".data") {
            report.leave_out(at,
                "is not a Bourke mesh (.data), for which SGCT has this projection; its files of other kinds bring views of "
                "their own or know no aspect");
            return {};
        }
        picture.parts.push_back({.projection = as_planar({.sides = Sides{-45, 45, -45, 45}, .turn = faces[i].turn}),
            .warp = {{"file", (view.folder / name).lexically_normal().generic_string()}, {"aspect", aspect}},
            .order = int(i)});
    }
    report.members(place, {{"quality", sgct_choice_of_program}, {"background", "what no mesh shows is black"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                report.became(at, "four viewports over each other, each planar with a warp");
            else if (name == "tilt")
                report.became(at, "turn_deg of the four pictures, whose front looks " + shown(up) + " degrees up");
            else if (name == "geometry")
                report.members(at, {}, [&](const std::string& mesh, const Place& file) {
                    for (std::size_t i = 0; i < faces.size(); ++i)
                        if (mesh == faces[i].mesh) {
                            report.became(file,
                                "a viewport of order " + std::to_string(i) + " with the cube's " + faces[i].side
                                    + ", warp, file " + picture.parts[i].warp["file"].get<std::string>() + ", aspect "
                                    + shown(aspect) + ", because SGCT divides x by the window's aspect and the viewport's");
                            return true;
                        }
                    return false;
                });
            else
                return false;
            return true;
        });
    report_skew(report, place, view);
    return picture;
}

} // namespace

bool is_flat_in_sgct(const std::string& type)
{
    return type == "PlanarProjection" || type == "TextureMappedProjection" || type == "ProjectionPlane";
}

bool looks_askew(const SgctView& view) { return view.two_eyes || view.eye_m != glm::dvec3(0); }

Json sgct_wall(const Planar& frustum) { return as_wall({.sides = frustum.sides, .turn = frustum.turn}); }

SgctPicture sgct_projection(SgctReport& report, const Place& place, const SgctView& view)
{
    const auto whole = [](Json projection) { return SgctPicture{{{.projection = std::move(projection)}}}; };
    const Place type_at = member(place, "type");
    const std::string type = text(type_at);
    if (type == "PlanarProjection" || type == "TextureMappedProjection")
        return whole(read_flat(report, place, view));
    if (type == "ProjectionPlane")
        return whole(read_plane(report, place));
    if (type == "FisheyeProjection")
        return read_fisheye(report, place, view);
    if (type == "CylindricalProjection")
        return whole(read_cylinder(report, place, view));
    if (type == "EquirectangularProjection")
        return whole(read_equirectangular(report, place, view));
    if (type == "CubemapProjection")
        return {read_cube_map(report, place, view)};
    if (type == "SphericalMirrorProjection")
        return read_mirror_meshes(report, place, view);
    for (const auto& [name, value] : place.json->items()) {
        const Place at{place.document, &value, place.pointer + "/" + escaped(name)};
        if (name != "type")
            report.not_mapped(at, "its projection is not mapped");
        else
            report.leave_out(at, "is \"" + one_line(type, 60) + "\", no projection of SGCT's that is known here");
    }
    return {};
}

} // namespace starbow
