#include "parts.h"
#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace starbow {
namespace {

/// The 0-based index of a 1-based one, or of a negative one that counts from the end.
std::uint32_t index(const Lines& lines, std::string_view text, std::size_t count, const char* what)
{
    const int most = int(count);
    const std::optional<double> value = parsed(text);
    const bool right = value && std::abs(*value) >= 1 && std::abs(*value) <= most && *value == std::floor(*value);
    if (!right)
        lines.refuse(
            in_quotes(text) + " is not the number of a " + what + "; one from 1 to " + std::to_string(count) + " is right");
    return std::uint32_t(*value > 0 ? *value - 1 : *value + most);
}

/// Puts the vertices on the viewport, -1 to 1 of x to the right and of y upwards. A mesh without any height in y that has
/// one in z lies on the ground: Blender exports a plane so by default (forward -Z, up Y), its own y as -z.
void place_on_screen(WarpMesh& mesh, const std::vector<glm::dvec3>& positions, const std::vector<std::uint32_t>& used)
{
    glm::dvec3 low(1e300), high(-1e300);
    for (const std::uint32_t at : used)
        low = glm::min(low, positions[at]), high = glm::max(high, positions[at]);
    const glm::dvec3 size = high - low;
    const bool lies = size.y <= 1e-6 * size.x && size.z > 1e-6 * size.x;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const glm::dvec3& at = positions[used[i]];
        const double up = lies ? -at.z : at.y;
        mesh.vertices[i].at = {(at.x + 1) / 2, (1 - up) / 2};
    }
    if (lies)
        mesh.notes.push_back("it lies in x and z, as Blender exports a plane by default; -z is taken upwards");
    else if (!used.empty() && (low.z != 0 || high.z != 0))
        mesh.notes.push_back("z is not 0 everywhere, and is not used");
}

} // namespace

static WarpMesh read_obj(const WarpFile& file)
{
    Lines lines(file);
    WarpMesh mesh;
    mesh.format = "OBJ mesh";
    std::vector<glm::dvec3> positions; // as in the file
    std::vector<glm::dvec2> places;
    std::unordered_map<std::uint64_t, std::uint32_t> vertices; // by position and place
    std::vector<std::uint32_t> corners, used; // used: the position of each vertex
    std::vector<std::string> unused;
    bool coloured = false;
    while (lines.next()) {
        const auto& f = lines.fields();
        if (f[0].starts_with('#'))
            continue;
        if (f[0] == "v") {
            // A weight may follow, or a vertex' colour, with its opacity or without.
            if (f.size() < 4 || f.size() > 8 || f.size() == 6)
                lines.refuse(in_quotes(lines.text())
                    + " is not a vertex; v x y z, with a colour r g b after it or without, is right");
            for (std::size_t i = 4; i < f.size(); ++i)
                (void)lines.number(f[i], {-1e30, 1e30});
            coloured |= f.size() > 5;
            positions.push_back(
                {lines.number(f[1], position_range), lines.number(f[2], position_range), lines.number(f[3], {-1e30, 1e30})});
        } else if (f[0] == "vt") {
            if (f.size() < 3 || f.size() > 4)
                lines.refuse(in_quotes(lines.text()) + " is not a place in the picture; vt u v is right");
            places.push_back({lines.number(f[1], picture_range), 1 - lines.number(f[2], picture_range)});
        } else if (f[0] == "f") {
            if (f.size() < 4)
                lines.refuse(in_quotes(lines.text()) + " has fewer than three corners; f a/a b/b c/c is right");
            corners.clear();
            for (std::size_t i = 1; i < f.size(); ++i) {
                const std::size_t slash = f[i].find('/'), second = f[i].find('/', std::min(slash, f[i].size() - 1) + 1);
                const std::string_view v = f[i].substr(0, slash);
                const std::string_view t
                    = slash == f[i].npos ? v : f[i].substr(slash + 1, second == f[i].npos ? second : second - slash - 1);
                const std::uint64_t position = index(lines, v, positions.size(), "vertex before it");
                const std::uint64_t place = index(lines, t, places.size(), "vt before it");
                const auto [at, fresh] = vertices.try_emplace(position << 32 | place, std::uint32_t(mesh.vertices.size()));
                if (fresh)
                    used.push_back(std::uint32_t(position)),
                        mesh.vertices.push_back({glm::dvec2(0), 1, {glm::dvec3(places[place], 0)}});
                corners.push_back(at->second);
            }
            for (std::size_t i = 2; i < corners.size(); ++i)
                if (corners[0] != corners[i - 1] && corners[i - 1] != corners[i] && corners[i] != corners[0])
                    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
        } else if (unused.size() < 8 && std::find(unused.begin(), unused.end(), f[0]) == unused.end()) {
            unused.emplace_back(one_line(std::string(f[0]), 20));
            mesh.notes.push_back("lines that begin with " + unused.back() + " are not used");
        }
    }
    place_on_screen(mesh, positions, used);
    if (coloured)
        mesh.notes.push_back("colours of vertices are not used");
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat obj_format{.name = "OBJ",
    .endings = {".obj"},
    .read = [](const WarpFile& file, const WarpReading&) { return read_obj(file); },
    .seems = [](const WarpStart& start) { return start.line.starts_with("v ") || start.line.starts_with("#"); }};

} // namespace starbow
