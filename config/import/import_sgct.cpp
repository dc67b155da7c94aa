#include "import_sgct.h"
#include "config/model/turn.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;
using Reasons = std::map<std::string_view, std::string_view>;

constexpr Range any{-1e9, 1e9}, metres{-1000, 1000}, turn_range{-360, 360};

constexpr std::string_view elsewhere = "a layout says what is shown where; this is not part of it";
constexpr std::string_view chosen_here = "the program chooses it";

/// An SGCT user: the eyes' place.
struct User {
    std::string name;
    glm::dvec3 pos{0};
    double separation = 0;
};

/// True for a flat projection, which SGCT draws without a cube map.
bool is_flat(const std::string& projection)
{
    return projection == "PlanarProjection" || projection == "TextureMappedProjection" || projection == "ProjectionPlane";
}

Json list(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

class Importer {
public:
    Importer(const Document& document, int node, std::filesystem::path folder, LookInto look_into)
        : document_(document)
        , node_(node)
        , folder_(std::move(folder))
        , look_into_(std::move(look_into))
    {
    }

    Import run();

private:
    void became(const Place& place, const std::string& what) { out_.lines.push_back(place.pointer + "  -> " + what); }
    void not_mapped(const Place& place, std::string_view reason)
    {
        out_.lines.push_back(place.pointer + "  not mapped: " + std::string(reason));
    }
    /// Reports a member that has no place in a layout.
    void leftover(const Place& place, const std::string& name, const Reasons& reasons)
    {
        const auto found = reasons.find(name);
        not_mapped(place, found != reasons.end() ? found->second : "SGCT's configurations have no such name here");
    }
    /// Calls take(name, place) for every member of an object; members that it does not take are reported.
    template <class Take> void members(const Place& place, const Reasons& reasons, Take take)
    {
        if (!place.json->is_object())
            complain(place, "is not an object; an object in { } is right");
        for (const auto& [name, value] : place.json->items()) {
            const Place at{place.document, &value, place.pointer + "/" + escaped(name)};
            if (!take(name, at))
                leftover(at, name, reasons);
        }
    }

    glm::dvec2 xy(const Place& place, Range range)
    {
        return {number(member(place, "x"), range), number(member(place, "y"), range)};
    }
    glm::dvec3 xyz(const Place& place)
    {
        return {number(member(place, "x"), metres), number(member(place, "y"), metres), number(member(place, "z"), metres)};
    }
    std::string file(const Place& place) { return (folder_ / text(place)).lexically_normal().generic_string(); }

    std::vector<Place> nodes(const Place& top);
    void user(const Place& place);
    std::optional<Json> window(const Place& place, std::size_t index, bool alone);
    std::optional<Json> viewport(const Place& place, glm::ivec2 window_size);
    std::optional<Json> projection(const Place& place, glm::dvec2 pixels);
    std::optional<MeshView> mesh_view(const Place& viewport);
    Json planar(const Place& place);
    Json wall(const Place& place);
    Json fisheye(const Place& place, glm::dvec2 pixels);
    Json cylinder(const Place& place);
    Json turn(const Place& place);
    std::string packing(const Place& place);
    std::string output_name(const std::string& wanted);

    const Document& document_;
    int node_;
    std::filesystem::path folder_;
    LookInto look_into_;
    Import out_;
    std::vector<User> users_;
    std::vector<std::string> names_; ///< of outputs so far
};

Import Importer::run()
{
    const Place top = root(document_);
    const std::vector<Place> all = nodes(top);
    if (node_ < 0 || node_ >= int(all.size()))
        throw InputError(document_.file, "/nodes",
            "has no node " + std::to_string(node_) + "; one from 0 to " + std::to_string(int(all.size()) - 1) + " is right");
    // Users are read before the viewports, whatever their order in the file.
    std::vector<std::string> before;
    if (const auto users = find_member(top, "users"))
        for (const Place& place : items(*users, 0, 64, "users"))
            user(place);
    std::swap(before, out_.lines);

    Json outputs = Json::array();
    members(top,
        {{"masteraddress", "one machine shows a layout"}, {"debuglog", elsewhere}, {"threadaffinity", elsewhere},
            {"firmsync", "one machine shows a layout"}, {"scene", "a shot says where in the world the visitor is"},
            {"capture", "starbow render takes its own options"}, {"trackers", "no head tracker is read"},
            {"settings", elsewhere}, {"generator", elsewhere}, {"meta", "a layout is named by its file"},
            {"$schema", elsewhere}},
        [&](const std::string& name, const Place& place) {
            if (name == "version")
                became(place, "read as SGCT's JSON format, version " + std::to_string(integer(place, 1, 1)));
            else if (name == "users")
                out_.lines.insert(out_.lines.end(), before.begin(), before.end());
            else if (name == "nodes") {
                for (std::size_t i = 0; i < all.size(); ++i)
                    if (int(i) != node_)
                        not_mapped(all[i],
                            "node " + std::to_string(node_) + " is taken; --node " + std::to_string(i) + " takes this one");
                    else
                        members(all[i],
                            {{"address", "one machine shows a layout"}, {"port", "one machine shows a layout"},
                                {"datatransferport", "one machine shows a layout"},
                                {"swaplock", "one machine shows a layout"}},
                            [&](const std::string& part, const Place& windows) {
                                if (part != "windows")
                                    return false;
                                std::size_t index = 0;
                                const std::vector<Place> each = items(windows, 1, 64, "windows");
                                for (const Place& at : each)
                                    if (auto output = window(at, index++, each.size() == 1)) {
                                        if (output->contains("monitor"))
                                            out_.to_mend.push_back("/outputs/" + std::to_string(outputs.size())
                                                + "/monitor/connector: "
                                                + (*output)["monitor"]["connector"].get<std::string>()
                                                + " stands in for the monitor's name; one that 'starbow displays' lists is "
                                                  "right");
                                        outputs.push_back(*output);
                                    }
                                return true;
                            });
            } else
                return false;
            return true;
        });
    if (outputs.empty())
        throw InputError(document_.file, "/nodes/" + std::to_string(node_),
            "has no window of which something could be made; "
            "one with a PlanarProjection, ProjectionPlane, FisheyeProjection, CylindricalProjection or "
            "EquirectangularProjection is right");
    Json layout;
    for (const User& each : users_)
        if (each.name.empty() && each.separation > 0)
            layout["stereo"] = {{"separation_m", each.separation}};
    layout["outputs"] = std::move(outputs);
    out_.layout = std::move(layout);
    return std::move(out_);
}

std::vector<Place> Importer::nodes(const Place& top)
{
    if (!top.json->is_object())
        complain(top, "is not an object; an SGCT configuration in { } is right");
    if (document_.root.contains("nodes"))
        return items(member(top, "nodes"), 1, 1024, "nodes");
    complain(top, "lacks \"nodes\"; an SGCT configuration with this member is right");
}

void Importer::user(const Place& place)
{
    User user;
    if (const auto name = find_member(place, "name"))
        user.name = text(*name);
    const std::string whose
        = user.name.empty() ? "of every viewport without a user of its own" : "of the viewports of user " + user.name;
    members(place,
        {{"orientation", "the visitor's look belongs to a shot"}, {"matrix", "the visitor's look belongs to a shot"},
            {"tracking", "no head tracker is read"}},
        [&](const std::string& name, const Place& at) {
            if (name == "name")
                became(at, "used to find the eyes of its viewports");
            else if (name == "eyeseparation") {
                user.separation = number(at, {0, 10});
                if (user.name.empty())
                    became(at, "/stereo/separation_m " + shown(user.separation));
                else
                    not_mapped(at, "all viewports of a layout share one separation, that of the user without a name");
            } else if (name == "pos") {
                user.pos = xyz(at);
                became(at, "eye_m " + whose);
            } else
                return false;
            return true;
        });
    users_.push_back(user);
}

std::string Importer::output_name(const std::string& wanted)
{
    std::string name;
    for (char c : wanted)
        name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '-';
    name.resize(std::min<std::size_t>(name.size(), 56));
    std::string free = name;
    for (int i = 2; std::find(names_.begin(), names_.end(), free) != names_.end(); ++i)
        free = name + "-" + std::to_string(i);
    names_.push_back(free);
    return free;
}

std::string Importer::packing(const Place& place)
{
    const std::string mode = text(place);
    const std::map<std::string_view, std::string_view> packings{{"none", "mono"}, {"no_stereo", "mono"},
        {"checkerboard", "checkerboard"}, {"anaglyph_red_cyan", "anaglyph-red-cyan"},
        {"anaglyph_amber_blue", "anaglyph-amber-blue"}, {"anaglyph_wimmer", "anaglyph-dubois"},
        {"vertical_interlaced", "rows"}, {"side_by_side", "side-by-side"}, {"top_bottom", "top-and-bottom"}};
    if (const auto found = packings.find(mode); found != packings.end()) {
        const std::string note = mode == "anaglyph_wimmer" ? ", made for the same glasses" : "";
        became(place, "packing " + std::string(found->second) + note);
        return std::string(found->second);
    }
    if (mode.ends_with("_inverted"))
        not_mapped(place, "in every packing the left eye comes first; packing mono is written");
    else if (mode == "active" || mode == "quadbuffer")
        not_mapped(place, "no picture is shown by quad buffering; packing mono is written");
    else if (mode == "test" || mode == "dummy")
        not_mapped(place, "it is a test of SGCT's; packing mono is written");
    else
        complain(place, "is no stereo mode of SGCT's; none or side_by_side is right, for example");
    return "mono";
}

std::optional<Json> Importer::window(const Place& place, std::size_t index, bool alone)
{
    Json output;
    const Place size_at = member(place, "size");
    const glm::ivec2 size(integer(member(size_at, "x"), 1, 16384), integer(member(size_at, "y"), 1, 16384));
    const auto name_at = find_member(place, "name");
    output["name"] = output_name(name_at ? text(*name_at) : "window" + std::to_string(index));
    output["size"] = Json::array({size.x, size.y});
    const auto fullscreen_at = find_member(place, "fullscreen"), monitor_at = find_member(place, "monitor");
    const bool fullscreen = fullscreen_at && boolean(*fullscreen_at);
    if (fullscreen) {
        output["whole_monitor"] = true;
        // SGCT numbers monitors, a layout names them. Several windows need at least different names.
        if (!alone)
            output["monitor"]
                = {{"connector", "SGCT-monitor-" + std::to_string(monitor_at ? integer(*monitor_at, -1, 1024) : 0)}};
    }
    Json viewports = Json::array();
    members(place,
        {{"id", elsewhere}, {"tags", elsewhere}, {"bufferbitdepth", chosen_here}, {"autoiconify", elsewhere},
            {"hidemousecursor", "the pointer rests by itself"}, {"floating", elsewhere}, {"alwaysrender", elsewhere},
            {"hidden", "every output is shown; starbow render draws without a window"}, {"takescreenshot", elsewhere},
            {"alpha", "an output is opaque"}, {"msaa", chosen_here}, {"fxaa", chosen_here},
            {"border", "a window has a frame unless it has monitor, whole_monitor or place"}, {"draw2d", elsewhere},
            {"draw3d", "every output shows the world"}, {"noerror", elsewhere},
            {"blitwindowid", "an output is not copied; one with preview shows all others small"},
            {"monitor", "a layout names a monitor by its connector, model, serial number or position, not by a number"},
            {"spout", "pictures are not shared with other programs"}, {"ndi", "pictures are not sent over the network"},
            {"scalablemesh", "name the mesh as the viewport's"},
            {"mpcdi", "give each region a viewport with the file as its warp"}, {"doublebuffered", chosen_here},
            {"swapinterval", chosen_here}},
        [&](const std::string& name, const Place& at) {
            if (name == "size")
                became(at, "size");
            else if (name == "name")
                became(at, "name " + output["name"].get<std::string>());
            else if (name == "pos" && fullscreen)
                not_mapped(at, "the window covers its monitor");
            else if (name == "monitor" && output.contains("monitor"))
                became(at, "monitor, a connector that stands in for its name");
            else if (name == "pos") {
                output["place"]
                    = Json::array({integer(member(at, "x"), -65536, 65536), integer(member(at, "y"), -65536, 65536)});
                became(at, "place, counted from the monitor's corner, where SGCT counts from the desktop's");
            } else if (name == "res") {
                if (xy(at, {1, 65536}) == glm::dvec2(size))
                    became(at, "size, which it equals");
                else
                    not_mapped(at, "an output is drawn at its own size");
            } else if (name == "fullscreen") {
                became(at, fullscreen ? "whole_monitor" : "a window");
            } else if (name == "resizable") {
                output["resizable"] = boolean(at);
                became(at, "resizable");
            } else if (name == "stereo") {
                output["packing"] = packing(at);
            } else if (name == "mirrorx" || name == "mirrory") {
                if (boolean(at))
                    not_mapped(at, "no output is mirrored; turn the projector's picture about");
                else
                    became(at, "nothing is mirrored");
            } else if (name == "viewports") {
                for (const Place& each : items(at, 0, 64, "viewports"))
                    if (auto made = viewport(each, size))
                        viewports.push_back(*made);
            } else
                return false;
            return true;
        });
    if (viewports.empty()) {
        not_mapped(place, "no viewport is left; the window is left out");
        names_.pop_back();
        return {};
    }
    output["viewports"] = std::move(viewports);
    return output;
}

/// The view that replaces a viewport's flat one because of its mesh. SGCT takes it from SCISS, Scalable and SkySkan files,
/// by their names (CorrectionMesh::loadMesh, whose loaders call setViewPlaneCoordsUsingFOVs). It reads no domeprojection
/// frustum, and a fisheye or panorama stays the warped picture.
std::optional<MeshView> Importer::mesh_view(const Place& viewport)
{
    const auto mesh = find_member(viewport, "mesh"), shown = find_member(viewport, "projection");
    if (!mesh)
        return {};
    if (shown && !is_flat(text(member(*shown, "type"))))
        return {};
    const std::filesystem::path file = text(*mesh);
    const std::string kind = file.extension().string();
    if (kind != ".sgc" && kind != ".ol" && kind != ".txt" && kind != ".skyskan")
        return {};
    MeshView view = look_into_(file);
    if (!view.frustum)
        return {};
    if (kind == ".ol")
        view.eye_m.reset(); // SGCT does not move the user
    return view;
}

std::optional<Json> Importer::viewport(const Place& place, glm::ivec2 window_size)
{
    Json out;
    glm::dvec2 corner(0), size(1);
    if (const auto at = find_member(place, "pos"))
        corner = xy(*at, any);
    if (const auto at = find_member(place, "size"))
        size = xy(*at, any);
    // The corner is converted from SGCT's lower left to the upper left.
    const glm::dvec2 low = glm::clamp(corner, 0.0, 1.0), high = glm::clamp(corner + size, 0.0, 1.0);
    const bool cut = glm::length(low - corner) > 1e-9 || glm::length(high - corner - size) > 1e-9;
    if (!(high.x > low.x && high.y > low.y)) {
        not_mapped(place, "lies outside its window; the viewport is left out");
        return {};
    }
    if (low != glm::dvec2(0) || high != glm::dvec2(1))
        out["rect"] = Json::array({low.x, 1 - high.y, high.x - low.x, high.y - low.y});
    bool usable = true;
    const auto user_at = find_member(place, "user");
    const std::string wanted = user_at ? text(*user_at) : "";
    const auto whose = std::find_if(users_.begin(), users_.end(), [&](const User& user) { return user.name == wanted; });
    const std::optional<MeshView> own = mesh_view(place);
    const glm::dvec3 given = whose != users_.end() ? whose->pos : glm::dvec3(0),
                     eye = own ? own->eye_m.value_or(given) : given;
    if (eye != glm::dvec3(0))
        out["eye_m"] = list(eye);
    members(place,
        {{"overlay", "nothing is drawn over the world but the head-up display"}, {"tracked", "no head tracker is read"},
            {"blacklevelmask", "SGCT multiplies by it; black_level is added, and needs a picture of that kind"},
            {"type", "the projection's own type counts"}},
        [&](const std::string& name, const Place& at) {
            if (name == "pos" || name == "size")
                became(at,
                    std::string("rect, counted from the upper left corner")
                        + (cut ? ", cut off at the window's edges" : ""));
            else if (name == "user") {
                if (whose != users_.end())
                    became(at, "eye_m, that of user " + wanted);
                else
                    not_mapped(at, "there is no user of this name");
            } else if (name == "eye") {
                const std::string eye = one_of(at, {"center", "left", "right"});
                if (eye != "center")
                    out["eye"] = eye;
                became(at, eye == "center" ? "eye middle" : "eye " + eye);
            } else if (name == "mesh") {
                out["warp"] = {{"file", file(at)}};
                became(at,
                    "warp, file " + file(at) + (own ? ", which brings its own view" : "")
                        + (eye != given ? " and eye" : ""));
            } else if (name == "blendmask") {
                out["alpha_mask"] = file(at);
                became(at, "alpha_mask " + file(at));
            } else if (name == "projection" && own) {
                not_mapped(at, "replaced by the mesh's own");
            } else if (name == "projection") {
                auto made = projection(at, (high - low) * glm::dvec2(window_size));
                usable = made.has_value();
                if (made)
                    out["projection"] = std::move(*made);
            } else
                return false;
            return true;
        });
    if (!out.contains("projection") && !out.contains("warp"))
        usable = false;
    if (!usable) {
        not_mapped(place, "has no projection of a kind that a layout has; the viewport is left out");
        return {};
    }
    return out;
}

std::optional<Json> Importer::projection(const Place& place, glm::dvec2 pixels)
{
    const Place type_at = member(place, "type");
    const std::string type = text(type_at);
    if (type == "PlanarProjection" || type == "TextureMappedProjection")
        return planar(place);
    if (type == "ProjectionPlane")
        return wall(place);
    if (type == "FisheyeProjection")
        return fisheye(place, pixels);
    if (type == "CylindricalProjection")
        return cylinder(place);
    if (type == "EquirectangularProjection") {
        members(place, {{"quality", chosen_here}}, [&](const std::string& name, const Place& at) {
            if (name == "type")
                became(at, "projection equirectangular, the whole sphere");
            return name == "type";
        });
        return Json{{"type", "equirectangular"}};
    }
    const Reasons reasons{{"type",
        type == "SphericalMirrorProjection"
            ? "its four meshes bend four pictures; give each a viewport with its OBJ as warp, or use a mirror"
            : type == "CubemapProjection" ? "its faces go to other programs; a cube shows them in one picture"
                                          : "it is no projection that is known here"}};
    for (const auto& [name, value] : place.json->items())
        not_mapped({place.document, &value, place.pointer + "/" + escaped(name)},
            name == "type" ? reasons.begin()->second : "its projection is not mapped");
    return {};
}

Json Importer::turn(const Place& place)
{
    Turn turn;
    if (find_member(place, "w")) {
        const double x = number(member(place, "x"), {-1.01, 1.01}), y = number(member(place, "y"), {-1.01, 1.01}),
                     z = number(member(place, "z"), {-1.01, 1.01}), w = number(member(place, "w"), {-1.01, 1.01});
        const double length = std::sqrt(x * x + y * y + z * z + w * w);
        if (std::abs(length - 1) > 0.01)
            complain(place, "is a quaternion of length " + shown(length) + "; length 1 is right");
        turn = turn_of(x / length, y / length, z / length, w / length);
    } else
        turn = {number(member(place, "yaw"), turn_range), number(member(place, "pitch"), turn_range),
            number(member(place, "roll"), turn_range)};
    became(
        place, "turn_deg, yaw " + shown(turn.yaw_deg) + " pitch " + shown(turn.pitch_deg) + " roll " + shown(turn.roll_deg));
    return {{"yaw", turn.yaw_deg}, {"pitch", turn.pitch_deg}, {"roll", turn.roll_deg}};
}

Json Importer::planar(const Place& place)
{
    Json out{{"type", "planar"}};
    const auto zero = [&](const Place& at) { return xyz(at) == glm::dvec3(0); };
    members(place, {{"distance", "the windows of two eyes are parallel, at no distance"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                became(at, "projection planar");
            else if (name == "fov") {
                const Range angle{-89.9, 89.9}, whole{0.1, 179};
                Sides s{};
                if (find_member(at, "hfov")) {
                    const double h = number(member(at, "hfov"), whole) / 2, v = number(member(at, "vfov"), whole) / 2;
                    s = {-h, h, -v, v};
                } else
                    s = {-number(member(at, "left"), angle), number(member(at, "right"), angle),
                        -number(member(at, "down"), angle), number(member(at, "up"), angle)};
                if (!(s.left_deg < s.right_deg && s.down_deg < s.up_deg))
                    complain(at, "spans nothing; angles to each side that count from the axis outwards are right");
                out["sides_deg"] = {{"left", s.left_deg}, {"right", s.right_deg}, {"down", s.down_deg}, {"up", s.up_deg}};
                became(at, "sides_deg");
            } else if (name == "orientation")
                out["turn_deg"] = turn(at);
            else if (name == "offset") {
                if (zero(at))
                    became(at, "nothing, it is 0");
                else
                    not_mapped(at, "a flat window has no place; a ProjectionPlane would have one");
            } else
                return false;
            return true;
        });
    if (!out.contains("sides_deg"))
        complain(place, "lacks \"fov\"; an object with this member is right");
    return out;
}

Json Importer::wall(const Place& place)
{
    const glm::dvec3 ll = xyz(member(place, "lowerleft")), ul = xyz(member(place, "upperleft")),
                     ur = xyz(member(place, "upperright"));
    members(place, {}, [&](const std::string& name, const Place& at) {
        if (name == "type")
            became(at, "projection wall");
        else if (name == "lowerleft")
            became(at, "lower_left_m");
        else if (name == "upperleft")
            became(at, "upper_left_m");
        else if (name == "upperright")
            became(at, "lower_right_m, below it");
        else
            return false;
        return true;
    });
    return {{"type", "wall"}, {"lower_left_m", list(ll)}, {"lower_right_m", list(ll + ur - ul)}, {"upper_left_m", list(ul)}};
}

Json Importer::fisheye(const Place& place, glm::dvec2 pixels)
{
    Json out{{"type", "fisheye"}, {"aperture_deg", 180}};
    members(place,
        {{"quality", chosen_here}, {"interpolation", chosen_here},
            {"diameter", "SGCT uses it for two eyes; stereo, baseline and full_from_zenith_deg do that here"},
            {"background", "outside the circle is black"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                became(at, "projection fisheye, equidistant");
            else if (name == "fov") {
                out["aperture_deg"] = number(at, {1, 360});
                became(at, "aperture_deg " + shown(number(at, {1, 360})));
            } else if (name == "tilt") {
                out["tilt_deg"] = number(at, {-180, 180});
                became(at, "tilt_deg " + shown(number(at, {-180, 180})));
            } else if (name == "keepaspectratio") {
                if (boolean(at))
                    became(at, "a circle");
                else
                    not_mapped(at, "a circle stays a circle, whatever the window's shape");
            } else if (name == "crop") {
                const Range part{0, 1};
                const double left = number(member(at, "left"), part), right = number(member(at, "right"), part),
                             bottom = number(member(at, "bottom"), part), top = number(member(at, "top"), part);
                const double wide = 1 - left - right, high = 1 - bottom - top;
                if (!(wide > 0 && high > 0))
                    complain(at, "leaves nothing; less than 1 from opposite sides is right");
                // The rest of the square fills the viewport's width or height and stands in its middle.
                const double side = std::min(pixels.x / wide, pixels.y / high);
                const glm::dvec2 centre(
                    0.5 + side / pixels.x * (0.5 - left - wide / 2), 0.5 + side / pixels.y * (0.5 - top - high / 2));
                out["centre"] = Json::array({centre.x, centre.y});
                out["diameter"] = side / std::min(pixels.x, pixels.y);
                became(at, "centre and diameter; the circle goes on where SGCT's cut leaves a margin");
            } else if (name == "offset") {
                if (xyz(at) == glm::dvec3(0))
                    became(at, "nothing, it is 0");
                else
                    not_mapped(at, "a dome's picture is made for its centre");
            } else
                return false;
            return true;
        });
    return out;
}

Json Importer::cylinder(const Place& place)
{
    double rotation = 0, height = 0;
    members(place, {{"quality", chosen_here}, {"radius", "SGCT uses it for two eyes only"}},
        [&](const std::string& name, const Place& at) {
            if (name == "type")
                became(at,
                    "projection cylinder, once around, ahead at the left edge, from the horizon to 45 degrees unless "
                    "heightoffset says otherwise");
            else if (name == "rotation") {
                rotation = number(at, turn_range);
                became(at, "turn_deg/yaw");
            } else if (name == "heightoffset") {
                height = number(at, {-50, 50});
                became(at, "sides_deg, down and up");
            } else
                return false;
            return true;
        });
    // SGCT's rows show the heights 0 to 1 above heightoffset on a cylinder of radius 1; its columns begin ahead.
    return {{"type", "cylinder"},
        {"sides_deg",
            {{"left", -180}, {"right", 180}, {"down", glm::degrees(std::atan(height))},
                {"up", glm::degrees(std::atan(height + 1))}}},
        {"turn_deg", {{"yaw", std::remainder(180 - rotation, 360.0)}, {"pitch", 0}, {"roll", 0}}}};
}

} // namespace

Import import_sgct(const Document& document, int node, const std::filesystem::path& folder, const LookInto& look_into)
{
    return Importer(document, node, folder, look_into).run();
}

} // namespace starbow
