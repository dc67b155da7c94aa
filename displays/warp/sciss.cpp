#include "config/model/turn.h"
#include "parts.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace starbow {
namespace {

/// Little-endian values one after the other.
struct Reader {
    const WarpFile& file;
    std::size_t at = 0;

    std::size_t left() const { return file.content.size() - at; }
    std::string place() const { return "byte " + std::to_string(at); }
    std::uint8_t byte() { return std::uint8_t(file.content[at++]); }
    std::uint32_t word(const char* what)
    {
        if (left() < 4)
            refuse(file, place(), std::string(what) + " is missing, the file ends early; a whole file is right");
        std::uint32_t value = 0;
        for (int shift = 0; shift < 32; shift += 8)
            value |= std::uint32_t(byte()) << shift;
        return value;
    }
    double number(const char* what, Range range)
    {
        const std::string where = place();
        const double value = std::bit_cast<float>(word(what));
        if (!(value >= range.low && value <= range.high))
            refuse(file, where,
                shown(value) + " as " + what + " is out of range; a number from " + shown(range.low) + " to "
                    + shown(range.high) + " is right");
        return value;
    }
    void room(std::size_t count, std::size_t each, const char* what)
    {
        if (count > left() / each)
            refuse(file, "byte " + std::to_string(at - 4),
                std::to_string(count) + " " + what + " need more than the " + std::to_string(left())
                    + " bytes that follow; the number of those that are there is right");
    }
};

/// True if the triangles, a strip's, are all of a grid so many columns wide, but perhaps for one of a cell's two. Then the
/// grid says the same without the strip's slivers, and with the corner that real strips leave out.
bool fills_grid(const WarpMesh& mesh, std::size_t columns)
{
    if (columns < 2 || mesh.vertices.size() % columns != 0 || mesh.vertices.size() / columns < 2)
        return false;
    const std::size_t rows = mesh.vertices.size() / columns, cells = (columns - 1) * (rows - 1);
    std::vector<char> filled((columns - 1) * (rows - 1));
    for (const auto& t : mesh.triangles) {
        const auto [from, to] = std::minmax({t[0] % columns, t[1] % columns, t[2] % columns});
        const auto [low, high] = std::minmax({t[0] / columns, t[1] / columns, t[2] / columns});
        if (to - from > 1 || high - low > 2)
            return false;
        if (to > from && high == low + 1)
            filled[low * (columns - 1) + from] = 1;
    }
    return std::size_t(std::count(filled.begin(), filled.end(), 1)) == cells;
}

/// The first bytes of the file.
struct Head {
    int version = 0; ///< 1: a grid; 2: a list of triangles or a strip
    bool cube = false; ///< the vertices look into a cube map; else into a planar picture
};

Head read_head(Reader& in)
{
    const WarpFile& file = in.file;
    if (!file.content.starts_with("SGC") || file.content.size() < 4)
        refuse(file, "byte 0", "is not a SCISS mesh; one that begins with SGC is right");
    in.at = 3;
    const int version = in.byte();
    if (version != 1 && version != 2)
        refuse(file, "byte 3", std::to_string(version) + " is a version that is not known; 1 or 2 is right");
    const std::uint32_t type = in.word("the type");
    if (type > 1)
        refuse(file, "byte 4", std::to_string(type) + " is a type that is not known; 0, planar, or 1, cube, is right");
    return {version, type == 1};
}

/// Reads the projector. Returns its turn; the eye's place and the frustum go into the mesh.
glm::dquat read_projector(Reader& in, const Head& head, WarpMesh& mesh)
{
    const Range unit{-1.01, 1.01}, angle{-180, 180};
    const double qx = in.number("the quaternion's x", unit), qy = in.number("the quaternion's y", unit),
                 qz = in.number("the quaternion's z", unit), qw = in.number("the quaternion's w", unit);
    glm::dquat turn(qw, qx, qy, qz);
    if (std::abs(glm::length(turn) - 1) > 0.01)
        refuse(
            in.file, "byte 8", "a quaternion of length " + shown(glm::length(turn)) + " is not a turn; length 1 is right");
    turn = glm::normalize(turn);
    const double x = in.number("the position's x", metre_range), y = in.number("the position's y", metre_range),
                 z = in.number("the position's z", metre_range);
    mesh.eye_m = glm::dvec3(x, y, z);
    const double up = in.number("the angle up", angle), down = in.number("the angle down", angle),
                 left = in.number("the angle to the left", angle), right = in.number("the angle to the right", angle);
    if (!head.cube)
        mesh.frustum = Planar{
            60, checked_sides(in.file, "byte 36", {left, right, down, up}), turn_of(turn.x, turn.y, turn.z, turn.w)};
    return turn;
}

/// The arrangement of the vertices.
struct Arrangement {
    std::size_t count = 0; ///< of vertices
    bool strip = true; ///< the indices are a strip's; else three for each triangle
    glm::ivec2 grid{0}; ///< as WarpMesh::grid
};

Arrangement read_arrangement(Reader& in, int version)
{
    const std::uint32_t first = in.word(version == 1 ? "the number of columns" : "the primitive");
    const std::uint32_t second = in.word(version == 1 ? "the number of rows" : "the number of vertices");
    if (version == 1) {
        if (first < 2 || second < 2 || first > std::uint32_t(most_grid) || second > std::uint32_t(most_grid))
            refuse(in.file, "byte 52",
                std::to_string(first) + " columns and " + std::to_string(second) + " rows are not a grid; 2 to "
                    + std::to_string(most_grid) + " of each is right");
        return {std::size_t(first) * second, true, {int(first), int(second)}};
    }
    if (first != 4 && first != 5)
        refuse(in.file, "byte 52",
            std::to_string(first) + " is a primitive that is not known; 4, triangles, or 5, a strip, is right");
    return {second, first == 5, {}};
}

void read_vertices(Reader& in, const Head& head, const glm::dquat& turn, std::size_t count, WarpMesh& mesh)
{
    in.room(count, 24, "vertices");
    mesh.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        WarpVertex vertex;
        vertex.at.x = in.number("a vertex's x", position_range);
        vertex.at.y = in.number("a vertex's y", position_range);
        in.number("a vertex's z", {-1e30, 1e30});
        const std::string place = in.place();
        const double u = in.number("a vertex's u", picture_range), v = in.number("a vertex's v", picture_range);
        const double w = in.number("a vertex's w", {-1e30, 1e30});
        if (!head.cube)
            vertex.sees[0] = {u, 1 - v, 0};
        else {
            const glm::dvec3 way = turn * glm::dvec3(u, v, w);
            if (!(glm::length(way) > 1e-6) || glm::length(way) > 1e6)
                refuse(in.file, place, "a vertex looks nowhere; a direction in a cube map is right");
            vertex.sees.fill(glm::normalize(way));
            mesh.kind = WarpMesh::Kind::colours;
        }
        mesh.vertices.push_back(vertex);
    }
}

/// Reads the triangles into the mesh. Returns the second index: in a grid's strip the vertex below the first.
std::uint32_t read_triangles(Reader& in, const Arrangement& arrangement, WarpMesh& mesh)
{
    const std::size_t count = arrangement.count;
    const std::uint32_t indices = in.word("the number of indices");
    in.room(indices, 4, "indices");
    const std::size_t corners = indices > 0 ? indices : count; // none: the vertices as they stand
    std::uint32_t second_index = 0;
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < corners; ++i) {
        const std::string place = in.place();
        const std::uint32_t index = indices > 0 ? in.word("an index") : std::uint32_t(i);
        if (index >= count)
            refuse(in.file, place,
                std::to_string(index) + " is not the number of a vertex; one below " + std::to_string(count) + " is right");
        if (i == 1)
            second_index = index;
        t = {t[1], t[2], index};
        const bool complete = arrangement.strip ? i >= 2 : i % 3 == 2;
        if (complete && t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            mesh.triangles.push_back(arrangement.strip && i % 2 ? std::array{t[1], t[0], t[2]} : t);
    }
    return second_index;
}

/// Replaces a strip that fills a grid of so many columns by the whole grid.
void make_grid(WarpMesh& mesh, std::size_t columns)
{
    if (!fills_grid(mesh, columns))
        return;
    const std::size_t count = mesh.vertices.size();
    mesh.grid = {int(columns), int(count / columns)};
    mesh.triangles.clear();
    join_grid(mesh, std::vector<char>(count));
}

} // namespace

static WarpMesh read_sciss(const WarpFile& file)
{
    Reader in{file};
    const Head head = read_head(in);
    WarpMesh mesh;
    mesh.format = "SCISS mesh, version " + std::to_string(head.version) + (head.cube ? ", cube" : "");
    const glm::dquat turn = read_projector(in, head, mesh);
    const Arrangement arrangement = read_arrangement(in, head.version);
    mesh.grid = arrangement.grid;
    read_vertices(in, head, turn, arrangement.count, mesh);
    const std::uint32_t second_index = read_triangles(in, arrangement, mesh);
    if (in.left() > 0)
        mesh.notes.push_back(std::to_string(in.left()) + " bytes after the end are not used");
    if (mesh.grid.x > 0)
        make_grid(mesh, std::size_t(mesh.grid.x));
    else if (arrangement.strip && arrangement.count > 1)
        make_grid(mesh, second_index);
    rows_from_top(mesh);
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat sciss_format{.name = "SCISS",
    .endings = {".sgc"},
    .begins = [](const WarpStart& start) { return start.bytes.starts_with("SGC"); },
    .read = [](const WarpFile& file, const WarpReading&) { return read_sciss(file); }};

} // namespace starbow
