#include "commands.h"
#include "config/import/import_sgct.h"
#include "config/json/whole_file.h"
#include "config/model/layout_reader.h"
#include "config/model/shipped.h"
#include "displays/finish/shade.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/images/capture.h"
#include <cstdio>
#include <memory>
#include <sstream>

namespace starbow {
namespace {

struct ImportOptions {
    std::string file, out;
    long node = -1; ///< below 0: all
    bool force = false;
};

MeshView view_of(const std::filesystem::path& mesh)
{
    try {
        const WarpMesh read = load_warp({mesh});
        return {read.frustum || read.kind == WarpMesh::Kind::colours, read.eye_m, read.frustum};
    } catch (const InputError&) {
        return {}; // the format's default; faults() reports errors in the file
    }
}

/// The errors that keep the layout in a file from being shown, one on each line: every missing file, or else the first
/// other error.
std::vector<std::string> faults(const std::filesystem::path& file)
{
    std::vector<std::string> found;
    const auto attempt = [&](auto&& act) {
        try {
            act();
        } catch (const InputError& error) {
            found.push_back(error.what());
        }
    };
    const Document document = read_document(file);
    for (const Place& output : items(member(root(document), "outputs"), 1, 64, "outputs"))
        for (const Place& viewport : items(member(output, "viewports"), 1, 64, "viewports")) {
            if (const auto mask = find_member(viewport, "alpha_mask"))
                attempt([&] { existing_file(*mask, file.parent_path()); });
            if (const auto warp = find_member(viewport, "warp"))
                attempt([&] { existing_file(member(*warp, "file"), file.parent_path()); });
        }
    if (!found.empty())
        return found;
    attempt([&] {
        const Layout layout = read_layout(root(document), file);
        MapStore store;
        for (std::size_t output = 0; output < layout.outputs.size(); ++output)
            attempt([&] {
                const auto views = compile_output(store, layout, output, layout.outputs[output].size);
                reject_empty(layout, views);
                (void)shade_of(layout, output, layout.outputs[output].size, views, {});
            });
    });
    return found;
}

int import(const ImportOptions& options)
{
    const Document document = read_sgct(options.file);
    check_not_read(options.out, {options.file});
    check_free(options.out, options.force);
    check_writable(options.out);
    const std::filesystem::path from = std::filesystem::absolute(options.file).parent_path().lexically_normal(),
                                to = std::filesystem::absolute(options.out).parent_path().lexically_normal();
    const Import import = import_sgct(document, options.node < 0 ? std::nullopt : std::optional(int(options.node)),
        from.lexically_relative(to), [&](const std::filesystem::path& mesh) { return view_of(from / mesh); });
    std::error_code ignored; // the stream reports it
    std::filesystem::create_directories(to, ignored);
    nlohmann::ordered_json layout;
    try {
        layout["$schema"] = std::filesystem::proximate(home() / "config/schema/layout.schema.json", to).generic_string();
    } catch (const InputError&) {
        // A program outside its checkout has no schema to refer to.
    }
    layout.update(import.layout);
    std::ostringstream text;
    text << "// Made of SGCT's " << one_line(options.file)
         << " by 'starbow import sgct', which reports the new place of each member.\n"
         << layout.dump(4) << "\n";
    write_whole(options.out, text.str());
    const std::vector<std::string> wrong = faults(options.out);
    for (const std::string& line : import.lines)
        std::printf("%s\n", one_line(line).c_str());
    for (const auto& lines : {import.to_mend, wrong})
        for (const std::string& line : lines)
            std::printf("to mend: %s\n", one_line(line).c_str());
    return wrong.empty() ? 0 : 1;
}

} // namespace

static void add_import(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<ImportOptions>();
    Subcommand* command = app.add_subcommand("import", "Make a layout from another program's configuration.");
    command->require_subcommand();
    Subcommand* sgct = command->add_subcommand("sgct", "Import SGCT's JSON, and print the new place of each member");
    sgct->add_option("file", options->file, "SGCT's configuration")->required();
    sgct->add_option("--out", options->out, "The layout's file")->required();
    sgct->add_option("--node", options->node,
            "Only the machine of this number, from 0; without it the layout has the outputs of all, each with its \"node\"")
        ->check(whole_number(0, 1023));
    sgct->add_flag("--force", options->force, "Replace a file of that name");
    sgct->footer("If values must be mended before the layout loads, the last lines name them, and the exit status is 1.\n\n"
                 "Example:\n  starbow import sgct single_fisheye.json --out my/dome.json");
    command->footer("Example:\n  starbow import sgct single_fisheye.json --out my/dome.json");
    sgct->callback([options, &chosen] { chosen = [options] { return import(*options); }; });
}

static const Registered import_command{9, add_import};

} // namespace starbow
