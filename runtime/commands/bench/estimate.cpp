#include "estimate.h"
#include "config/model/shipped.h"
#include "runtime/operation/progress.h"
#include "runtime/render/frame_estimate.h"
#include <algorithm>
#include <cstdio>

namespace starbow {

void bench_estimate(const std::string& family, const std::string& layout_name, const std::string& shot_name)
{
    const auto card = std::ranges::find(named_cards, family, &NamedCard::family);
    const std::filesystem::path shot_file = shipped_file("shots", shot_name);
    const Shot shot = load_shot(shot_file);
    const Layout layout = load_layout(shipped_file("layouts", layout_name));
    std::vector<PassEstimate> passes;
    {
        Progress progress;
        progress.show("drawing " + shot_name + " on " + layout_name + " once, and compiling its shaders", 0);
        passes = frame_estimate(scene_of(shot, shot_file), layout, shot, *card);
    }
    std::printf("%s: a frame of %s on %s in `fine`, an estimate. It leaves out the wait for texels, the fixed cost of each\n"
                "pass, and the processor: a frame takes longer.\n\n%-16s%12s%12s%15s%12s\n",
        card->name, shot_name.c_str(), layout_name.c_str(), "", "vertices", "fragments", "arithmetic, ms", "memory, ms");
    double sum = 0;
    for (const PassEstimate& pass : passes) {
        std::printf("%-16s%12.0f%12.0f%15.3f%12.3f\n", pass.pass.c_str(), pass.vertices, pass.fragments, pass.arithmetic_ms,
            pass.memory_ms);
        sum += pass.ms();
    }
    std::printf("%-16s%39.3f, the greater one of each pass\n", "frame", sum);
}

} // namespace starbow
