#include "runtime/reference/reference.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/commands/options/size.h"
#include "runtime/commands/options/still_shot.h"
#include "runtime/commands/tools.h"
#include "runtime/images/capture.h"
#include "runtime/operation/progress.h"
#include <cstdio>
#include <memory>

namespace starbow {
namespace {

struct ReferencePictures {
    std::string layout, shot, scene, out, size; ///< layout, size: "" for the desk, and as the layout's
    long samples = 16;
    bool exr = false;
};

/// Draws a shot's pictures by rays, without a device, and writes OUT/<output>.png (and .exr). Finished rows are stored in
/// OUT/<output>.rows until the picture is written. Returns the exit status.
int render_reference(const ReferencePictures& command)
{
    const auto [shot, scene, file] = still_shot(command.shot, command.scene);
    const Layout layout = layout_in_size(command.layout, command.size);
    std::vector<std::filesystem::path> pictures;
    for (const Output& output : layout.outputs)
        for (const Viewport& viewport : output.viewports)
            pictures.insert(pictures.end(), {viewport.alpha_mask, viewport.black_level});
    for (const Output& output : layout.outputs) {
        constexpr double most = 1 << 26; // pixels: with measured channels and two eyes they take 8 GB
        if (double(output.size.x) * output.size.y > most)
            throw InputError("--reference of " + std::to_string(output.size.x) + "x" + std::to_string(output.size.y)
                + " pixels is too large; at most 8192x8192, or as many in another shape, is right");
    }
    const std::filesystem::path folder = command.out;
    for (const Output& output : layout.outputs)
        for (const char* kind : {".png", ".exr", ".rows"}) {
            check_not_read(folder / (output.name + kind), pictures);
            check_writable(folder / (output.name + kind));
        }
    const ReferenceWorld world = open_reference_world(scene);
    for (const std::string& note : world.world.notes)
        std::fprintf(stderr, "starbow: %s: %s\n", one_line(world.scene.gltf.string()).c_str(), one_line(note).c_str());
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw InputError(folder.string(), "", "can't be made (" + error.message() + "); give a folder that can be written");
    for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
        const Output& output = layout.outputs[i];
        const std::filesystem::path kept = folder / (output.name + ".rows");
        Progress progress;
        const Reference drawn = reference(world.input(), layout, shot, i,
            {.samples = int(command.samples),
                .numbers = command.exr,
                .progress =
                    [&](int done, int all) {
                        progress.show(output.name + ": " + std::to_string(done) + " of " + std::to_string(all) + " rows",
                            double(done) / all);
                    },
                .kept = kept});
        write_png(folder / (output.name + ".png"), drawn.size, shown(drawn));
        if (command.exr)
            write_exr(folder / (output.name + ".exr"), drawn.size, channels(drawn));
        std::filesystem::remove(kept, error);
    }
    for (const Output& output : layout.outputs)
        std::printf("%s/%s.png%s\n", command.out.c_str(), output.name.c_str(), command.exr ? " and .exr" : "");
    return 0;
}

} // namespace

static void add_reference(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<ReferencePictures>();
    Subcommand* command = app.add_subcommand(reference_tool.name, reference_tool.help);
    command->add_option("--layout", options->layout, "");
    command->add_option("--shot", options->shot, "");
    command->add_option("--scene", options->scene, "");
    command->add_option("--out", options->out, "");
    command->add_option("--size", options->size, "");
    command->add_option("--samples", options->samples, "");
    command->add_flag("--exr", options->exr, "");
    command->callback([options, &chosen] { chosen = [options] { return render_reference(*options); }; });
}

static const Registered reference_command{19, add_reference};

} // namespace starbow
