#include "parts.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {
namespace {

/// A key of the file's head, the range of its number, and the number where the file has the key.
struct Key {
    std::string_view name;
    Range range;
    std::optional<double> value{};
    double or_else(double otherwise) const { return value.value_or(otherwise); }
};

constexpr Range angle_range{-360, 360}, any_range{-1e9, 1e9}, pixel_range{1, 65536}, count_range{0, double(most_vertices)};

/// The keys that are read, and the ranges of their numbers.
struct Keys {
    std::array<Key, 19> all{{{"VERTICES", count_range}, {"FACES", count_range}, {"NATIVEXRES", pixel_range},
        {"NATIVEYRES", pixel_range}, {"ORTHO_LEFT", any_range}, {"ORTHO_RIGHT", any_range}, {"ORTHO_BOTTOM", any_range},
        {"ORTHO_TOP", any_range}, {"PERSPECTIVE_LEFT", angle_range}, {"PERSPECTIVE_RIGHT", angle_range},
        {"PERSPECTIVE_BOTTOM", angle_range}, {"PERSPECTIVE_TOP", angle_range}, {"PERSPECTIVE_YAW", angle_range},
        {"PERSPECTIVE_PITCH", angle_range}, {"PERSPECTIVE_ROLL", angle_range}, {"PERSPECTIVE_XOFFSET", metre_range},
        {"PERSPECTIVE_YOFFSET", metre_range}, {"PERSPECTIVE_ZOFFSET", metre_range}, {"GAMMA", {0.01, 100}}}};

    const Key& operator[](std::string_view name) const { return *std::ranges::find(all, name, &Key::name); }
};

/// Keys that have one value here.
constexpr std::array fixed_keys{
    std::pair("MAPPING", "NORMALIZED"), std::pair("SAMPLING", "LINEAR"), std::pair("PROJECTION", "PERSPECTIVE")};

/// Keys that turn unsupported functions on, unless their number is 0.
constexpr std::array unsupported_keys{std::string_view("DO_NO_WARP"),
    std::string_view("USE_SPHERE_SAMPLE_COORDINATE_SYSTEM"), std::string_view("FRUSTUM_EULER_ANGLES"),
    std::string_view("APPLY_MASK"), std::string_view("APPLY_BLACK_LEVEL"), std::string_view("APPLY_COLOR")};

using Fields = std::vector<std::string_view>; // of one line

/// The content of a file. The vertices lie as in the file: in pixels of the panel, from its lower left corner.
struct Content {
    WarpMesh mesh;
    Keys keys;
    std::size_t faces = 0; ///< all of the file's; the mesh has only those that cover something
};

void read_face(const Lines& lines, const Fields& f, Content& content)
{
    if (f.size() != 5 || f[4] != "]")
        lines.refuse(in_quotes(lines.text()) + " is not a face; [ i j k ] is right");
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> value = parsed(f[i + 1]);
        if (!value || *value != std::floor(*value) || *value < 0 || *value >= double(content.mesh.vertices.size()))
            lines.refuse(in_quotes(f[i + 1]) + " is not the number of a vertex before it; one below "
                + std::to_string(content.mesh.vertices.size()) + " is right");
        t[i] = std::uint32_t(*value);
    }
    ++content.faces;
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
        content.mesh.triangles.push_back(t);
}

void read_vertex(const Lines& lines, const Fields& f, WarpMesh& mesh)
{
    if (f.size() != 5)
        lines.refuse(in_quotes(lines.text()) + " is not a vertex; x y intensity s t is right");
    mesh.vertices.push_back(
        {{lines.number(f[0], {-1e6, 1e6}), lines.number(f[1], {-1e6, 1e6})}, lines.number(f[2], {0, 255}) / 255,
            {glm::dvec3(lines.number(f[3], picture_range), 1 - lines.number(f[4], picture_range), 0)}});
}

void read_key(const Lines& lines, const Fields& f, Content& content)
{
    std::vector<std::string>& notes = content.mesh.notes;
    bool known = f[0] == "SUBVERSION" || f[0] == "LABEL" || f[0].starts_with("FRUSTUM_EULER_");
    for (Key& key : content.keys.all)
        if (f[0] == key.name) {
            if (f.size() != 2)
                lines.refuse(
                    in_quotes(lines.text()) + " has no number; " + std::string(key.name) + " and a number is right");
            key.value = lines.number(f[1], key.range);
            known = true;
        }
    for (const auto& [name, right] : fixed_keys)
        if (f[0] == name) {
            if (f.size() != 2 || f[1] != right)
                lines.refuse(in_quotes(lines.text()) + " is not read here; " + name + " " + right + " is right");
            known = true;
        }
    for (std::string_view name : unsupported_keys)
        if (f[0] == name) {
            if (f.size() > 1 && parsed(f[1]).value_or(1) != 0)
                notes.push_back(one_line(std::string(lines.text()), 60) + " is not done");
            known = true;
        }
    if (!known && notes.size() < 16)
        notes.push_back(one_line(std::string(lines.text()), 60) + " is not known, and not used");
}

Content read_content(const WarpFile& file)
{
    Lines lines(file);
    lines.want("OPENMESH Version 1.1");
    if (lines.text() != "OPENMESH Version 1.1")
        lines.refuse(in_quotes(lines.text()) + " is not this format's first line; OPENMESH Version 1.1 is right");
    Content content;
    content.mesh.format = "Scalable mesh";
    while (lines.next()) {
        const Fields& f = lines.fields();
        if (f[0] == "[")
            read_face(lines, f, content);
        else if (f[0].find_first_not_of("+-.0123456789eE") == f[0].npos)
            read_vertex(lines, f, content.mesh);
        else
            read_key(lines, f, content);
    }
    return content;
}

void check_counts(const WarpFile& file, const Content& content)
{
    const Keys& keys = content.keys;
    for (const char* name : {"VERTICES", "FACES", "NATIVEXRES", "NATIVEYRES"})
        if (!keys[name].value)
            refuse(file, "", std::string(name) + " is missing; this key with a number is right");
    for (const auto& [name, there] :
        {std::pair("VERTICES", content.mesh.vertices.size()), std::pair("FACES", content.faces)})
        if (*keys[name].value != double(there))
            refuse(file, name,
                shown(*keys[name].value) + " are announced and " + std::to_string(there)
                    + " are there; the number of those that are there is right");
}

/// Moves the vertices from pixels of the panel to fractions of the viewport, which ORTHO places on the panel.
void place_vertices(const WarpFile& file, const Keys& keys, WarpMesh& mesh)
{
    const glm::dvec2 panel(*keys["NATIVEXRES"].value, *keys["NATIVEYRES"].value);
    // ORTHO holds fractions of the panel. A number far from any fraction means pixels of the panel's corners.
    glm::dvec2 low(keys["ORTHO_LEFT"].or_else(0), keys["ORTHO_BOTTOM"].or_else(0)),
        high(keys["ORTHO_RIGHT"].or_else(1), keys["ORTHO_TOP"].or_else(1));
    if (std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)}) > 16) {
        low /= panel;
        high /= panel;
    }
    const glm::dvec2 span = high - low;
    if (!(std::abs(span.x) > 1e-6 && std::abs(span.y) > 1e-6))
        refuse(file, "ORTHO_RIGHT", "ORTHO spans nothing; edges that differ are right");
    for (WarpVertex& vertex : mesh.vertices) {
        const glm::dvec2 place = (vertex.at / panel - low) / span;
        vertex.at = {place.x, 1 - place.y};
        if (!(std::abs(place.x) <= position_range.high && std::abs(place.y) <= position_range.high))
            refuse(file, "NATIVEXRES",
                "puts a vertex at " + shown(place.x) + ", " + shown(place.y)
                    + " of the picture; vertices in pixels of a panel of NATIVEXRES x NATIVEYRES are right");
    }
}

/// Reads the projector's frustum and the eye's place from the keys.
void read_perspective(const WarpFile& file, const Keys& keys, WarpMesh& mesh)
{
    const Key &left = keys["PERSPECTIVE_LEFT"], &right = keys["PERSPECTIVE_RIGHT"], &bottom = keys["PERSPECTIVE_BOTTOM"],
              &top = keys["PERSPECTIVE_TOP"];
    if (left.value || right.value || bottom.value || top.value) {
        for (const Key* key : {&left, &right, &bottom, &top})
            if (!key->value)
                refuse(file, "", std::string(key->name) + " is missing; all four edges or none are right");
        mesh.frustum = Planar{60,
            checked_sides(file, "PERSPECTIVE_LEFT", {*left.value, *right.value, *bottom.value, *top.value}),
            {keys["PERSPECTIVE_YAW"].or_else(0), keys["PERSPECTIVE_PITCH"].or_else(0), keys["PERSPECTIVE_ROLL"].or_else(0)}};
    }
    const Key &x = keys["PERSPECTIVE_XOFFSET"], &y = keys["PERSPECTIVE_YOFFSET"], &z = keys["PERSPECTIVE_ZOFFSET"];
    if (x.value || y.value || z.value)
        mesh.eye_m = glm::dvec3(x.or_else(0), y.or_else(0), z.or_else(0));
}

} // namespace

static WarpMesh read_scalable(const WarpFile& file)
{
    Content content = read_content(file);
    check_counts(file, content);
    WarpMesh mesh = std::move(content.mesh);
    place_vertices(file, content.keys, mesh);
    read_perspective(file, content.keys, mesh);
    if (const Key& gamma = content.keys["GAMMA"]; gamma.value && *gamma.value != 1)
        mesh.notes.push_back("GAMMA " + shown(*gamma.value) + " is not used: the output's colour has its own");
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat scalable_format{.name = "Scalable",
    .endings = {".ol"},
    .begins = [](const WarpStart& start) { return start.line.starts_with("OPENMESH"); },
    .read = [](const WarpFile& file, const WarpReading&) { return read_scalable(file); }};

} // namespace starbow
