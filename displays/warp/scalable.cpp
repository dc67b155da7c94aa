#include "parts.h"
#include <array>
#include <cmath>

namespace starbow {
namespace {

/// The numbers after a key.
struct Key {
    std::string_view name;
    Range range;
    std::optional<double> value{};
    double or_else(double otherwise) const { return value.value_or(otherwise); }
};

/// Keys of unsupported functions, if their number is not 0.
constexpr std::array asked{std::string_view("DO_NO_WARP"), std::string_view("USE_SPHERE_SAMPLE_COORDINATE_SYSTEM"),
    std::string_view("FRUSTUM_EULER_ANGLES"), std::string_view("APPLY_MASK"), std::string_view("APPLY_BLACK_LEVEL"),
    std::string_view("APPLY_COLOR")};

} // namespace

WarpMesh read_scalable(const WarpFile& file)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "Scalable mesh";
    lines.want("OPENMESH Version 1.1");
    if (lines.text() != "OPENMESH Version 1.1")
        lines.refuse(in_quotes(lines.text()) + " is not this format's first line; OPENMESH Version 1.1 is right");
    const Range angle{-360, 360}, any{-1e9, 1e9}, pixels{1, 65536}, count{0, double(most_vertices)};
    std::array<Key, 19> keys{{{"VERTICES", count}, {"FACES", count}, {"NATIVEXRES", pixels}, {"NATIVEYRES", pixels},
        {"ORTHO_LEFT", any}, {"ORTHO_RIGHT", any}, {"ORTHO_BOTTOM", any}, {"ORTHO_TOP", any}, {"PERSPECTIVE_LEFT", angle},
        {"PERSPECTIVE_RIGHT", angle}, {"PERSPECTIVE_BOTTOM", angle}, {"PERSPECTIVE_TOP", angle}, {"PERSPECTIVE_YAW", angle},
        {"PERSPECTIVE_PITCH", angle}, {"PERSPECTIVE_ROLL", angle}, {"PERSPECTIVE_XOFFSET", metre_range},
        {"PERSPECTIVE_YOFFSET", metre_range}, {"PERSPECTIVE_ZOFFSET", metre_range}, {"GAMMA", {0.01, 100}}}};
    std::size_t faces = 0;
    while (lines.next()) {
        const auto& f = lines.fields();
        if (f[0] == "[") {
            if (f.size() != 5 || f[4] != "]")
                lines.refuse(in_quotes(lines.text()) + " is no face; [ i j k ] is right");
            std::array<std::uint32_t, 3> t{};
            for (std::size_t i = 0; i < 3; ++i) {
                const std::optional<double> value = parsed(f[i + 1]);
                if (!value || *value != std::floor(*value) || *value < 0 || *value >= double(mesh.vertices.size()))
                    lines.refuse(in_quotes(f[i + 1]) + " is the number of no vertex before it; one below "
                        + std::to_string(mesh.vertices.size()) + " is right");
                t[i] = std::uint32_t(*value);
            }
            ++faces;
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
                mesh.triangles.push_back(t);
            continue;
        }
        if (f[0].find_first_not_of("+-.0123456789eE") == f[0].npos) {
            if (f.size() != 5)
                lines.refuse(in_quotes(lines.text()) + " is no vertex; x y intensity s t is right");
            mesh.vertices.push_back(
                {{lines.number(f[0], {-1e6, 1e6}), lines.number(f[1], {-1e6, 1e6})}, lines.number(f[2], {0, 255}) / 255,
                    {glm::dvec3(lines.number(f[3], picture_range), 1 - lines.number(f[4], picture_range), 0)}});
            continue;
        }
        bool known = f[0] == "SUBVERSION" || f[0] == "LABEL" || f[0].starts_with("FRUSTUM_EULER_");
        for (Key& key : keys)
            if (f[0] == key.name) {
                if (f.size() != 2)
                    lines.refuse(
                        in_quotes(lines.text()) + " has no number; " + std::string(key.name) + " and a number is right");
                key.value = lines.number(f[1], key.range);
                known = true;
            }
        for (const auto& [name, right] :
            {std::pair("MAPPING", "NORMALIZED"), std::pair("SAMPLING", "LINEAR"), std::pair("PROJECTION", "PERSPECTIVE")})
            if (f[0] == name) {
                if (f.size() != 2 || f[1] != right)
                    lines.refuse(in_quotes(lines.text()) + " is not read here; " + name + " " + right + " is right");
                known = true;
            }
        for (std::string_view name : asked)
            if (f[0] == name) {
                if (f.size() > 1 && parsed(f[1]).value_or(1) != 0)
                    mesh.notes.push_back(one_line(std::string(lines.text()), 60) + " is not done");
                known = true;
            }
        if (!known && mesh.notes.size() < 16)
            mesh.notes.push_back(one_line(std::string(lines.text()), 60) + " is not known, and not used");
    }
    const auto& [vertex_count, face_count, wide, high, left, right, bottom, top, f_left, f_right, f_bottom, f_top, yaw,
        pitch, roll, offset_x, offset_y, offset_z, gamma]
        = keys;
    for (const Key* key : {&vertex_count, &face_count, &wide, &high})
        if (!key->value)
            refuse(file, "", std::string(key->name) + " is missing; this key with a number is right");
    for (const auto& [key, there] : {std::pair(&vertex_count, mesh.vertices.size()), std::pair(&face_count, faces)})
        if (*key->value != double(there))
            refuse(file, std::string(key->name),
                shown(*key->value) + " are announced and " + std::to_string(there)
                    + " are there; the number of those that are there is right");

    // ORTHO in fractions of the panel; in pixels of a panel's corners where a number is far from any fraction.
    glm::dvec2 low(left.or_else(0), bottom.or_else(0)), high_corner(right.or_else(1), top.or_else(1));
    if (std::max({std::abs(low.x), std::abs(low.y), std::abs(high_corner.x), std::abs(high_corner.y)}) > 16) {
        low /= glm::dvec2(*wide.value, *high.value);
        high_corner /= glm::dvec2(*wide.value, *high.value);
    }
    const glm::dvec2 span = high_corner - low;
    if (!(std::abs(span.x) > 1e-6 && std::abs(span.y) > 1e-6))
        refuse(file, "ORTHO_RIGHT", "ORTHO spans nothing; edges that differ are right");
    for (WarpVertex& vertex : mesh.vertices) {
        const glm::dvec2 place = (vertex.at / glm::dvec2(*wide.value, *high.value) - low) / span;
        vertex.at = {place.x, 1 - place.y};
        if (!(std::abs(place.x) <= position_range.high && std::abs(place.y) <= position_range.high))
            refuse(file, "NATIVEXRES",
                "puts a vertex at " + shown(place.x) + ", " + shown(place.y)
                    + " of the picture; vertices in pixels of a panel of NATIVEXRES x NATIVEYRES are right");
    }
    if (f_left.value || f_right.value || f_bottom.value || f_top.value) {
        for (const Key* key : {&f_left, &f_right, &f_bottom, &f_top})
            if (!key->value)
                refuse(file, "", std::string(key->name) + " is missing; all four edges or none are right");
        mesh.frustum = Planar{60,
            checked_sides(file, "PERSPECTIVE_LEFT", {*f_left.value, *f_right.value, *f_bottom.value, *f_top.value}),
            {yaw.or_else(0), pitch.or_else(0), roll.or_else(0)}};
    }
    if (offset_x.value || offset_y.value || offset_z.value)
        mesh.eye_m = glm::dvec3(offset_x.or_else(0), offset_y.or_else(0), offset_z.or_else(0));
    if (gamma.value && *gamma.value != 1)
        mesh.notes.push_back("GAMMA " + shown(*gamma.value) + " is not used: the output's colour has its own");
    check_mesh(mesh, file);
    return mesh;
}

} // namespace starbow
