#include "layout_reader.h"
#include "shot_reader.h"
#include <algorithm>
#include <arpa/inet.h>
#include <cctype>

namespace starbow {
namespace {

constexpr int most_pixels_across = 16384;
static_assert(most_pixels_across <= (1 << 28) / most_pixels_across, "an output's pixels are counted in an int");

/// Fractions such as 0.3333 and 0.6667 must count as neighbours: this is 1/60 of the widest output's pixel.
constexpr double slack = 1e-6;

/// Windows may begin left of and above the main monitor.
constexpr int farthest_px = 100000;

glm::ivec2 read_pixels(const Place& place, int low, int high)
{
    const std::vector<Place> at = items(place, 2, 2, "whole numbers");
    return {integer(at[0], low, high), integer(at[1], low, high)};
}

/// The pixels of one eye's picture in an output.
glm::ivec2 eye_size(const Output& output)
{
    const bool beside = output.packing == Packing::side_by_side || output.packing == Packing::side_by_side_half;
    const bool above = output.packing == Packing::top_and_bottom || output.packing == Packing::top_and_bottom_half;
    return output.size / glm::ivec2(beside ? 2 : 1, above ? 2 : 1);
}

glm::dvec4 read_rect(const Place& place, glm::ivec2 size)
{
    const glm::dvec4 r = vec4(place, {0, 1});
    if (r.z <= 0 || r.w <= 0)
        complain(place, "is empty; x, y, width and height in fractions of the output, the last two above 0, is right");
    if (r.x + r.z > 1 + slack || r.y + r.w > 1 + slack)
        complain(place, "reaches beyond the output; x + width and y + height up to 1 is right");
    const glm::ivec4 pixels = pixel_rect({r}, size);
    if (pixels.z < 1 || pixels.w < 1)
        complain(place,
            "is smaller than a pixel of the " + std::to_string(size.x) + " x " + std::to_string(size.y)
                + " output; at least one pixel each way is right");
    return r;
}

Warp read_warp(const Place& place, const std::filesystem::path& folder)
{
    reject_unknown_members(place, {"file", "frustum", "region", "first_row", "v", "samples", "values", "aspect"});
    Warp warp;
    warp.file = existing_file(member(place, "file"), folder);
    if (auto p = find_member(place, "frustum"))
        warp.frustum = existing_file(*p, folder);
    if (auto p = find_member(place, "region"))
        warp.region = text(*p);
    if (auto p = find_member(place, "aspect"))
        warp.aspect = number(*p, {0.01, 100});
    if (auto p = find_member(place, "first_row"))
        warp.map.first_row_on_top = one_of(*p, {"top", "bottom"}) == "top";
    if (auto p = find_member(place, "v"))
        warp.map.v_up = one_of(*p, {"down", "up"}) == "up";
    if (auto p = find_member(place, "samples"))
        warp.map.edge_to_edge = one_of(*p, {"centres", "edges"}) == "edges";
    if (auto p = find_member(place, "values")) {
        warp.map.offsets = one_of(*p, {"places", "offsets"}) == "offsets";
        for (const char* name : {"v", "samples"})
            if (auto other = find_member(place, name); other && warp.map.offsets)
                complain(*other,
                    "stands beside \"values\": \"offsets\", which are upwards and from edge to edge; \"values\": "
                    "\"places\", or no \""
                        + std::string(name) + "\", is right");
    }
    return warp;
}

ViewportObserver read_observer(const Place& place)
{
    if (place.json->is_object())
        return {false, read_velocity(place)};
    return {one_of(place, {"ship", "at-rest"}) == "at-rest"};
}

Viewport read_viewport(const Place& place, const Output& output, const Stereo& stereo, const std::filesystem::path& folder)
{
    reject_unknown_members(place,
        {"rect", "eye", "eye_m", "projection", "warp", "alpha_mask", "black_level", "mask_gamma", "observer", "order"});
    Viewport viewport;
    if (auto p = find_member(place, "rect"))
        viewport.rect = read_rect(*p, eye_size(output));
    if (auto p = find_member(place, "eye"))
        viewport.eye = chosen<Eye>(*p, {{"middle", Eye::middle}, {"left", Eye::left}, {"right", Eye::right}});
    take(place, "eye_m", viewport.eye_m, {-1e3, 1e3});
    const bool packed = output.packing != Packing::mono;
    if (packed && find_member(place, "eye"))
        complain(member(place, "eye"),
            "is set in an output whose \"packing\" shows both eyes; no \"eye\", or \"packing\" left out, is right");

    const auto projection = find_member(place, "projection"), warp = find_member(place, "warp");
    if (projection) {
        viewport.projection = read_projection(*projection);
        check_eye(*projection, viewport.projection, viewport.eye_m,
            packed || viewport.eye != Eye::middle ? stereo.separation_m : 0);
    } else if (!warp) {
        member(place, "projection");
    }
    viewport.projection_given = projection.has_value();
    if (warp)
        viewport.warp = read_warp(*warp, folder);
    if (auto p = find_member(place, "alpha_mask"))
        viewport.alpha_mask = existing_file(*p, folder);
    if (auto p = find_member(place, "black_level"))
        viewport.black_level = existing_file(*p, folder);
    take(place, "mask_gamma", viewport.mask_gamma, {0.1, 10});
    if (auto p = find_member(place, "observer"))
        viewport.observer = read_observer(*p);
    if (auto p = find_member(place, "order"))
        viewport.order = integer(*p, -1000, 1000);
    return viewport;
}

/// True if the reader knows that a viewport has no mask; a warp file may bring one.
bool surely_unmasked(const Viewport& viewport) { return viewport.alpha_mask.empty() && !viewport.warp; }

std::string read_name(const Place& place)
{
    const std::string name = text(place);
    const bool usable = std::all_of(name.begin(), name.end(),
        [](char c) { return c == '_' || c == '-' || (static_cast<unsigned char>(c) < 0x80 && std::isalnum(c)); });
    if (!usable || name.size() > 64)
        complain(place, "can't be part of a file's name; up to 64 of the letters A-Z a-z 0-9 _ - is right");
    return name;
}

Packing read_packing(const Place& place)
{
    return chosen<Packing>(place,
        {{"mono", Packing::mono}, {"side-by-side", Packing::side_by_side}, {"side-by-side-half", Packing::side_by_side_half},
            {"top-and-bottom", Packing::top_and_bottom}, {"top-and-bottom-half", Packing::top_and_bottom_half},
            {"rows", Packing::rows}, {"columns", Packing::columns}, {"checkerboard", Packing::checkerboard},
            {"anaglyph-red-cyan", Packing::anaglyph_red_cyan}, {"anaglyph-dubois", Packing::anaglyph_dubois},
            {"anaglyph-amber-blue", Packing::anaglyph_amber_blue}});
}

/// Reads the place of the output's window.
void read_window(const Place& place, Output& output)
{
    take(place, "resizable", output.resizable);
    if (auto p = find_member(place, "monitor"))
        output.monitor = read_monitor(*p);
    take(place, "whole_monitor", output.whole_monitor);
    if (auto p = find_member(place, "place")) {
        output.place = read_pixels(*p, -farthest_px, farthest_px);
        if (output.whole_monitor)
            complain(
                *p, "places a window that covers its whole monitor; \"place\" or \"whole_monitor\", not both, is right");
    }
}

/// Throws if a packing would halve a pixel.
void check_halves(const Place& place, const Output& output)
{
    const glm::ivec2 eye = eye_size(output);
    if ((eye.x != output.size.x && output.size.x % 2) || (eye.y != output.size.y && output.size.y % 2))
        complain(find_member(place, "size").value_or(place),
            "has no two equal halves for \"packing\"; an even number of pixels across the cut is right");
}

Output read_output(const Place& place, const Stereo& stereo, const std::filesystem::path& folder)
{
    reject_unknown_members(place,
        {"name", "node", "size", "resizable", "viewports", "preview", "packing", "colour", "monitor", "whole_monitor",
            "place"});
    Output output;
    output.name = read_name(member(place, "name"));
    if (auto p = find_member(place, "node"))
        output.node = read_name(*p);
    if (auto p = find_member(place, "size"))
        output.size = read_pixels(*p, 1, most_pixels_across);
    take(place, "preview", output.preview);
    if (auto p = find_member(place, "packing"))
        output.packing = read_packing(*p);
    read_window(place, output);
    if (auto p = find_member(place, "colour"))
        output.colour = read_colour(*p, folder);
    if (output.preview) {
        for (const char* name : {"viewports", "packing"})
            if (auto p = find_member(place, name))
                complain(*p,
                    "stands in the preview, which shows the other outputs as they are; a preview without \""
                        + std::string(name) + "\" is right");
        return output;
    }
    check_halves(place, output);
    for (const Place& at : items(member(place, "viewports"), 1, 64, "viewports")) {
        const Viewport viewport = read_viewport(at, output, stereo, folder);
        for (std::size_t i = 0; i < output.viewports.size(); ++i)
            if (const Viewport& other = output.viewports[i]; overlap(viewport, other) && viewport.order == other.order
                && (surely_unmasked(viewport) || surely_unmasked(other)))
                complain(find_member(at, "rect").value_or(at), unordered_overlap(i));
        output.viewports.push_back(viewport);
    }
    return output;
}

Stereo read_stereo(const Place& place)
{
    reject_unknown_members(place, {"method", "separation_m", "hyper_stereo", "baseline", "full_from_zenith_deg"});
    Stereo stereo;
    if (auto p = find_member(place, "method"))
        stereo.method = chosen<StereoMethod>(*p,
            {{"shared", StereoMethod::shared}, {"exact", StereoMethod::exact}, {"reprojected", StereoMethod::reprojected}});
    take(place, "separation_m", stereo.separation_m, {0, 10});
    if (const auto p = find_member(place, "hyper_stereo"); p && p->json->is_string())
        stereo.by_light = one_of(*p, {"by-light"}) == "by-light";
    else
        take(place, "hyper_stereo", stereo.hyper_stereo, {0, 1e12, true});
    if (auto p = find_member(place, "baseline"))
        stereo.turning = one_of(*p, {"fixed", "turning"}) == "turning";
    take(place, "full_from_zenith_deg", stereo.full_from_zenith_deg, {0, 90});
    if (stereo.separation_m == 0 && stereo.method != StereoMethod::shared)
        complain(member(place, "separation_m"),
            "puts both eyes in one place; a number above 0, or the method \"shared\", is right");
    if (stereo.turning && stereo.method != StereoMethod::reprojected)
        complain(member(place, "baseline"), "turns eyes that only one method can turn; the method \"reprojected\" is right");
    return stereo;
}

Blend read_blend(const Place& place)
{
    reject_unknown_members(place, {"ramps", "power"});
    Blend blend;
    take(place, "ramps", blend.ramps);
    take(place, "power", blend.power, {0.1, 10});
    return blend;
}

HudPlacement read_hud(const Place& place)
{
    reject_unknown_members(place, {"azimuth_deg", "elevation_deg", "width_deg"});
    HudPlacement hud;
    take(place, "azimuth_deg", hud.azimuth_deg, {-180, 180});
    take(place, "elevation_deg", hud.elevation_deg, {-90, 90});
    take(place, "width_deg", hud.width_deg, {1, 120});
    return hud;
}

HeadTracking read_head_tracker(const Place& place)
{
    reject_unknown_members(place, {"port", "address", "room_m"});
    HeadTracking tracking;
    if (auto p = find_member(place, "port"))
        tracking.port = integer(*p, 1024, 65535);
    if (auto p = find_member(place, "address")) {
        tracking.address = text(*p);
        in_addr unused;
        if (inet_pton(AF_INET, tracking.address.c_str(), &unused) != 1)
            complain(
                *p, "is not an IPv4 address; \"127.0.0.1\" (a tracker on this computer) or \"0.0.0.0\" (on any) is right");
    }
    take(place, "room_m", tracking.room_m, {0.1, 10});
    return tracking;
}

bool same(const MonitorName& a, const MonitorName& b)
{
    return a.connector == b.connector && a.model == b.model && a.serial == b.serial && a.position == b.position;
}

/// Throws if an output conflicts with an earlier one.
void check_beside(const Place& place, const Output& output, const Output& earlier, std::size_t index)
{
    const std::string which = "output " + std::to_string(index);
    if (output.name == earlier.name)
        complain(member(place, "name"), "is the name of " + which + " too; a name of its own is right");
    if (output.preview && earlier.preview)
        complain(member(place, "preview"), "makes a second preview beside " + which + "; one is right");
    if ((output.node.empty() || earlier.node.empty()) && output.node != earlier.node)
        complain(find_member(place, "node").value_or(place),
            output.node.empty() ? "has no node, and " + which + " has one; a node for each output, or for none, is right"
                                : "is a node, and " + which + " has none; a node for each output, or for none, is right");
    if ((output.whole_monitor || earlier.whole_monitor) && output.node == earlier.node
        && same(output.monitor, earlier.monitor))
        complain(find_member(place, "monitor").value_or(place),
            "takes the same monitor as " + which
                + ", and a window over the whole of it leaves no room; a monitor for each is right");
}

} // namespace

MonitorName read_monitor(const Place& place)
{
    reject_unknown_members(place, {"connector", "model", "serial", "position"});
    MonitorName monitor;
    if (auto p = find_member(place, "connector"))
        monitor.connector = text(*p);
    if (auto p = find_member(place, "model"))
        monitor.model = text(*p);
    if (auto p = find_member(place, "serial"))
        monitor.serial = text(*p);
    if (auto p = find_member(place, "position"))
        monitor.position = read_pixels(*p, -farthest_px, farthest_px);
    if (monitor.empty())
        complain(place, "names no monitor; at least one of \"connector\", \"model\", \"serial\" and \"position\" is right");
    return monitor;
}

bool overlap(const Viewport& a, const Viewport& b)
{
    return std::min(a.rect.x + a.rect.z, b.rect.x + b.rect.z) - std::max(a.rect.x, b.rect.x) > slack
        && std::min(a.rect.y + a.rect.w, b.rect.y + b.rect.w) - std::max(a.rect.y, b.rect.y) > slack;
}

std::string unordered_overlap(std::size_t lower)
{
    return "overlaps viewport " + std::to_string(lower)
        + " of this output, and nothing says which is on top; a higher \"order\" in one of them, or an \"alpha_mask\" in "
          "each as its share, is right";
}

glm::ivec4 pixel_rect(const Viewport& viewport, glm::ivec2 size)
{
    const glm::dvec4& r = viewport.rect;
    const glm::ivec2 from = glm::round(glm::dvec2(r.x, r.y) * glm::dvec2(size));
    const glm::ivec2 to = glm::min(glm::ivec2(glm::round(glm::dvec2(r.x + r.z, r.y + r.w) * glm::dvec2(size))), size);
    return {from, to - from};
}

std::vector<std::string> nodes_of(const Layout& layout)
{
    std::vector<std::string> nodes;
    for (const Output& output : layout.outputs)
        if (!output.node.empty() && std::ranges::find(nodes, output.node) == nodes.end())
            nodes.push_back(output.node);
    return nodes;
}

bool has_two_eyes(const Layout& layout)
{
    return std::ranges::any_of(layout.outputs, [](const Output& output) {
        return output.packing != Packing::mono
            || std::ranges::any_of(output.viewports, [](const Viewport& viewport) { return viewport.eye != Eye::middle; });
    });
}

Layout read_layout(const Place& top, const std::filesystem::path& file)
{
    reject_unknown_members(top, {"$schema", "stereo", "blend", "hud", "head_tracker", "outputs"});
    Layout layout;
    layout.name = file.stem().string();
    layout.file = file;
    if (auto p = find_member(top, "$schema"))
        text(*p);
    if (auto p = find_member(top, "stereo"))
        layout.stereo = read_stereo(*p);
    if (auto p = find_member(top, "blend"))
        layout.blend = read_blend(*p);
    if (auto p = find_member(top, "hud"))
        layout.hud = read_hud(*p);
    if (auto p = find_member(top, "head_tracker"))
        layout.head_tracker = read_head_tracker(*p);
    const Place outputs = member(top, "outputs");
    for (const Place& at : items(outputs, 1, 64, "outputs")) {
        const Output output = read_output(at, layout.stereo, file.parent_path());
        for (std::size_t i = 0; i < layout.outputs.size(); ++i)
            check_beside(at, output, layout.outputs[i], i);
        layout.outputs.push_back(output);
    }
    if (layout.outputs.size() == 1 && layout.outputs[0].preview)
        complain(outputs, "holds a preview alone; at least one other output for it to show is right");
    return layout;
}

std::string viewport_pointer(std::size_t output, std::size_t viewport)
{
    return "/outputs/" + std::to_string(output) + "/viewports/" + std::to_string(viewport);
}

std::string place_in(const Layout& layout, const std::string& pointer)
{
    std::string line;
    try {
        if (const auto span = find_span(read_document(layout.file), pointer))
            line = std::string(":").append(std::to_string(span->line));
    } catch (const InputError&) { // the file is being changed
    }
    return layout.file.string() + line + ": " + pointer;
}

Layout load_layout(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read_layout(root(document), file);
}

} // namespace starbow
