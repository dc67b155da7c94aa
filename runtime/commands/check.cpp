#include "commands.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "displays/check/floor_plan.h"
#include "displays/check/floor_plan_table.h"
#include "displays/check/lint.h"
#include "displays/compile/compiled_view.h"
#include "displays/finish/shade.h"
#include "runtime/images/capture.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>

namespace starbow {
namespace {

struct CheckOptions {
    std::string layout, svg;
};

/// The directions of warped viewports' pixels, from their compiled maps. Throws InputError for a layout that can be read
/// but not drawn.
ViewRegion compiled_region(const Layout& layout)
{
    MapStore store;
    auto maps = std::make_shared<std::map<const Viewport*, CompiledView>>();
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        if (!layout.outputs[output].preview) {
            const std::vector<CompiledView> views = compile_output(store, layout, output, layout.outputs[output].size);
            reject_empty(layout, views);
            (void)shade_of(layout, output, layout.outputs[output].size, views, {});
            for (const CompiledView& view : views)
                (*maps)[&layout.outputs[output].viewports[view.view.viewport]] = view;
        }
    return [maps](const Output&, const Viewport& viewport, glm::dvec2 pixel) -> std::optional<glm::dvec3> {
        const DirectionMap& map = *maps->at(&viewport).map;
        const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(pixel)), glm::ivec2(0), map.size - 1);
        const glm::vec4 texel = map.at(at.x, at.y);
        return texel.w > 0 ? std::optional<glm::dvec3>(texel) : std::nullopt;
    };
}

int check(const CheckOptions& options)
{
    const std::filesystem::path layout_file = shipped_file("layouts", options.layout);
    const Layout layout = load_layout(layout_file);
    const std::filesystem::path file = options.svg.empty() ? layout.name + "-plan.svg" : options.svg;
    check_not_read(file, {layout_file});
    check_ending(file, ".svg");
    check_writable(file);
    const std::vector<Coverage> shown = coverages(layout, compiled_region(layout));
    for (const FloorPlanRow& row : floor_plan_rows(layout, shown))
        std::printf("%s: %s; %s, %s of the sky; %s pixels, %s per degree\n", row.name.c_str(), row.projection.c_str(),
            row.spans.c_str(), row.sky.c_str(), row.pixels.c_str(),
            row.per_degree.empty() ? "none" : row.per_degree.c_str());
    for (const std::string& line : overlap_lines(layout, shown))
        std::printf("%s\n", line.c_str());
    for (const std::string& line : lint(layout, shown))
        std::printf("note: %s\n", line.c_str());
    if (file.has_parent_path())
        std::filesystem::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream << draw_floor_plan(layout, shown);
    stream.close();
    if (!stream)
        throw InputError(file.string(), "", "can't be written; a folder with room and leave to write is right");
    std::printf("%s\n", file.c_str());
    return 0;
}

} // namespace

void add_check(CLI::App& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command
        = app.add_subcommand("check", "Read a layout, print what each viewport shows, and draw the floor plan.");
    command->add_option("FILE", options->layout, "A layout file, or the name of one in config/layouts")->required();
    command->add_option("--svg", options->svg, "The drawing; without it LAYOUT-plan.svg in the current folder");
    command->footer("Example:\n  starbow check dome --svg out/dome.svg");
    command->callback([options, &chosen] { chosen = [options] { return check(*options); }; });
}

} // namespace starbow
