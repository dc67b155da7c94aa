#include "parts.h"
#include <cmath>
#include <cstring>
#include <pugixml.hpp>

namespace starbow {
namespace {

/// The numbers of one parameter list, in fractions of the picture.
std::vector<double> offsets(const WarpFile& file, const pugi::xml_node& definition, const char* name)
{
    const std::string place = std::string("GeometryFile/GeometryDefinition/") + name;
    const pugi::xml_node node = definition.child(name);
    if (!node)
        refuse(file, place, "is missing; a list of numbers is right");
    const std::string_view written = node.attribute("range").value();
    const std::optional<double> range = parsed(written);
    if (!range || !(*range >= 1) || *range > 65536)
        refuse(file, place + "/@range", in_quotes(written) + " is not a number of pixels; one from 1 to 65536 is right");
    const std::string_view text = node.text().get();
    std::vector<double> values;
    for (std::size_t at = text.find_first_not_of(" \t\r\n"); at < text.size(); at = text.find_first_not_of(" \t\r\n", at)) {
        const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
        const std::optional<double> value = parsed(text.substr(at, end - at));
        if (!value || std::abs(*value / *range) > position_range.high)
            refuse(file, place + ", value " + std::to_string(values.size() + 1),
                in_quotes(text.substr(at, end - at)) + (value ? " is too far" : " is not a number")
                    + "; an offset in pixels is right");
        values.push_back(*value / *range);
        at = end;
    }
    return values;
}

} // namespace

static WarpMesh read_simcad(const WarpFile& file)
{
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(file.content.data(), file.content.size());
    if (!result)
        refuse(file, "byte " + std::to_string(result.offset), std::string("is not XML: ") + result.description());
    const pugi::xml_node definition = document.child("GeometryFile").child("GeometryDefinition");
    if (!definition)
        refuse(file, "GeometryFile/GeometryDefinition", "is missing; a SimCAD file is right");
    const std::vector<double> x = offsets(file, definition, "X-FlatParameters"),
                              y = offsets(file, definition, "Y-FlatParameters");
    if (x.size() != y.size())
        refuse(file, "GeometryFile/GeometryDefinition",
            "has " + std::to_string(x.size()) + " offsets in X and " + std::to_string(y.size())
                + " in Y; as many of both is right");
    const int side = int(std::lround(std::sqrt(double(x.size()))));
    if (side < 2 || std::size_t(side) * std::size_t(side) != x.size())
        refuse(file, "GeometryFile/GeometryDefinition",
            "has " + std::to_string(x.size()) + " offsets, which is not a square; 33 x 33 = 1089 is right");

    WarpMesh mesh;
    mesh.format = "SimCAD mesh";
    mesh.grid = {side, side};
    mesh.vertices.reserve(x.size());
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const glm::dvec2 place(double(column) / (side - 1), double(row) / (side - 1));
            const std::size_t i = mesh.vertices.size();
            mesh.vertices.push_back({place + glm::dvec2(x[i], y[i]), 1, {glm::dvec3(place, 0)}});
        }
    join_grid(mesh, std::vector<char>(mesh.vertices.size()));
    check_mesh(mesh, file);
    return mesh;
}

extern const WarpFormat simcad_format{.name = "SimCAD",
    .endings = {".simcad"},
    .begins =
        [](const WarpStart& start) {
            return start.text.starts_with("<") && start.text.substr(0, 4096).find("<GeometryFile") != std::string_view::npos;
        },
    .read = [](const WarpFile& file, const WarpReading&) { return read_simcad(file); }};

} // namespace starbow
