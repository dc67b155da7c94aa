#include "describe_layout.h"
#include "describe_shot.h"
#include "layout_reader.h"
#include <algorithm>
#include <arpa/inet.h>
#include <cctype>

namespace starbow {
namespace {

constexpr Range factors{0, 1e12, true}; // of hyper stereo

/// Fractions such as 0.3333 and 0.6667 must count as neighbours: this is 1/60 of the widest output's pixel.
constexpr double slack = 1e-6;

/// The pixels of one eye's picture in an output.
glm::ivec2 eye_size(const Output& output)
{
    const bool beside = output.packing == Packing::side_by_side || output.packing == Packing::side_by_side_half;
    const bool above = output.packing == Packing::top_and_bottom || output.packing == Packing::top_and_bottom_half;
    return output.size / glm::ivec2(beside ? 2 : 1, above ? 2 : 1);
}

/// Throws for a rectangle that its output can't show.
void check_rect(const Place& place, const glm::dvec4& r, glm::ivec2 size)
{
    if (r.z <= 0 || r.w <= 0)
        fail_at(place, "is empty; x, y, width and height in fractions of the output, the last two above 0, is right");
    if (r.x + r.z > 1 + slack || r.y + r.w > 1 + slack)
        fail_at(place, "reaches beyond the output; x + width and y + height up to 1 is right");
    const glm::ivec4 pixels = pixel_rect({r}, size);
    if (pixels.z < 1 || pixels.w < 1)
        fail_at(place,
            "is smaller than a pixel of the " + std::to_string(size.x) + " x " + std::to_string(size.y)
                + " output; at least one pixel each way is right");
}

/// True if the reader knows that a viewport has no mask; a warp file may bring one.
bool surely_unmasked(const Viewport& viewport) { return viewport.alpha_mask.empty() && !viewport.warp; }

/// Throws if a packing would halve a pixel.
void check_halves(const Place& place, const Output& output)
{
    const glm::ivec2 eye = eye_size(output);
    if ((eye.x != output.size.x && output.size.x % 2) || (eye.y != output.size.y && output.size.y % 2))
        fail_at(find_member(place, "size").value_or(place),
            "has no two equal halves for \"packing\"; an even number of pixels across the cut is right");
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
        fail_at(member(place, "name"), "is the name of " + which + " too; a name of its own is right");
    if (output.preview && earlier.preview)
        fail_at(member(place, "preview"), "makes a second preview beside " + which + "; one is right");
    if ((output.node.empty() || earlier.node.empty()) && output.node != earlier.node)
        fail_at(find_member(place, "node").value_or(place),
            output.node.empty() ? "has no node, and " + which + " has one; a node for each output, or for none, is right"
                                : "is a node, and " + which + " has none; a node for each output, or for none, is right");
    if ((output.whole_monitor || earlier.whole_monitor) && output.node == earlier.node
        && same(output.monitor, earlier.monitor))
        fail_at(find_member(place, "monitor").value_or(place),
            "takes the same monitor as " + which
                + ", and a window over the whole of it leaves no room; a monitor for each is right");
}

} // namespace

void check(const Place& place, const Warp& warp, const Folder&)
{
    for (const char* name : {"v", "samples"})
        if (auto other = find_member(place, name); other && warp.map.offsets)
            fail_at(*other,
                "stands beside \"values\": \"offsets\", which are upwards and from edge to edge; \"values\": "
                "\"places\", or no \""
                    + std::string(name) + "\", is right");
}

ViewportObserver ObserverForm::read(const Place& place, const Folder&) const
{
    if (place.json->is_object())
        return {false, read_velocity(place)};
    return {one_of(place, {"ship", "at-rest"}) == "at-rest"};
}

Json ObserverForm::schema(Json& definitions) const
{
    return {{"oneOf", {{{"enum", {"ship", "at-rest"}}}, velocity_schema(definitions)}}};
}

void check(const Place& place, Viewport& viewport, const Folder&)
{
    viewport.projection_given = find_member(place, "projection").has_value();
    if (!viewport.projection_given && !viewport.warp)
        member(place, "projection");
}

void Handle::add_turnables(std::vector<described::Turnable>& all, const std::string& at, Quad& quad) const
{
    for (int axis : {0, 1})
        all.push_back({at + "/" + std::to_string(axis), &(quad.*member)[axis], range, handle_step, name,
            axis == 0 ? "to the right" : "down", Quad{}.*member});
}

constexpr std::size_t least_handles = HandleGrid::least * HandleGrid::least,
                      most_handles = HandleGrid::most * HandleGrid::most;

std::vector<double> Offsets::read(const Place& place, const Folder&) const
{
    std::vector<double> all;
    for (const Place& one : items(place, least_handles, most_handles, "offsets"))
        all.push_back(number(one, range));
    return all;
}

Json Offsets::schema(Json& definitions) const
{
    return described::list_schema(least_handles, most_handles, Number{range}.schema(definitions));
}

void Offsets::add_turnables(std::vector<described::Turnable>& all, const std::string& at, HandleGrid& grid) const
{
    const auto columns = std::size_t(grid.columns);
    const glm::dvec2 last(grid.columns - 1, grid.rows - 1);
    for (std::size_t i = 0; i < (grid.*member).size(); ++i)
        all.push_back({at + "/" + std::to_string(i), &(grid.*member)[i], range, handle_step,
            "handle " + std::to_string(i / columns + 1) + "." + std::to_string(i % columns + 1), way,
            glm::dvec2(i % columns, i / columns) / last});
}

void check(const Place& place, HandleGrid& grid, const Folder&)
{
    const std::size_t handles = std::size_t(grid.columns) * std::size_t(grid.rows);
    for (const auto& [name, offsets] : {std::pair("right", &grid.right), std::pair("down", &grid.down)}) {
        const std::optional<Place> given = find_member(place, name);
        if (given && offsets->size() != handles)
            fail_at(*given,
                "holds " + std::to_string(offsets->size()) + " numbers for " + std::to_string(grid.columns) + " columns and "
                    + std::to_string(grid.rows) + " rows; " + std::to_string(handles) + " are right");
        offsets->resize(handles, 0.0);
    }
}

std::string FileNamePart::read(const Place& place, const Folder&) const
{
    const std::string name = text(place);
    const bool usable = std::all_of(name.begin(), name.end(),
        [](char c) { return c == '_' || c == '-' || (static_cast<unsigned char>(c) < 0x80 && std::isalnum(c)); });
    if (!usable || name.size() > 64)
        fail_at(place, "can't be part of a file's name; up to 64 of the letters A-Z a-z 0-9 _ - is right");
    return name;
}

void check_members(const Place& place, const Output*)
{
    if (const auto preview = find_member(place, "preview"); preview && *preview->json == true)
        for (const char* name : {"viewports", "packing"})
            if (auto p = find_member(place, name))
                fail_at(*p,
                    "stands in the preview, which shows the other outputs as they are; a preview without \""
                        + std::string(name) + "\" is right");
}

void check(const Place& place, const Output& output, const Folder&)
{
    if (const auto at = find_member(place, "place"); at && output.whole_monitor)
        fail_at(*at, "places a window that covers its whole monitor; \"place\" or \"whole_monitor\", not both, is right");
    if (output.preview)
        return;
    check_halves(place, output);
    const std::vector<Place> places = elements(member(place, "viewports"));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Viewport& viewport = output.viewports[i];
        if (const auto rect = find_member(places[i], "rect"))
            check_rect(*rect, viewport.rect, eye_size(output));
        if (const auto eye = find_member(places[i], "eye"); eye && output.packing != Packing::mono)
            fail_at(*eye,
                "is set in an output whose \"packing\" shows both eyes; no \"eye\", or \"packing\" left out, is right");
        for (std::size_t k = 0; k < i; ++k)
            if (const Viewport& other = output.viewports[k]; overlap(viewport, other) && viewport.order == other.order
                && (surely_unmasked(viewport) || surely_unmasked(other)))
                fail_at(find_member(places[i], "rect").value_or(places[i]), unordered_overlap(k));
    }
}

void HyperStereo::read_into(const Place& place, Stereo& stereo, const Folder&) const
{
    stereo.by_light = place.json->is_string();
    if (stereo.by_light)
        one_of(place, {"by-light"});
    else
        stereo.hyper_stereo = number(place, factors);
}

Json HyperStereo::schema(Json& definitions) const
{
    return {{"anyOf", {Number{factors}.schema(definitions), {{"const", "by-light"}}}}};
}

void check(const Place& place, const Stereo& stereo, const Folder&)
{
    if (stereo.separation_m == 0 && stereo.method != StereoMethod::shared)
        fail_at(member(place, "separation_m"),
            "puts both eyes in one place; a number above 0, or the method \"shared\", is right");
    if (stereo.turning && stereo.method != StereoMethod::reprojected)
        fail_at(member(place, "baseline"), "turns eyes that only one method can turn; the method \"reprojected\" is right");
}

std::string OwnAddress::read(const Place& place, const Folder&) const
{
    const std::string address = text(place);
    in_addr unused;
    if (inet_pton(AF_INET, address.c_str(), &unused) != 1)
        fail_at(
            place, "is not an IPv4 address; \"127.0.0.1\" (a tracker on this computer) or \"0.0.0.0\" (on any) is right");
    return address;
}

void check(const Place& place, const MonitorName& monitor, const Folder&)
{
    if (monitor.empty())
        fail_at(place, "names no monitor; at least one of \"connector\", \"model\", \"serial\" and \"position\" is right");
}

void check(const Place& place, const Layout& layout, const Folder&)
{
    const std::vector<Place> outputs = elements(member(place, "outputs"));
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const Output& output = layout.outputs[i];
        for (std::size_t k = 0; k < output.viewports.size(); ++k)
            if (const Viewport& viewport = output.viewports[k]; viewport.projection_given)
                check_eye(member(elements(member(outputs[i], "viewports"))[k], "projection"), viewport.projection,
                    viewport.eye_m,
                    output.packing != Packing::mono || viewport.eye != Eye::middle ? layout.stereo.separation_m : 0);
        for (std::size_t k = 0; k < i; ++k)
            check_beside(outputs[i], output, layout.outputs[k], k);
    }
    if (layout.outputs.size() == 1 && layout.outputs[0].preview)
        fail_at(member(place, "outputs"), "holds a preview alone; at least one other output for it to show is right");
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
    Layout layout = read<Layout>(top, file.parent_path());
    layout.name = file.stem().string();
    layout.file = file;
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
