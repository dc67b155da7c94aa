#include "reference.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/commands/options/size.h"
#include "runtime/images/capture.h"
#include "runtime/operation/progress.h"
#include "runtime/reference/reference.h"
#include <cstdio>

namespace starbow {

int render_reference(const ReferenceCommand& command)
{
    const std::filesystem::path shot_file = shipped_file("shots", command.shot);
    const Shot shot = load_shot(shot_file);
    Layout layout = load_layout(shipped_file("layouts", command.layout.empty() ? "desk" : command.layout));
    if (!command.size.empty())
        for (Output& output : layout.outputs)
            output.size = parse_size(command.size);
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
    const ReferenceWorld world = open_reference_world(scene_of(shot, shot_file));
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

} // namespace starbow
