#include "import_sgct.h"
#include "config/json/whole_file.h"
#include "sgct_projection.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <map>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;
using Reasons = SgctReport::Reasons;

constexpr Range any_fraction{-1e9, 1e9};

constexpr std::string_view elsewhere = "a layout says what is shown where; this is not part of it";
constexpr std::string_view other_tracker
    = "SGCT's trackers speak VRPN; \"head_tracker\" beside a layout's outputs reads opentrack's UDP";

/// The gamma of an ordinary screen or projector.
constexpr double display_gamma = 2.2;

/// The factor of the shipped stereo layouts, for worlds whose unit is a light-second.
constexpr double light_seconds_hyper_stereo = 1.5e8;

/// An SGCT user: the eyes' place.
struct User {
    std::string name;
    glm::dvec3 pos{0};
    double separation = 0;
};

class Importer {
public:
    Importer(const Document& document, std::optional<int> node, std::filesystem::path folder, LookInto look_into)
        : document_(document)
        , node_(node)
        , folder_(std::move(folder))
        , look_into_(std::move(look_into))
    {
    }

    Import run();

private:
    void became(const Place& place, const std::string& what) { report_.became(place, what); }
    void not_mapped(const Place& place, std::string_view reason) { report_.not_mapped(place, reason); }
    template <class Take> void members(const Place& place, const Reasons& reasons, Take take)
    {
        report_.members(place, reasons, take);
    }

    glm::dvec2 xy(const Place& place, Range range)
    {
        return {number(member(place, "x"), range), number(member(place, "y"), range)};
    }
    std::string file(const Place& place) { return (folder_ / text(place)).lexically_normal().generic_string(); }

    std::vector<Place> nodes(const Place& top);
    void user(const Place& place);
    void node(const Place& place);
    std::string master_of(const std::vector<Place>& all, const std::string& address);
    glm::ivec2 window_size(const Place& window);
    void monitor(const Place& window, bool alone, Json& output);
    std::optional<Json> window(const Place& place, std::size_t index, bool alone);
    bool window_member(const std::string& name, const Place& at, glm::ivec2 size, Json& output);
    std::vector<Json> viewport(const Place& place, glm::ivec2 window_size, bool packed);
    void lay_over(const Place& place, std::vector<Json>& made, const Json& earlier);
    std::optional<MeshView> mesh_view(const Place& viewport);
    void mesh(const Place& at, const Place& viewport, Json& out);
    void mesh_with_view(
        const Place& at, const MeshView& own, const SgctView& view, bool own_eye, Json& out, SgctPicture& picture);
    std::string packing(const Place& place);
    std::string output_name(const std::string& wanted);

    const Document& document_;
    std::optional<int> node_; ///< the only one that is taken
    std::string machine_; ///< of the node that is read now; empty: the layout has one
    std::filesystem::path folder_;
    LookInto look_into_;
    SgctReport report_;
    Json outputs_ = Json::array();
    std::vector<std::string> to_mend_;
    bool two_eyes_ = false; ///< some viewport shows the picture of one of two eyes
    std::vector<User> users_;
    std::vector<std::string> names_; ///< of outputs so far
};

Import Importer::run()
{
    const Place top = root(document_);
    const std::vector<Place> all = nodes(top);
    if (node_ && (*node_ < 0 || *node_ >= int(all.size())))
        throw InputError(document_.file, "/nodes",
            "has no node " + std::to_string(*node_) + "; one from 0 to " + std::to_string(int(all.size()) - 1)
                + " is right");
    // Users are read before the viewports, whatever their order in the file.
    std::vector<std::string> before;
    if (const auto users = find_member(top, "users"))
        for (const Place& place : items(*users, 0, 64, "users"))
            user(place);
    std::swap(before, report_.lines);

    members(top,
        {{"masteraddress", "one machine shows this layout"}, {"debuglog", elsewhere}, {"threadaffinity", elsewhere},
            {"firmsync", "the machines of an exhibit wait for each other"},
            {"scene", "a shot says where in the world the visitor is"}, {"capture", "starbow render takes its own options"},
            {"trackers", other_tracker}, {"settings", elsewhere}, {"generator", elsewhere},
            {"meta", "a layout is named by its file"}, {"$schema", elsewhere}},
        [&](const std::string& name, const Place& place) {
            if (name == "version")
                became(place, "read as SGCT's JSON format, version " + std::to_string(integer(place, 1, 1)));
            else if (name == "users")
                report_.lines.insert(report_.lines.end(), before.begin(), before.end());
            else if (name == "nodes") {
                for (std::size_t i = 0; i < all.size(); ++i) {
                    machine_ = node_ || all.size() == 1 ? "" : "node" + std::to_string(i);
                    if (!node_ || int(i) == *node_)
                        node(all[i]);
                    else
                        not_mapped(all[i],
                            "node " + std::to_string(*node_) + " is taken; --node " + std::to_string(i)
                                + " takes this one, and all are taken without --node");
                }
            } else if (name == "masteraddress" && !node_ && all.size() > 1)
                became(place, master_of(all, text(place)));
            else
                return false;
            return true;
        });
    if (outputs_.empty()) {
        std::string reasons;
        for (const std::string& line : report_.left_out)
            reasons += (reasons.empty() ? ": " : ", and ") + line;
        throw InputError(document_.file, node_ || all.size() == 1 ? "/nodes/" + std::to_string(node_.value_or(0)) : "/nodes",
            "has no window that can be imported" + one_line(reasons, 600)
                + "; one with a PlanarProjection, TextureMappedProjection, ProjectionPlane, FisheyeProjection, "
                  "CylindricalProjection, EquirectangularProjection, CubemapProjection or SphericalMirrorProjection is "
                  "right");
    }
    Json layout;
    for (const User& each : users_)
        if (each.name.empty() && each.separation > 0)
            layout["stereo"] = {{"separation_m", each.separation}};
    if (two_eyes_) {
        layout["stereo"]["hyper_stereo"] = light_seconds_hyper_stereo;
        report_.lines.push_back("/nodes  -> /stereo/hyper_stereo " + shown(light_seconds_hyper_stereo)
            + ", for the shipped worlds, whose unit is a light-second; 1 for worlds in "
              "metres");
    }
    layout["outputs"] = std::move(outputs_);
    return {std::move(layout), std::move(report_.lines), std::move(to_mend_)};
}

/// The master's name among the machines of a cluster: that of the node which has its address.
std::string Importer::master_of(const std::vector<Place>& all, const std::string& address)
{
    const auto master = std::ranges::find_if(all, [&](const Place& node) {
        const auto own = find_member(node, "address");
        return own && text(*own) == address;
    });
    const bool found = master != all.end();
    return "in the exhibit's file \"machines\": { \"master\": \"node" + std::to_string(found ? master - all.begin() : 0)
        + "\" } and an \"interface\"; each machine starts with its own --node"
        + (found ? "" : ". No node has the address " + one_line(address, 60) + ", so node0 is a guess");
}

void Importer::node(const Place& place)
{
    members(place,
        {{"address", "one machine shows this layout"},
            {"port", "machines find each other on the network that the exhibit's file names"},
            {"datatransferport", "machines send each other no files"},
            {"swaplock", "the machines of an exhibit show each frame together"}},
        [&](const std::string& part, const Place& windows) {
            if (part == "address" && !machine_.empty()) {
                became(windows, "the machine " + machine_ + ", which has any address in its exhibit's network");
                return true;
            }
            if (part != "windows")
                return false;
            std::size_t index = 0;
            const std::vector<Place> each = items(windows, 1, 64, "windows");
            for (const Place& at : each)
                if (auto output = window(at, index++, each.size() == 1))
                    outputs_.push_back(*output);
            return true;
        });
}

std::vector<Place> Importer::nodes(const Place& top)
{
    if (!top.json->is_object())
        fail_at(top, "is not an object; an SGCT configuration in { } is right");
    if (document_.root.contains("nodes"))
        return items(member(top, "nodes"), 1, 1024, "nodes");
    fail_at(top, "lacks \"nodes\"; an SGCT configuration with this member is right");
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
            {"tracking", other_tracker}},
        [&](const std::string& name, const Place& at) {
            if (name == "name")
                became(at, "used to find the eyes of its viewports");
            else if (name == "eyeseparation") {
                user.separation = number(at, {0, 10});
                if (user.name.empty())
                    became(at, "/stereo/separation_m " + shown(user.separation));
                else
                    not_mapped(at, "all viewports of a layout share one separation, that of the user without a name");
            } else if (name == "pos" || name == "position") {
                user.pos = sgct_xyz(at);
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

/// SGCT draws each eye's picture in the window's own shape into half of it: the packings' half forms.
std::string Importer::packing(const Place& place)
{
    const std::string mode = text(place);
    const std::map<std::string_view, std::string_view> packings{{"none", "mono"}, {"no_stereo", "mono"},
        {"checkerboard", "checkerboard"}, {"anaglyph_red_cyan", "anaglyph-red-cyan"},
        {"anaglyph_amber_blue", "anaglyph-amber-blue"}, {"anaglyph_wimmer", "anaglyph-dubois"},
        {"vertical_interlaced", "rows"}, {"side_by_side", "side-by-side-half"}, {"top_bottom", "top-and-bottom-half"}};
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
        fail_at(place, "is not a stereo mode of SGCT's; none or side_by_side is right, for example");
    return "mono";
}

/// Without a size SGCT takes two thirds of the main monitor's, which is not known here.
glm::ivec2 Importer::window_size(const Place& window)
{
    const auto pixels
        = [](const Place& at) { return glm::ivec2(integer(member(at, "x"), 1, 16384), integer(member(at, "y"), 1, 16384)); };
    if (const auto at = find_member(window, "size"))
        return pixels(*at);
    glm::dvec2 size(1280, 720);
    if (const auto at = find_member(window, "res")) {
        const glm::dvec2 shape = pixels(*at);
        size = shape * std::min(size.x / shape.x, size.y / shape.y);
    }
    return glm::max(glm::ivec2(glm::round(size)), 1);
}

/// Reads the window's monitor. SGCT numbers monitors, and a layout names them. Several windows need at least different
/// names.
void Importer::monitor(const Place& window, bool alone, Json& output)
{
    const auto fullscreen = find_member(window, "fullscreen"), index = find_member(window, "monitor");
    if (!fullscreen || !boolean(*fullscreen))
        return;
    output["whole_monitor"] = true;
    if (!alone)
        output["monitor"] = {{"connector", "SGCT-monitor-" + std::to_string(index ? integer(*index, -1, 1024) : 0)}};
}

std::optional<Json> Importer::window(const Place& place, std::size_t index, bool alone)
{
    if (const auto draws = find_member(place, "draw3d"); draws && !boolean(*draws)) {
        report_.leave_out(place, "draws no 3D scene (\"draw3d\": false), only SGCT's controls; the window is left out");
        return {};
    }
    Json output;
    const glm::ivec2 size = window_size(place);
    const auto name_at = find_member(place, "name");
    output["name"] = output_name(name_at ? text(*name_at) : "window" + std::to_string(index));
    if (!machine_.empty())
        output["node"] = machine_;
    output["size"] = Json::array({size.x, size.y});
    monitor(place, alone, output);
    if (const auto stereo = find_member(place, "stereo"))
        output["packing"] = packing(*stereo);
    const bool packed = output.value("packing", "mono") != "mono";
    Json viewports = Json::array();
    members(place,
        {{"id", elsewhere}, {"tags", elsewhere}, {"bufferbitdepth", sgct_choice_of_program}, {"autoiconify", elsewhere},
            {"hidemousecursor", "the pointer rests by itself"}, {"floating", elsewhere}, {"alwaysrender", elsewhere},
            {"hidden", "every output is shown; starbow render draws without a window"}, {"takescreenshot", elsewhere},
            {"alpha", "an output is opaque"}, {"msaa", sgct_choice_of_program}, {"fxaa", sgct_choice_of_program},
            {"border", "a window has a frame unless it has monitor, whole_monitor or place"}, {"draw2d", elsewhere},
            {"noerror", elsewhere}, {"blitwindowid", "an output is not copied; one with preview shows all others small"},
            {"monitor", "a layout names a monitor by its connector, model, serial number or position, not by a number"},
            {"spout", "pictures are not shared with other programs"}, {"ndi", "pictures are not sent over the network"},
            {"scalablemesh", "name the mesh as the viewport's"},
            {"mpcdi",
                "give each region a viewport whose warp names the file, its \"region\", \"first_row\": \"top\" and "
                "\"values\": \"offsets\", as SGCT reads it"},
            {"doublebuffered", sgct_choice_of_program}, {"swapinterval", sgct_choice_of_program}},
        [&](const std::string& name, const Place& at) {
            if (name == "viewports") {
                for (const Place& each : items(at, 0, 64, "viewports")) {
                    std::vector<Json> made = viewport(each, size, packed);
                    lay_over(each, made, viewports);
                    for (Json& one : made)
                        viewports.push_back(std::move(one));
                }
                return true;
            }
            return window_member(name, at, size, output);
        });
    if (viewports.empty()) {
        not_mapped(place, "no viewport is left; the window is left out");
        names_.pop_back();
        return {};
    }
    const std::string pointer = "/outputs/" + std::to_string(outputs_.size());
    if (output.contains("monitor"))
        to_mend_.push_back(pointer + "/monitor/connector: " + output["monitor"]["connector"].get<std::string>()
            + " stands in for the monitor's name; one that 'starbow displays' lists is right");
    if (!find_member(place, "size"))
        to_mend_.push_back(pointer + "/size: " + output["size"].dump()
            + " stands in for two thirds of the main monitor, which SGCT takes without a \"size\"; the window's own pixels "
              "are right");
    output["viewports"] = std::move(viewports);
    return output;
}

/// Reports a window's member that window() has read, and takes the simple ones. False for those that have no place in a
/// layout.
bool Importer::window_member(const std::string& name, const Place& at, glm::ivec2 size, Json& output)
{
    const bool fullscreen = output.contains("whole_monitor");
    if (name == "size")
        became(at, "size");
    else if (name == "name")
        became(at, "name " + output["name"].get<std::string>());
    else if (name == "draw3d")
        became(at, "the output shows the world");
    else if (name == "pos" && fullscreen)
        not_mapped(at, "the window covers its monitor");
    else if (name == "monitor" && output.contains("monitor"))
        became(at, "monitor, a connector that stands in for its name");
    else if (name == "pos") {
        output["place"] = Json::array({integer(member(at, "x"), -65536, 65536), integer(member(at, "y"), -65536, 65536)});
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
    } else if (name == "mirrorx" || name == "mirrory") {
        if (boolean(at))
            not_mapped(at, "no output is mirrored; turn the projector's picture about");
        else
            became(at, "nothing is mirrored");
    } else
        return name == "stereo"; // packing() has reported it
    return true;
}

/// The view that replaces a viewport's flat one because of its mesh. SGCT takes it from SCISS, Scalable and SkySkan files,
/// by their names (CorrectionMesh::loadMesh, whose loaders call setViewPlaneCoordsUsingFOVs). It reads no domeprojection
/// frustum, and a fisheye or panorama stays the warped picture.
std::optional<MeshView> Importer::mesh_view(const Place& viewport)
{
    const auto mesh = find_member(viewport, "mesh"), shown = find_member(viewport, "projection");
    if (!mesh)
        return {};
    if (shown && !is_flat_in_sgct(text(member(*shown, "type"))))
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

/// Reads a viewport's mesh into `out`. SGCT's reader of PFM files (correction/pfm.cpp) is of a kind of its own: the first
/// row on top, the outer samples on the edges, v upwards; and only with a TextureMappedProjection are the values places.
void Importer::mesh(const Place& at, const Place& viewport, Json& out)
{
    const std::string name = file(at);
    const auto shown = find_member(viewport, "projection");
    const std::string type = shown ? text(member(*shown, "type")) : "";
    if (type == "SphericalMirrorProjection") {
        not_mapped(at, "the picture of four meshes is not warped again");
        return;
    }
    Json warp{{"file", name}};
    std::string how;
    if (std::filesystem::path(name).extension() == ".pfm") {
        if (type != "TextureMappedProjection") {
            not_mapped(at,
                "with this projection SGCT reads a PFM as positions for two eyes side by side; only a "
                "TextureMappedProjection's is read");
            return;
        }
        if (out.contains("rect")) {
            not_mapped(at, "SGCT's places are fractions of the whole window, and this viewport is a part of it");
            return;
        }
        warp["first_row"] = "top";
        warp["v"] = "up";
        warp["samples"] = "edges";
        how = ", with the first row on top, v upwards and the samples from edge to edge";
    }
    out["warp"] = std::move(warp);
    became(at, "warp, file " + name + how);
}

/// Reads a mesh that brings its own view into a viewport and its picture.
void Importer::mesh_with_view(
    const Place& at, const MeshView& own, const SgctView& view, bool own_eye, Json& out, SgctPicture& picture)
{
    out["warp"] = {{"file", file(at)}};
    const bool wall = own.planar && looks_askew(view);
    if (wall)
        picture.parts = {{.projection = sgct_wall(*own.planar)}};
    became(at,
        "warp, file " + file(at) + ", which brings its own view" + (own_eye ? " and eye" : "")
            + (wall ? "; a wall 10 m from the origin, where SGCT puts its plane" : ""));
}

/// The layout's viewports of a picture in the rectangle `within`: one, or one for each part.
std::vector<Json> placed(const Json& viewport, SgctPicture& picture, const glm::dvec4& within)
{
    if (picture.parts.empty())
        return {viewport}; // the warp file brings the projection
    std::vector<Json> all;
    for (SgctPart& part : picture.parts) {
        Json one = viewport;
        one["projection"] = std::move(part.projection);
        if (!part.warp.is_null())
            one["warp"] = std::move(part.warp);
        if (part.order != 0)
            one["order"] = part.order;
        if (picture.parts.size() > 1)
            one["rect"] = Json::array({within.x + part.rect.x * within.z, within.y + part.rect.y * within.w,
                part.rect.z * within.z, part.rect.w * within.w});
        all.push_back(std::move(one));
    }
    return all;
}

/// SGCT draws a window's viewports one after the other: a later one lies over those that it overlaps.
void Importer::lay_over(const Place& place, std::vector<Json>& made, const Json& earlier)
{
    const auto rect = [](const Json& viewport) {
        Viewport out;
        for (int i = 0; viewport.contains("rect") && i < 4; ++i)
            out.rect[i] = viewport["rect"][std::size_t(i)];
        return out;
    };
    int order = 0;
    for (const Json& lower : earlier)
        for (const Json& upper : made)
            if (overlap(rect(lower), rect(upper)))
                order = std::max(order, lower.value("order", 0) + 1);
    if (order == 0)
        return;
    for (Json& one : made)
        one["order"] = one.value("order", 0) + order;
    became(place, "order " + std::to_string(order) + ", over the viewports before it");
}

std::vector<Json> Importer::viewport(const Place& place, glm::ivec2 window_size, bool packed)
{
    Json out;
    glm::dvec2 corner(0), size(1);
    if (const auto at = find_member(place, "pos"))
        corner = xy(*at, any_fraction);
    if (const auto at = find_member(place, "size"))
        size = xy(*at, any_fraction);
    // The corner is converted from SGCT's lower left to the upper left.
    const glm::dvec2 low = glm::clamp(corner, 0.0, 1.0), high = glm::clamp(corner + size, 0.0, 1.0);
    const bool cut = glm::length(low - corner) > 1e-9 || glm::length(high - corner - size) > 1e-9;
    if (!(high.x > low.x && high.y > low.y)) {
        report_.leave_out(place, "lies outside its window; the viewport is left out");
        return {};
    }
    if (low != glm::dvec2(0) || high != glm::dvec2(1))
        out["rect"] = Json::array({low.x, 1 - high.y, high.x - low.x, high.y - low.y});
    const auto user_at = find_member(place, "user"), eye_at = find_member(place, "eye");
    const std::string wanted = user_at ? text(*user_at) : "";
    const auto whose = std::find_if(users_.begin(), users_.end(), [&](const User& user) { return user.name == wanted; });
    const std::optional<MeshView> own = mesh_view(place);
    const glm::dvec3 given = whose != users_.end() ? whose->pos : glm::dvec3(0),
                     eye = own ? own->eye_m.value_or(given) : given;
    if (eye != glm::dvec3(0))
        out["eye_m"] = json_of(eye);
    const bool one_of_two = eye_at && one_of(*eye_at, {"center", "left", "right"}) != "center";
    const SgctView view{
        (high - low) * glm::dvec2(window_size), eye, packed || one_of_two, double(window_size.x) / window_size.y, folder_};
    SgctPicture picture;
    members(place,
        {{"overlay", "nothing is drawn over the world but the head-up display"}, {"tracked", other_tracker},
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
                const std::string side = text(at);
                if (one_of_two)
                    out["eye"] = side;
                became(at, one_of_two ? "eye " + side : "eye middle");
            } else if (name == "mesh" && own) {
                mesh_with_view(at, *own, view, eye != given, out, picture);
            } else if (name == "mesh") {
                mesh(at, place, out);
            } else if (name == "blendmask") {
                out["alpha_mask"] = file(at);
                out["mask_gamma"] = display_gamma;
                became(at,
                    "alpha_mask " + file(at) + ", with mask_gamma " + shown(display_gamma)
                        + " because SGCT multiplies what it sends to the screen, not the light");
            } else if (name == "projection" && own) {
                not_mapped(at, "replaced by the mesh's own");
            } else if (name == "projection") {
                picture = sgct_projection(report_, at, view);
            } else
                return false;
            return true;
        });
    if (picture.parts.empty() && !out.contains("warp")) {
        report_.not_mapped(place, "has no projection of a kind that a layout has; the viewport is left out");
        return {};
    }
    two_eyes_ |= view.two_eyes;
    return placed(out, picture, {low.x, 1 - high.y, high.x - low.x, high.y - low.y});
}

} // namespace

Document read_sgct(const std::filesystem::path& file)
{
    std::array<char, 4096> start{};
    RegularFile(file).read(start);
    // A byte order mark may stand before the first bracket.
    if (*std::find_if_not(start.begin(), start.end() - 1, [](unsigned char c) { return std::isspace(c) || (c & 0x80); })
        == '<')
        throw InputError(one_line(file.string()), "",
            "is XML, which SGCT read until its version 2; the JSON that SGCT reads since version 3 is right");
    return read_document(file);
}

Import import_sgct(
    const Document& document, std::optional<int> node, const std::filesystem::path& folder, const LookInto& look_into)
{
    return Importer(document, node, folder, look_into).run();
}

} // namespace starbow
