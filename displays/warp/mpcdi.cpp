#include "parts.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <pugixml.hpp>

namespace starbow {
namespace {

bool same(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
        [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// An element, and its path in messages.
struct Element {
    const WarpFile* file;
    pugi::xml_node node;
    std::string path;

    [[noreturn]] void refuse(const std::string& problem) const { starbow::refuse(*file, path, problem); }
    Element make(pugi::xml_node child) const
    {
        const std::string id = attribute_of(child, "id");
        return {file, child, path + "/" + child.name() + (id.empty() ? "" : "[" + id + "]")};
    }
    std::optional<Element> find(std::string_view name) const
    {
        for (pugi::xml_node child : node.children())
            if (same(child.name(), name))
                return make(child);
        return {};
    }
    Element want(std::string_view name) const
    {
        if (auto child = find(name))
            return *child;
        refuse("lacks <" + std::string(name) + ">; this element in it is right");
    }
    std::vector<Element> all(std::string_view name) const
    {
        std::vector<Element> found;
        for (pugi::xml_node child : node.children())
            if (same(child.name(), name))
                found.push_back(make(child));
        return found;
    }
    static std::string attribute_of(pugi::xml_node node, std::string_view name)
    {
        for (pugi::xml_attribute a : node.attributes())
            if (same(a.name(), name))
                return a.value();
        return "";
    }
    std::string attribute(std::string_view name) const { return attribute_of(node, name); }
    double as_number(std::string_view text, Range range) const
    {
        while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
            text.remove_prefix(1);
        while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
            text.remove_suffix(1);
        const std::optional<double> value = parsed(text);
        if (!value || *value < range.low || *value > range.high)
            refuse(in_quotes(text) + (value ? " is out of range" : " is not a number") + "; a number from "
                + shown(range.low) + " to " + shown(range.high) + " is right");
        return *value;
    }
    double number(Range range) const { return as_number(node.text().get(), range); }
    double attribute(std::string_view name, Range range) const
    {
        if (attribute(name).empty())
            refuse("lacks " + std::string(name) + "; this attribute is right");
        return Element{file, node, path + "/@" + std::string(name)}.as_number(attribute(name), range);
    }
    std::string text() const
    {
        const std::string value = node.text().get();
        const std::size_t start = value.find_first_not_of(" \t\r\n"), end = value.find_last_not_of(" \t\r\n");
        return start == value.npos ? "" : value.substr(start, end - start + 1);
    }
};

struct Region {
    Element buffer, element;
    std::string buffer_id, id;
};

/// The region that the layout names: by its name, or by its buffer's and its own.
Region chosen(const Element& root, const std::string& wanted)
{
    std::vector<Region> regions, fitting;
    for (const Element& buffer : root.want("display").all("buffer"))
        for (const Element& region : buffer.all("region"))
            regions.push_back({buffer, region, buffer.attribute("id"), region.attribute("id")});
    if (regions.empty())
        root.want("display").refuse("has no region; a buffer with a region is right");
    for (const Region& region : regions)
        if (wanted.empty() || wanted == region.id || wanted == region.buffer_id + "/" + region.id)
            fitting.push_back(region);
    if (fitting.size() == 1)
        return fitting[0];
    const bool twice = std::any_of(regions.begin(), regions.end(), [&](const Region& a) {
        return std::count_if(regions.begin(), regions.end(), [&](const Region& b) { return a.id == b.id; }) > 1;
    });
    std::string names;
    for (std::size_t i = 0; i < regions.size() && names.size() < 300; ++i)
        names += (i == 0                           ? ""
                         : i + 1 == regions.size() ? " or "
                                                   : ", ")
            + in_quotes(twice ? regions[i].buffer_id + "/" + regions[i].id : regions[i].id);
    refuse(*root.file, "",
        (wanted.empty()
                ? std::to_string(regions.size()) + " regions are in it and none is chosen"
                : in_quotes(wanted) + (fitting.empty() ? " is not a region of it" : " is more than one region of it"))
            + "; the region " + names + " is right");
}

double metres_of(const std::string& unit, const Element& element)
{
    constexpr std::pair<std::string_view, double> units[]
        = {{"mm", 0.001}, {"cm", 0.01}, {"dm", 0.1}, {"m", 1}, {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}};
    for (const auto& [name, metres] : units)
        if (same(unit, name))
            return metres;
    element.refuse(in_quotes(unit) + " is not a unit; mm, cm, dm, m, in, ft or yd is right");
}

/// From the file's axes to the cockpit's. The frame has the directions of three axes: yaw points down, pitch to the right,
/// and roll ahead (VESA MPCDI 2.0, section 2.2.2).
glm::dmat3 cockpit_from_file(const Element& region)
{
    const std::optional<Element> frame = region.find("coordinateFrame");
    if (!frame)
        return glm::dmat3(1); // as the standard has it without: x to the right, y up, z backwards
    const auto axis = [&](const char* name) {
        glm::dvec3 v;
        for (int i = 0; i < 3; ++i)
            v[i] = frame->want(std::string(name) + "xyz"[i]).number({-1.01, 1.01});
        if (std::abs(glm::length(v) - 1) > 0.01)
            frame->refuse("has a " + std::string(name) + " axis of length " + shown(glm::length(v)) + "; length 1 is right");
        return glm::normalize(v);
    };
    const glm::dvec3 down = axis("yaw"), right = axis("pitch"), ahead = axis("roll");
    if (std::max({std::abs(glm::dot(down, right)), std::abs(glm::dot(right, ahead)), std::abs(glm::dot(ahead, down))})
        > 0.01)
        frame->refuse("has axes that are not at right angles; three at right angles are right");
    return glm::transpose(glm::dmat3(right, -down, -ahead));
}

struct Profile {
    std::string version, name;
    bool flat = false; ///< the map holds places in a planar picture; else points of the screen
};

Profile read_profile(const Element& root)
{
    if (!same(root.node.name(), "MPCDI"))
        root.refuse("is not MPCDI's; <MPCDI> around everything is right");
    const std::string version = root.attribute("version"), profile = root.attribute("profile");
    if (version != "1.0" && version != "2.0")
        root.refuse(in_quotes(version) + " is a version that is not known; 1.0 or 2.0 is right");
    const bool flat = same(profile, "2d") || same(profile, "3d"), points = same(profile, "a3") || same(profile, "sl");
    if (!flat && !points)
        root.refuse(in_quotes(profile) + " is a profile that is not known; 2d, 3d, a3 or sl is right");
    return {version, profile, flat};
}

/// Notes the region's place in its buffer, and its pixels.
void read_place(const Region& region, WarpMesh& mesh)
{
    const Element& element = region.element;
    const glm::dvec2 corner(element.attribute("x", {-1e6, 1e6}), element.attribute("y", {-1e6, 1e6})),
        size(element.attribute("xsize", {1e-6, 1e6}), element.attribute("ysize", {1e-6, 1e6}));
    const glm::ivec2 pixels(
        int(element.attribute("xresolution", {1, 65536})), int(element.attribute("yresolution", {1, 65536})));
    if (corner != glm::dvec2(0) || size != glm::dvec2(1))
        mesh.notes.push_back("the region is x " + shown(corner.x) + " y " + shown(corner.y) + " width " + shown(size.x)
            + " height " + shown(size.y) + " of its buffer " + in_quotes(region.buffer_id));
    mesh.notes.push_back("made for " + std::to_string(pixels.x) + " x " + std::to_string(pixels.y) + " pixels");
}

void read_frustum(const Element& region, const Profile& profile, WarpMesh& mesh)
{
    if (const auto frustum = region.find("frustum"); frustum && profile.flat) {
        const Range angle{-180, 180}, turn{-360, 360};
        Planar planar;
        planar.turn
            = {frustum->want("yaw").number(turn), frustum->want("pitch").number(turn), frustum->want("roll").number(turn)};
        planar.sides = checked_sides(*region.file, frustum->path,
            {frustum->want("leftAngle").number(angle), frustum->want("rightAngle").number(angle),
                frustum->want("downAngle").number(angle), frustum->want("upAngle").number(angle)});
        mesh.frustum = planar;
    } else if (same(profile.name, "3d"))
        region.refuse("lacks <frustum>; the profile 3d with one is right");
}

/// The files of a region.
Element fileset_of(const Element& root, const std::string& region)
{
    std::optional<Element> files;
    for (const Element& set : root.want("files").all("fileset"))
        if (set.attribute("region") == region) {
            if (files)
                set.refuse("is the second for the region " + in_quotes(region) + "; one is right");
            files = set;
        }
    if (!files)
        root.want("files").refuse("has no fileset for the region " + in_quotes(region) + "; one is right");
    return *files;
}

/// The mesh of a map of points. warp: <geometryWarpFile>. region: its <region>, with the axes. The notes of `mesh` stay.
WarpMesh point_mesh(const FloatMap& map, const WarpFile& map_file, const Element& warp, const Element& region, WarpMesh mesh)
{
    double unit = 1;
    if (const auto given = warp.find("geometricUnit"))
        unit = metres_of(given->text(), *given);
    else
        mesh.notes.push_back("geometricUnit is not given: metres");
    const glm::dmat3 axes = cockpit_from_file(region);
    std::vector<WarpVertex> values;
    std::vector<char> holes;
    values.reserve(map.values.size());
    holes.reserve(map.values.size());
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const glm::dvec3 point = axes * (glm::dvec3(map.values[i]) * unit);
        const bool hole = !std::isfinite(point.x + point.y + point.z) || point == glm::dvec3(0);
        if (!hole && glm::length(point) > metre_range.high)
            refuse(map_file, "value " + std::to_string(i),
                "is a point " + shown(glm::length(point)) + " m away; up to " + shown(metre_range.high) + " m is right");
        holes.push_back(hole);
        values.push_back({{}, hole ? 0.0 : 1.0, {hole ? glm::dvec3(0) : point}});
    }
    const std::vector<std::string> notes = std::move(mesh.notes);
    mesh = centred_mesh(map.size, values, holes);
    mesh.kind = WarpMesh::Kind::points;
    mesh.notes = notes;
    if (const auto origin = warp.find("originOf3DData")) {
        mesh.notes.push_back("the points' origin: " + one_line(origin->text(), 40));
        if (same(origin->text(), "idealEyePoint"))
            mesh.eye_m = glm::dvec3(0);
    }
    return mesh;
}

/// The mesh of a map of places in a planar picture. The frustum and the notes of `mesh` stay.
WarpMesh flat_mesh(const FloatMap& map, const WarpFile& map_file, WarpMesh mesh)
{
    WarpMesh placed = place_mesh(map, map_file);
    placed.frustum = mesh.frustum;
    placed.notes.insert(placed.notes.begin(), mesh.notes.begin(), mesh.notes.end());
    return placed;
}

std::optional<WarpMesh::Mask> mask_of(
    const Element& files, const char* name, const ArchiveContents& contents, WarpMesh& mesh)
{
    const std::optional<Element> element = files.find(name);
    if (!element)
        return {};
    const std::optional<Element> path = element->find("path");
    if (!path || path->text().empty()) {
        mesh.notes.push_back(std::string(name) + " names no file");
        return {};
    }
    const std::size_t archive = files.file->content.size();
    const std::string png = contents(path->text(), most_inflated(archive));
    WarpMesh::Mask mask = read_mask({files.file->name, png}, one_line(path->text()), most_memory(archive));
    if (const auto gamma = element->find("gammaEmbedded"))
        mask.gamma = gamma->number({0.01, 100});
    if (const auto depth = element->find("componentDepth"); depth && depth->number({1, 4}) != mask.channels)
        mesh.notes.push_back(std::string(name) + " says " + depth->text() + " components, the picture's values need "
            + std::to_string(mask.channels));
    return mask;
}

} // namespace

WarpMesh mesh_of_mpcdi(const WarpFile& file, const std::string& xml_name, const std::string& xml,
    const ArchiveContents& contents, const std::string& wanted, const FloatMapForm& form)
{
    // pugixml reads no entity but the five that XML has, and opens no other file.
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(xml.data(), xml.size());
    if (!result)
        refuse(
            file, xml_name + ", byte " + std::to_string(result.offset), std::string("is not XML: ") + result.description());
    const pugi::xml_node top = document.document_element();
    const Element root{&file, top, xml_name + ": " + top.name()};
    const Profile profile = read_profile(root);
    const Region region = chosen(root, wanted);
    WarpMesh mesh;
    read_place(region, mesh);
    read_frustum(region.element, profile, mesh);

    const Element files = fileset_of(root, region.id), warp = files.want("geometryWarpFile");
    const std::string path = warp.want("path").text();
    const std::string bytes = contents(path, most_inflated(file.content.size()));
    const WarpFile map_file{file.name + ": " + one_line(path, 100), bytes};
    const FloatMap map = read_float_map(map_file, form);
    if (!profile.flat && (form.offsets || form.v_up || form.edge_to_edge))
        root.refuse("has the profile " + in_quotes(profile.name)
            + ", whose maps hold points in the room; neither offsets nor v up nor samples from edge to edge is right");
    mesh = profile.flat ? flat_mesh(map, map_file, std::move(mesh))
                        : point_mesh(map, map_file, warp, region.element, std::move(mesh));
    if (files.find("distortionMap"))
        mesh.notes.push_back("distortionMap is not used: the points' places say all that a screen at rest needs");
    mesh.alpha = mask_of(files, "alphaMap", contents, mesh);
    mesh.beta = mask_of(files, "betaMap", contents, mesh);
    mesh.format = "MPCDI " + profile.version + ", profile " + profile.name + ", region " + one_line(region.id, 60);
    check_mesh(mesh, file);
    return mesh;
}

static WarpMesh read_mpcdi(const WarpFile& file, const std::string& region, const FloatMapForm& form)
{
    const Archive archive(file);
    std::vector<std::string> candidates;
    for (const std::string& name : archive.names())
        if (name.size() > 4 && same(name.substr(name.size() - 4), ".xml") && name.find_first_of("/\\") == name.npos)
            candidates.push_back(name);
    for (std::string_view usual : {"mpcdi.xml", "mpacs.xml"})
        for (const std::string& name : candidates)
            if (candidates.size() > 1 && same(name, usual))
                candidates = {name};
    if (candidates.size() != 1)
        refuse(file, "", "has " + std::to_string(candidates.size()) + " XML files at its root; one, mpcdi.xml, is right");
    const auto contents = [&](const std::string& path, std::size_t most) {
        std::string name = path;
        std::replace(name.begin(), name.end(), '\\', '/');
        return archive.contents(name, most);
    };
    const std::string xml = archive.contents(candidates[0], std::size_t(1) << 20);
    return mesh_of_mpcdi(file, one_line(candidates[0], 100), xml, contents, region, form);
}

extern const WarpFormat mpcdi_format{.name = "MPCDI",
    .endings = {".mpcdi"},
    .begins = [](const WarpStart& start) { return start.bytes.starts_with("PK\x03\x04"); },
    .read = [](const WarpFile& file, const WarpReading& reading) { return read_mpcdi(file, reading.region, reading.form); },
    .has_regions = true,
    .has_form = true};

} // namespace starbow
