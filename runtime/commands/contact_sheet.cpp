#include "contact_sheet.h"
#include "config/model/shipped.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

namespace starbow {
namespace {

namespace fs = std::filesystem;

struct Job {
    std::string layout, shot;
    std::string name() const { return layout == "desk" ? shot : layout + "-" + shot; }
};

std::vector<Job> jobs()
{
    std::vector<Job> all;
    for (const auto& entry : fs::directory_iterator(home() / "config" / "shots"))
        if (entry.path().extension() == ".json")
            all.push_back({"desk", entry.path().stem()});
    // Whoever waits for the first picture sees the default world's best one.
    const auto place = [](const Job& job) { return std::pair(job.shot != "starbow", job.shot); };
    std::sort(all.begin(), all.end(), [&](const Job& a, const Job& b) { return place(a) < place(b); });
    all.push_back({"dome", "avenue-gamma4"});
    all.push_back({"stereo", "avenue-gamma4"});
    return all;
}

constexpr int cell_width = 400, cell_height = 300, label_height = 28, columns = 3;

/// A grid of pictures with their names below; RGBA8 in sRGB.
struct Sheet {
    glm::ivec2 size;
    std::vector<std::uint8_t> rgba;

    explicit Sheet(int count)
        : size(columns * cell_width, (count + columns - 1) / columns * (cell_height + label_height))
        , rgba(std::size_t(size.x) * size.y * 4, 24)
    {
    }

    /// Shrinks a picture by averaging whole pixels, in the encoded values, and keeps its aspect.
    void place(int index, const std::string& name, glm::ivec2 from, const std::vector<std::uint8_t>& picture,
        const Typesetter& typesetter)
    {
        glm::ivec2 corner(index % columns * cell_width, index / columns * (cell_height + label_height));
        double shrink = std::max(double(from.x) / (cell_width - 8), double(from.y) / (cell_height - 8));
        glm::ivec2 to = glm::max(glm::ivec2(glm::dvec2(from) / shrink), 1),
                   margin = (glm::ivec2(cell_width, cell_height) - to) / 2;
        for (int y = 0; y < to.y; ++y)
            for (int x = 0; x < to.x; ++x) {
                glm::ivec2 first = glm::ivec2(glm::dvec2(x, y) * shrink),
                           last = glm::ivec2(glm::dvec2(x + 1, y + 1) * shrink);
                last = glm::min(glm::max(last, first + 1), from);
                glm::dvec3 sum(0);
                for (int j = first.y; j < last.y; ++j)
                    for (int i = first.x; i < last.x; ++i)
                        for (int k = 0; k < 3; ++k)
                            sum[k] += picture[4 * (std::size_t(j) * from.x + i) + k];
                glm::ivec2 n = glm::max(last - first, 1);
                for (int k = 0; k < 3; ++k)
                    at(corner + margin + glm::ivec2(x, y))[k] = std::uint8_t(std::lround(sum[k] / (n.x * n.y)));
            }
        Panel label;
        label.size = {cell_width, label_height};
        label.texels.assign(std::size_t(cell_width) * label_height * 2, 0);
        typesetter.write(label, name, 8, 18, 18, 1);
        for (int y = 0; y < label_height; ++y)
            for (int x = 0; x < cell_width; ++x)
                for (int k = 0; k < 3; ++k) {
                    std::uint8_t& value = at(corner + glm::ivec2(x, cell_height + y))[k];
                    value = std::max(value, label.texels[2 * (std::size_t(y) * cell_width + x)]);
                }
    }

    std::uint8_t* at(glm::ivec2 p) { return &rgba[4 * (std::size_t(p.y) * size.x + p.x)]; }
};

} // namespace

int render_contact_sheet(const fs::path& directory)
{
    std::vector<Job> all = jobs();
    Typesetter typesetter;
    const Words words = words_in("en");
    Sheet sheet(int(all.size()));
    std::map<fs::path, std::unique_ptr<RenderContext>> theatres;
    auto began = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < all.size(); ++i) {
        fs::path shot_file = shipped_file("shots", all[i].shot);
        Shot shot = load_shot(shot_file);
        fs::path scene = scene_of(shot, shot_file);
        Layout layout = load_layout(shipped_file("layouts", all[i].layout));
        auto& context = theatres[scene];
        if (!context)
            context = std::make_unique<RenderContext>(scene, device_options(false));
        OffscreenRenderer renderer(
            context->device, context->pipelines, context->world, layout, default_quality(context->device, true), false);
        Panel panel = typesetter.draw(
            readings(ship_at(shot), context->world.scene, shot.effects), words, renderer.frame().views().hud_width());
        fs::path folder = directory / all[i].name();
        auto pictures = render_still(folder, renderer, shot, false, &panel);
        sheet.place(int(i), all[i].name(), layout.outputs[0].size, pictures[0], typesetter);
        double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        if (i == 0)
            std::printf("The first picture is %s; %zu more follow.\n",
                (folder / (layout.outputs[0].name + ".png")).string().c_str(), all.size() - 1);
        std::printf("%zu of %zu  %-28s about %.0f s left\n", i + 1, all.size(), (folder.string() + "/").c_str(),
            passed / double(i + 1) * double(all.size() - i - 1));
        std::fflush(stdout);
    }
    write_png(directory / "contact-sheet.png", sheet.size, sheet.rgba);
    std::printf("%s shows them all.\n", (directory / "contact-sheet.png").c_str());
    return 0;
}

} // namespace starbow
