#include "commands.h"
#include "config/json/file_name.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "displays/warp/formats.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/images/capture.h"
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>

namespace starbow {
namespace {

struct WarpOptions {
    std::string file, out, size, region, frustum, aspect;
    FloatMapForm map;
    bool force = false;
    Warp warp() const { return {file, frustum, region, map}; }
};

std::optional<glm::ivec2> parse_size(const std::string& text, int most)
{
    if (text.empty())
        return {};
    glm::ivec2 size(0);
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.y);
        if (height.ec == std::errc() && height.ptr == end && size.x >= 2 && size.y >= 2 && size.x <= most && size.y <= most)
            return size;
    }
    throw InputError("--size " + text + " is not a size; give width x height, each from 2 to " + std::to_string(most)
        + ", such as 960x540");
}

void line(const char* label, const std::string& value) { std::printf("%-10s %s\n", label, one_line(value).c_str()); }

/// The range of a quantity over the vertices that some triangle uses.
template <class Quantity> std::string range(const WarpMesh& mesh, Quantity quantity)
{
    double low = 1e300, high = -1e300;
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t i : triangle) {
            low = std::min(low, quantity(mesh.vertices[i]));
            high = std::max(high, quantity(mesh.vertices[i]));
        }
    return shown(low) + " to " + shown(high);
}

void print(const WarpMesh& mesh)
{
    line("format", mesh.format);
    const glm::ivec2 grid = mesh.cells.x > 0 ? mesh.cells : mesh.grid;
    line("grid",
        grid.x > 0 ? std::to_string(grid.x) + " columns x " + std::to_string(grid.y) + " rows"
                   : std::string("none, triangles alone"));
    std::set<std::uint32_t> used;
    for (const auto& triangle : mesh.triangles)
        used.insert(triangle.begin(), triangle.end());
    line("vertices", std::to_string(mesh.vertices.size()) + ", " + std::to_string(used.size()) + " used");
    line("triangles", std::to_string(mesh.triangles.size()));
    line("at",
        "x " + range(mesh, [](const WarpVertex& v) { return v.at.x; }) + ", y "
            + range(mesh, [](const WarpVertex& v) { return v.at.y; }) + ", fractions of the viewport from its top left");
    const auto of = [&](std::size_t colour, int axis) {
        return range(mesh, [=](const WarpVertex& v) { return v.sees[colour][axis]; });
    };
    if (mesh.kind == WarpMesh::Kind::picture)
        line("sees", "x " + of(0, 0) + ", y " + of(0, 1) + ", fractions of the picture from its top left");
    else if (mesh.kind == WarpMesh::Kind::points)
        line("sees", "points x " + of(0, 0) + ", y " + of(0, 1) + ", z " + of(0, 2) + " metres");
    else
        line("sees", "directions, of green x " + of(1, 0) + ", y " + of(1, 1) + ", z " + of(1, 2));
    line("light", range(mesh, [](const WarpVertex& v) { return v.intensity; }));
    if (mesh.frustum) {
        const Sides s = mesh.frustum->sides.value();
        const Turn& t = mesh.frustum->turn;
        line("frustum",
            "left " + shown(s.left_deg) + " right " + shown(s.right_deg) + " down " + shown(s.down_deg) + " up "
                + shown(s.up_deg) + ", yaw " + shown(t.yaw_deg) + " pitch " + shown(t.pitch_deg) + " roll "
                + shown(t.roll_deg) + " degrees");
    } else
        line("frustum", "none in the file");
    if (mesh.eye_m)
        line("eye", shown(mesh.eye_m->x) + " " + shown(mesh.eye_m->y) + " " + shown(mesh.eye_m->z) + " metres");
    for (const auto& [name, mask] : {std::pair("alpha", &mesh.alpha), std::pair("beta", &mesh.beta)})
        if (*mask)
            line(name,
                std::to_string((*mask)->size.x) + " x " + std::to_string((*mask)->size.y) + ", "
                    + std::to_string((*mask)->channels) + ((*mask)->channels == 1 ? " channel" : " channels") + ", gamma "
                    + shown((*mask)->gamma));
    for (const std::string& note : mesh.notes)
        line("note", note);
    for (const std::string& warning : mesh.warnings)
        line("warning", warning);
}

int inspect(const WarpOptions& options)
{
    const glm::ivec2 size = parse_size(options.size, 8192).value_or(glm::ivec2(1024, 640));
    const WarpMesh mesh = load_warp(options.warp());
    if (!options.out.empty()) {
        check_not_read(options.out, {options.file, options.frustum});
        check_ending(options.out, ".png");
        check_writable(options.out);
    }
    print(mesh);
    if (!options.out.empty()) {
        write_png(options.out, size, portrait(mesh, size));
        std::printf("%s\n", options.out.c_str());
    }
    return 0;
}

void write_text(const std::filesystem::path& file, const std::string& bytes)
{
    make_folder_of(file);
    write_whole(file, bytes);
    std::printf("%s\n", file.c_str());
}

/// The losses of a mesh that was possibly sampled and then written with this file extension, one sentence each.
std::vector<std::string> losses(const WarpMesh& original, const WarpMesh& mesh, const std::string& extension)
{
    std::vector<std::string> all;
    const auto any = [&](const WarpMesh& of, auto&& odd) {
        return std::any_of(of.triangles.begin(), of.triangles.end(), [&](const std::array<std::uint32_t, 3>& t) {
            return std::any_of(t.begin(), t.end(), [&](std::uint32_t i) { return odd(of.vertices[i]); });
        });
    };
    const auto beyond = [](const glm::dvec2& p) { // apart from rounding
        return std::max({-p.x, -p.y, p.x - 1, p.y - 1}) > 1e-9;
    };
    if (mesh.format != original.format) {
        const glm::ivec2 size = mesh.cells.x > 0 ? mesh.cells : mesh.grid;
        const double part = differs(original, mesh);
        all.push_back("sampled on " + std::to_string(size.x) + " x " + std::to_string(size.y) + " places: "
            + (part > 0 ? shown(std::ceil(part * 1e5) / 1e3) + " % of what it covers is lost or gained at its outline"
                        : "nothing is lost at its outline")
            + "; a larger --size follows the mesh more closely");
        if (any(original, [&](const WarpVertex& v) { return beyond(v.at); }))
            all.push_back("what the mesh shows beyond the viewport is left out");
    }
    const bool bourke = extension == ".data" || extension == ".map";
    if (bourke && any(mesh, [&](const WarpVertex& v) { return beyond(glm::dvec2(v.sees[0])); }))
        all.push_back("what looks beyond the picture becomes a hole: this format has no room for it");
    if (!bourke && any(mesh, [](const WarpVertex& v) { return std::abs(v.intensity - 1) > 1e-6; })) // apart from rounding
        all.push_back("the vertices' brightness is lost: this format has no room for it");
    if (mesh.frustum && extension != ".csv")
        all.push_back("the frustum is lost: this format has no room for it");
    return all;
}

int convert(const WarpOptions& options)
{
    const std::string extension = ending_of(options.out);
    if (extension != ".data" && extension != ".map" && extension != ".pfm" && extension != ".csv")
        throw InputError(
            options.out, "", "names no format that can be written; a name that ends in .data, .pfm or .csv is right");
    double aspect = 16.0 / 9;
    if (!options.aspect.empty()) {
        const char* end = options.aspect.data() + options.aspect.size();
        const auto [at, error] = std::from_chars(options.aspect.data(), end, aspect);
        if (error != std::errc() || at != end || !(aspect >= 0.01 && aspect <= 100))
            throw InputError(
                "--aspect " + options.aspect + " is not a width over height; a number from 0.01 to 100 is right");
    }
    const std::optional<glm::ivec2> size = parse_size(options.size, 4096);
    WarpMesh mesh = load_warp(options.warp());
    const std::filesystem::path frustum_file = frustum_beside(options.out);
    std::vector<std::filesystem::path> read{options.file, options.frustum}, written{options.out};
    if (mesh.format == "domeprojection mesh")
        read.push_back(frustum_beside(options.file));
    if (extension == ".csv" && mesh.frustum)
        written.push_back(frustum_file);
    for (const std::filesystem::path& file : written) {
        check_not_read(file, read);
        check_free(file, options.force);
        check_writable(file);
    }
    const WarpMesh original = mesh;
    if (extension == ".pfm" && (size || !is_centred(mesh)))
        mesh = resampled(mesh, size.value_or(glm::ivec2(960, 540)));
    else if (size || mesh.grid.x == 0)
        mesh = gridded(mesh, size.value_or(glm::ivec2(192, 108)));
    if (extension == ".pfm")
        write_text(options.out, write_pfm(mesh, options.file));
    else if (extension == ".csv") {
        write_text(options.out, write_domeprojection(mesh, options.file));
        if (mesh.frustum)
            write_text(frustum_file, write_frustum({*mesh.frustum, mesh.eye_m.value_or(glm::dvec3(0))}));
    } else
        write_text(options.out, write_bourke(mesh, options.file, aspect));
    for (const std::string& loss : losses(original, mesh, extension))
        std::fprintf(stderr, "starbow: %s: %s\n", one_line(options.out).c_str(), one_line(loss).c_str());
    return 0;
}

void add_input(Subcommand& command, WarpOptions& options)
{
    command.add_option("file", options.file, "A warp file")->required();
    command.add_option("--region", options.region, "The region, if an MPCDI file has several");
    command.add_option("--frustum", options.frustum, "domeprojection's NAME_frustum.csv, if it is elsewhere");
    command.add_flag(
        "--first-row-on-top", options.map.first_row_on_top, "Take a PFM's first row as its top one, against the standard");
    command.add_flag("--v-up", options.map.v_up, "Count a PFM's places from the picture's lower edge, not its upper one");
    command.add_flag("--edge-to-edge", options.map.edge_to_edge,
        "Take a PFM's outer samples to lie on the viewport's edges, not half a cell inside");
    command.add_flag("--offsets", options.map.offsets,
        "Take a PFM's values as offsets of a regular grid's points, to the right and up, not as places in the picture");
}

} // namespace

static void add_warp(Subcommand& app, std::function<int()>& chosen)
{
    Subcommand* command = app.add_subcommand("warp", "Inspect calibrations, and convert them to another format.");
    command->require_subcommand();
    auto looking = std::make_shared<WarpOptions>(), changing = std::make_shared<WarpOptions>();

    Subcommand* inspect_command = command->add_subcommand("inspect", "Print the content of a warp file, and draw it");
    add_input(*inspect_command, *looking);
    inspect_command->add_option("--out", looking->out, "Draw it to this PNG");
    inspect_command->add_option("--size", looking->size, "Pixels of the PNG, WIDTHxHEIGHT; 1024x640 if not given");
    inspect_command->footer(
        "The frame encloses the viewport; its surroundings are dark grey. A colour is a place in "
        "the\n"
        "picture that is warped: blue its upper left, red its upper right, green its lower left, yellow its lower right. "
        "White lines\n"
        "are tenths of that picture; where the mesh knows points in metres, each ten degrees as seen from the eye; where a\n"
        "headset's directions, each fifth of a tangent. Dark lines are the mesh. Darker colours are dimmed, black shows "
        "nothing.\n\n"
        "Example:\n  starbow warp inspect dome.data --out dome.png");
    inspect_command->callback([looking, &chosen] { chosen = [looking] { return inspect(*looking); }; });

    Subcommand* convert_command
        = command->add_subcommand("convert", "Write a warp file as a Bourke mesh (.data), PFM or domeprojection's .csv");
    add_input(*convert_command, *changing);
    convert_command->add_option("out", changing->out, "The new file; the end of its name chooses the format")->required();
    convert_command->add_option(
        "--size", changing->size, "Sample it first: WIDTHxHEIGHT vertices of a mesh, or cells of a PFM");
    convert_command->add_option(
        "--aspect", changing->aspect, "Width over height of a Bourke mesh's screen; 16/9 if not given");
    convert_command->add_flag("--force", changing->force, "Replace a file of that name");
    convert_command->footer("Example:\n  starbow warp convert channel1.sgc channel1.pfm --size 1920x1200");
    convert_command->callback([changing, &chosen] { chosen = [changing] { return convert(*changing); }; });
    command->footer("Example:\n  starbow warp inspect dome.data --out dome.png\n  starbow warp convert channel1.sgc "
                    "channel1.pfm --size 1920x1200");
}

static const Registered warp_command{8, add_warp};

} // namespace starbow
