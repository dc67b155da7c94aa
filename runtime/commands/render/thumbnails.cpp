#include "thumbnails.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "displays/compile/compiled_view.h"
#include "runtime/exhibit/thumbnails.h"
#include "runtime/operation/progress.h"
#include <cstdio>

namespace starbow {

int render_thumbnails()
{
    const std::filesystem::path folder = map_cache_folder();
    if (folder.empty())
        throw InputError("--thumbnails finds no folder for the cache; a folder in STARBOW_CACHE is right");
    const std::vector<Thumbnail> all = thumbnails(
        folder, words_in("en"), [](const std::string& why) { std::fprintf(stderr, "starbow: %s\n", why.c_str()); });
    std::size_t drawn = 0;
    {
        Progress progress;
        drawn = draw_thumbnails(all, [&](const Thumbnail& one, std::size_t before) {
            progress.show("drawing the " + one.kind + " " + one.name, double(before) / double(all.size()));
        });
    }
    std::printf("%zu of %zu small pictures are new, in %s\n", drawn, all.size(), folder.c_str());
    return 0;
}

} // namespace starbow
