#include "flash_sheet.h"
#include "runtime/hud/hud.h"
#include "runtime/images/capture.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace flash_sheet {
namespace {

using Ink = std::array<std::uint8_t, 3>;
constexpr Ink ground{22, 22, 26}, chart_ground{34, 34, 40}, line{90, 90, 98}, text_ink{225, 225, 225}, limit{255, 255, 255},
    general{86, 180, 233}, red{230, 97, 40}, marked{255, 220, 60};
constexpr int width = 1200, chart_left = 48, chart_width = 700, chart_height = 200, picture_left = 788, picture_width = 392,
              title_height = 34, foot_height = 62, text_px = 17;

/// RGBA8 in sRGB.
struct FlashPaper {
    glm::ivec2 size;
    std::vector<std::uint8_t> rgba;

    explicit FlashPaper(glm::ivec2 s)
        : size(s)
        , rgba(std::size_t(s.x) * std::size_t(s.y) * 4)
    {
        fill({0, 0}, s, ground);
    }
    void put(glm::ivec2 p, const Ink& colour)
    {
        if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y)
            return;
        std::uint8_t* at = &rgba[4 * (std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x))];
        std::copy(colour.begin(), colour.end(), at);
        at[3] = 255;
    }
    void fill(glm::ivec2 from, glm::ivec2 extent, const Ink& colour)
    {
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x)
                put(from + glm::ivec2(x, y), colour);
    }
    void write(const Typesetter& typesetter, const std::string& words, glm::ivec2 baseline, const Ink& colour)
    {
        Panel panel;
        panel.size = {int(std::ceil(typesetter.width_of(words, text_px))) + 4, 2 * text_px};
        panel.texels.assign(std::size_t(panel.size.x) * std::size_t(panel.size.y) * 2, 0);
        typesetter.write(panel, words, 0, text_px * 1.4, text_px, 1);
        for (int y = 0; y < panel.size.y; ++y)
            for (int x = 0; x < panel.size.x; ++x)
                if (const int part = panel.texels[2 * (std::size_t(y) * std::size_t(panel.size.x) + std::size_t(x))];
                    part > 0) {
                    const glm::ivec2 p = baseline + glm::ivec2(x, y - int(text_px * 1.4));
                    if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y)
                        continue;
                    const std::uint8_t* under = &rgba[4 * (std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x))];
                    Ink mixed;
                    for (std::size_t k = 0; k < 3; ++k)
                        mixed[k] = std::uint8_t((under[k] * (255 - part) + colour[k] * part) / 255);
                    put(p, mixed);
                }
    }
};

int picture_height(const FlashStrip& strip) { return strip.size.x > 0 ? picture_width * strip.size.y / strip.size.x : 0; }

int height_of(const FlashStrip& strip)
{
    return title_height + std::max(chart_height, std::min(picture_height(strip), 2 * chart_height)) + foot_height;
}

/// Flashes in a second over time: an area for the general ones, a line over it for the red ones.
void draw_chart(FlashPaper& sheet, const Typesetter& typesetter, const FlashStrip& strip, glm::ivec2 corner)
{
    int most = 2 * (most_flashes + 1);
    for (const std::vector<int>& changes : strip.changes)
        for (const int n : changes)
            most = std::max(most, n + 1);
    const auto y_of = [&](int changes) { return corner.y + chart_height - 1 - changes * (chart_height - 1) / most; };
    sheet.fill(corner, {chart_width, chart_height}, chart_ground);
    for (int flashes = 0; 2 * flashes <= most; flashes += most > 16 ? 5 : 1) {
        sheet.fill({corner.x, y_of(2 * flashes)}, {chart_width, 1}, line);
        sheet.write(typesetter, std::to_string(flashes), {corner.x - 28, y_of(2 * flashes) + 6}, text_ink);
    }
    const double end_s = strip.times_s.empty() ? 1 : std::max(strip.times_s.back(), 1e-9);
    for (std::size_t kind = 0; kind < flash_kinds; ++kind) {
        std::vector<int> columns(chart_width, 0);
        for (std::size_t i = 0; i < strip.times_s.size(); ++i) {
            int& column = columns[std::size_t(strip.times_s[i] / end_s * (chart_width - 1))];
            column = std::max(column, strip.changes[kind][i]);
        }
        for (int x = 0; x < chart_width; ++x)
            if (const int n = columns[std::size_t(x)]; n > 0) {
                if (kind == std::size_t(FlashKind::general))
                    sheet.fill({corner.x + x, y_of(n)}, {1, corner.y + chart_height - y_of(n)}, general);
                else
                    sheet.fill({corner.x + x, y_of(n) - 1}, {1, 3}, red);
            }
    }
    for (int x = 0; x < chart_width; x += 8)
        sheet.fill({corner.x + x, y_of(2 * most_flashes)}, {4, 2}, limit);
    for (int mark = 0; mark <= 4; ++mark) {
        const int x = corner.x + mark * (chart_width - 1) / 4;
        sheet.fill({x, corner.y + chart_height}, {1, 5}, line);
        char seconds[32];
        std::snprintf(seconds, sizeof seconds, mark == 4 ? "%.1f s" : "%.1f", end_s * mark / 4);
        sheet.write(typesetter, seconds, {x - (mark == 4 ? 44 : 10), corner.y + chart_height + 24}, text_ink);
    }
    sheet.write(typesetter, "general flashes", {corner.x, corner.y + chart_height + 46}, general);
    sheet.write(typesetter, "red flashes", {corner.x + 190, corner.y + chart_height + 46}, red);
    sheet.write(typesetter, "- - the most allowed in a second", {corner.x + 330, corner.y + chart_height + 46}, limit);
}

void draw_frame(FlashPaper& sheet, const FlashStrip& strip, glm::ivec2 corner, int most_height)
{
    if (strip.size.x == 0)
        return;
    const double scale = std::min(double(picture_width) / strip.size.x, double(most_height) / strip.size.y); // of a pixel
    const glm::ivec2 extent = glm::ivec2(glm::dvec2(strip.size) * scale);
    const auto source
        = [&](glm::ivec2 p) { return glm::clamp(glm::ivec2(glm::dvec2(p) / scale), glm::ivec2(0), strip.size - 1); };
    const auto flashes = [&](glm::ivec2 p) {
        const glm::ivec2 s = source(p);
        return !strip.flashing.empty() && p.x >= 0 && p.y >= 0 && p.x < extent.x && p.y < extent.y
            && strip.flashing[std::size_t(s.y) * std::size_t(strip.size.x) + std::size_t(s.x)];
    };
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
            const glm::ivec2 p(x, y), s = source(p);
            const std::uint8_t* from = &strip.frame[4 * (std::size_t(s.y) * std::size_t(strip.size.x) + std::size_t(s.x))];
            bool edge = false;
            for (const glm::ivec2 way : {glm::ivec2(2, 0), glm::ivec2(-2, 0), glm::ivec2(0, 2), glm::ivec2(0, -2)})
                edge = edge || (flashes(p) && !flashes(p + way));
            sheet.put(corner + p, edge ? marked : Ink{from[0], from[1], from[2]});
        }
}

} // namespace
} // namespace flash_sheet

void write_flash_sheet(const std::filesystem::path& file, const std::vector<FlashStrip>& strips)
{
    using namespace flash_sheet; // names as short as these would meet others
    int height = 16;
    for (const FlashStrip& strip : strips)
        height += height_of(strip);
    FlashPaper sheet({width, height});
    const Typesetter typesetter;
    int y = 8;
    for (const FlashStrip& strip : strips) {
        sheet.write(typesetter, strip.title, {chart_left, y + 22}, text_ink);
        draw_chart(sheet, typesetter, strip, {chart_left, y + title_height});
        draw_frame(sheet, strip, {picture_left, y + title_height}, height_of(strip) - title_height - foot_height);
        y += height_of(strip);
    }
    write_png(file, sheet.size, sheet.rgba);
}

} // namespace starbow
