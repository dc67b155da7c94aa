#include "commands.h"
#include "config/import_sgct.h"
#include "displays/warp/mesh.h"
#include "runtime/capture.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <memory>

namespace starbow {
namespace {

struct Options {
    std::string file, out;
    int node = 0;
};

MeshView view_of(const std::filesystem::path& mesh)
{
    try {
        const WarpMesh read = load_warp({mesh});
        return {read.frustum || read.kind == WarpMesh::Kind::colours, read.eye_m};
    } catch (const InputError&) {
        return {}; // as its kind has it; what is wrong with the file is told where the layout is tried
    }
}

int import(const Options& options)
{
    const Document document = read_document(options.file);
    check_writable(options.out);
    const std::filesystem::path from = std::filesystem::absolute(options.file).parent_path().lexically_normal(),
                                to = std::filesystem::absolute(options.out).parent_path().lexically_normal();
    const Import import = import_sgct(document, options.node, from.lexically_relative(to),
        [&](const std::filesystem::path& mesh) { return view_of(from / mesh); });
    for (const std::string& line : import.lines)
        std::printf("%s\n", one_line(line).c_str());
    std::error_code ignored; // told by the stream
    std::filesystem::create_directories(to, ignored);
    std::ofstream stream(options.out);
    stream << import.layout.dump(4) << "\n";
    if (!stream.flush())
        throw InputError(options.out, "", "can't be written; give a file in a folder that can be");
    return 0;
}

} // namespace

void add_import(CLI::App& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("import", "Make a layout of another program's configuration.");
    command->require_subcommand(1);
    CLI::App* sgct = command->add_subcommand("sgct", "Of SGCT's JSON; says line by line what became of each member");
    sgct->add_option("file", options->file, "SGCT's configuration")->required();
    sgct->add_option("--out", options->out, "The layout's file")->required();
    sgct->add_option("--node", options->node, "Which of several machines, from 0")->capture_default_str();
    command->footer("Example:\n  starbow import sgct single_fisheye.json --out my/dome.json");
    sgct->callback([options, &chosen] { chosen = [options] { return import(*options); }; });
}

} // namespace starbow
