#include "accuracy.h"
#include "config/json/csv.h"
#include "config/json/reader.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace starbow {
namespace {

std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string text(const char* format, ...)
{
    char buffer[1024];
    std::va_list list;
    va_start(list, format);
    std::vsnprintf(buffer, sizeof buffer, format, list);
    va_end(list);
    return buffer;
}

/// One error as charts and tables show it.
struct Metric {
    const char* name;
    const char* unit;
    double (*of)(const MeasuredSetting&);
    bool less_is_better;
};
constexpr double greatest_dB = 99; // stands for "nothing differs"
const Metric metrics[] = {
    {"FLIP", "mean", [](const MeasuredSetting& m) { return m.errors.flip; }, true},
    {"PSNR", "dB", [](const MeasuredSetting& m) { return std::min(m.errors.psnr_dB, greatest_dB); }, false},
    {"CIEDE2000", "95th percentile", [](const MeasuredSetting& m) { return m.errors.ciede2000_95; }, true},
    {"edges", "pixels, 95th percentile", [](const MeasuredSetting& m) { return m.errors.edges_95_px; }, true},
};

/// Round steps for an axis, some of them.
std::vector<double> even_steps(double low, double high)
{
    constexpr int most = 6;
    double step = std::pow(10, std::floor(std::log10((high - low) / most)));
    for (double factor : {1.0, 2.0, 5.0, 10.0})
        if ((high - low) / (step * factor) <= most) {
            step *= factor;
            break;
        }
    std::vector<double> all;
    for (double at = std::ceil(low / step) * step; at <= high + 1e-9 * step; at += step)
        all.push_back(at);
    return all;
}
std::vector<double> log_steps(double low, double high)
{
    std::vector<double> all;
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade < high; decade *= 10)
        for (double factor : {1.0, 2.0, 3.0, 5.0, 7.0})
            if (const double at = decade * factor; at >= low && at <= high)
                all.push_back(at);
    return all;
}

/// A chart's inside. Better is always below: errors on a logarithmic scale, or decibels upside down.
struct Chart {
    double left, top, width, height;
    double first_ms, last_ms, low, high;
    bool decibels;
    double x(double ms) const { return left + width * std::log(ms / first_ms) / std::log(last_ms / first_ms); }
    double y(double value) const
    {
        return top
            + height
            * (decibels ? (value - low) / (high - low) : std::log(high / std::max(value, low)) / std::log(high / low));
    }
};

void draw(Svg& svg, const std::vector<MeasuredSetting>& all, const std::vector<bool>& best, const Metric& metric,
    glm::dvec2 corner)
{
    double first = 1e300, last = 0, low = 1e300, high = -1e300;
    for (const MeasuredSetting& one : all) {
        first = std::min(first, one.ms), last = std::max(last, one.ms);
        low = std::min(low, metric.of(one)), high = std::max(high, metric.of(one));
    }
    const bool decibels = !metric.less_is_better;
    const double room = 0.08 * (high - low) + 1e-3;
    low = decibels ? low - room : std::max(low, 1e-4) / 1.15, high = decibels ? high + room : std::max(high, 2e-4) * 1.15;
    const Chart c{corner.x + 62, corner.y + 34, 400, 260, first / 1.12, last * 1.12, low, high, decibels};
    const double right = c.left + c.width, bottom = c.top + c.height;
    svg.text(corner + glm::dvec2(62, 18), metric.name, "class=\"head\"");
    svg.text({right, corner.y + 18}, metric.unit, "class=\"unit\" text-anchor=\"end\"");
    svg.rect({c.left, c.top}, {right, bottom}, "class=\"box\"");
    for (double at : decibels ? even_steps(low, high) : log_steps(low, high)) {
        svg.line({c.left, c.y(at)}, {right, c.y(at)}, "class=\"grid\"");
        svg.text({c.left - 6, c.y(at) + 4}, text("%.4g", at), "class=\"tick\" text-anchor=\"end\"");
    }
    for (double at : log_steps(c.first_ms, c.last_ms)) {
        svg.line({c.x(at), c.top}, {c.x(at), bottom}, "class=\"grid\"");
        svg.text({c.x(at), bottom + 16}, text("%.4g", at), "class=\"tick\" text-anchor=\"middle\"");
    }
    svg.text({c.left + c.width / 2, bottom + 32}, "milliseconds a frame", "class=\"tick\" text-anchor=\"middle\"");
    const auto place = [&](const MeasuredSetting& one) { return glm::dvec2(c.x(one.ms), c.y(metric.of(one))); };
    std::vector<glm::dvec2> line;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (best[i])
            line.push_back(place(all[i]));
    std::ranges::sort(line, {}, &glm::dvec2::x);
    svg.polyline(line, "class=\"frontier\"");
    for (std::size_t i = 0; i < all.size(); ++i) {
        const MeasuredSetting& one = all[i];
        const bool shipped = one.setting.shipped;
        svg.circle(place(one), shipped ? 6 : 4,
            shipped       ? "class=\"shipped\""
                : best[i] ? "class=\"best\""
                          : "class=\"other\"",
            one.setting.name + text(": %.1f ms, %.4g", one.ms, metric.of(one)));
    }
    double below = -7; // names alternate above and below their points, because neighbours would overlap
    for (const MeasuredSetting& one : all)
        if (one.setting.shipped)
            svg.text(place(one) + glm::dvec2(5, below = 8 - below), one.setting.name, "class=\"name\"");
}

} // namespace

std::vector<Setting> settings_to_try(
    const std::vector<Setting>& shipped, const Quality& standard, bool two_eyes, SpectralLevel needed)
{
    std::vector<Setting> all = shipped;
    const auto add = [&](const Quality& quality) {
        const auto same = [&](const Setting& one) { return one.quality == quality; };
        if (std::none_of(all.begin(), all.end(), same))
            all.push_back({differences(quality, standard), quality});
    };
    const auto with = [&](const auto& change) {
        Quality quality = standard;
        change(quality);
        add(quality);
    };
    // Each setting by itself.
    for (double density : {0.35, 0.5, 0.65, 1.0, 1.25, 1.6, 2.0})
        with([&](Quality& q) { q.texels_per_pixel = density, q.max_texels_per_pixel = 3 * density * density; });
    for (double most : {0.75, 1.0, 2.0, 4.0, 8.0})
        with([&](Quality& q) { q.max_texels_per_pixel = most; });
    for (int samples : {1, 2, 4, 8})
        with([&](Quality& q) { q.cube_samples = samples; });
    for (double texels : {0.0, 0.5, 1.0, 2.0, 4.0})
        with([&](Quality& q) { q.lod_error_texels = texels; });
    for (double texels : {2.0, 8.0, 16.0, 32.0, 64.0, 128.0})
        with([&](Quality& q) { q.lod_shading_texels = texels; });
    for (double texels : {2048.0, 8192.0, 32768.0, 131072.0, 1e12})
        with([&](Quality& q) { q.image_cost_texels = texels; });
    for (int rays : {1, 2, 3})
        with([&](Quality& q) { q.pixel_rays = rays; });
    for (int images : {0, 2})
        with([&](Quality& q) { q.clip_levels = images; });
    with([&](Quality& q) { q.mips = !q.mips; });
    with([&](Quality& q) { q.half_floats = !q.half_floats; });
    with([&](Quality& q) { q.matrices = !q.matrices; });
    for (int frames : {2, 4})
        with([&](Quality& q) { q.frames_per_cube = frames; });
    for (SpectralLevel level : {SpectralLevel::colours, SpectralLevel::middle, SpectralLevel::fine})
        if (level != needed)
            with([&](Quality& q) { q.spectra = level; });
    if (two_eyes)
        for (StereoMethod method : {StereoMethod::shared, StereoMethod::reprojected, StereoMethod::exact})
            with([&](Quality& q) { q.stereo = method; });
    // Combinations of the most effective settings.
    for (double density : {0.5, 0.8, 1.0, 1.25, 2.0})
        for (int samples : {1, 4})
            for (int rays : {1, 2})
                for (double texels : {standard.lod_shading_texels, 16.0})
                    if (density >= 1.25 || (samples == 1 && rays == 1))
                        with([&](Quality& q) {
                            q.texels_per_pixel = density, q.max_texels_per_pixel = 3 * density * density;
                            q.cube_samples = samples, q.pixel_rays = rays, q.lod_shading_texels = texels;
                        });
    return all;
}

std::vector<bool> frontier(const std::vector<MeasuredSetting>& all)
{
    std::vector<bool> best;
    for (const MeasuredSetting& one : all)
        best.push_back(std::none_of(all.begin(), all.end(), [&](const MeasuredSetting& other) {
            return other.ms <= one.ms && other.errors.flip <= one.errors.flip
                && (other.ms < one.ms || other.errors.flip < one.errors.flip);
        }));
    return best;
}

const MeasuredSetting* better_than(const MeasuredSetting& one, const std::vector<MeasuredSetting>& all, double part)
{
    for (const MeasuredSetting& other : all)
        if (other.ms < one.ms / (1 + part) && other.errors.flip < one.errors.flip / (1 + part))
            return &other;
    return nullptr;
}

const MeasuredSetting* best_within(const std::vector<MeasuredSetting>& all, double budget_ms)
{
    const MeasuredSetting* best = nullptr;
    for (const MeasuredSetting& one : all)
        if (one.ms <= budget_ms && (!best || one.errors.flip < best->errors.flip))
            best = &one;
    return best;
}

std::vector<PresetLevel> ladder_of(const std::vector<MeasuredSetting>& all)
{
    const std::vector<bool> best = frontier(all);
    std::vector<PresetLevel> ladder;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const MeasuredSetting& one = all[i];
        const Quality& own = one.setting.quality;
        const Quality& first = all[0].setting.quality;
        // Settings with other samples or formats need other memory, which takes longer than a frame. A delayed cube map
        // must be chosen by hand. A setting that leaves out parts may be worse elsewhere than in the measured shots.
        if (best[i] && own.spectra == first.spectra && own.stereo == first.stereo && own.matrices == first.matrices
            && own.cube_samples == first.cube_samples && own.half_floats == first.half_floats && own.frames_per_cube == 1
            && own.mips == first.mips && own.clip_levels == first.clip_levels)
            ladder.push_back({own, one.ms, one.errors.flip, one.errors.edges_95_px});
    }
    std::sort(ladder.begin(), ladder.end(), [](const PresetLevel& a, const PresetLevel& b) { return a.ms < b.ms; });
    // Steps of less than 8 % are dropped.
    std::vector<PresetLevel> steps;
    for (const PresetLevel& level : ladder)
        if (steps.empty() || level.ms > 1.08 * steps.back().ms)
            steps.push_back(level);
    return steps;
}

std::string accuracy_csv(const std::vector<MeasuredSetting>& all)
{
    const std::vector<bool> best = frontier(all);
    std::string out
        = "setting,texels_per_pixel,max_texels_per_pixel,cube_samples,lod_error_texels,lod_shading_texels,image_cost_texels,"
          "pixel_"
          "rays,clip_levels,"
          "mips,half_floats,"
          "matrices,frames_per_cube,ms,ratio,megabytes,texels_drawn_per_pixel,images,flip,psnr_dB,ciede2000_mean,"
          "ciede2000_95,edges_95_px,direction_99_px,doppler_99,frontier\n";
    for (std::size_t i = 0; i < all.size(); ++i) {
        const MeasuredSetting& m = all[i];
        const Quality& q = m.setting.quality;
        out += csv_cell(m.setting.name)
            + text(",%g,%g,%d,%g,%g,%g,%d,%d,%d,%d,%d,%d,%.4f,%.4f,%.2f,%.3f,%d,%.6f,%.3f,%.4f,%.4f,%.4f,%.6f,%.3g,%d\n",
                q.texels_per_pixel, q.max_texels_per_pixel, q.cube_samples, q.lod_error_texels, q.lod_shading_texels,
                q.image_cost_texels, q.pixel_rays, q.clip_levels, q.mips, q.half_floats, q.matrices, q.frames_per_cube, m.ms,
                m.ratio, m.megabytes, m.texels_per_pixel, m.images, m.errors.flip, m.errors.psnr_dB, m.errors.ciede2000_mean,
                m.errors.ciede2000_95, m.errors.edges_95_px, m.direction_px, m.doppler, int(best[i]));
    }
    return out;
}

std::string accuracy_chart(const std::vector<MeasuredSetting>& all, const std::string& title)
{
    const std::vector<bool> best = frontier(all);
    Svg svg;
    svg.raw("<style>.box{fill:none;stroke:#888}.grid{stroke:#ddd}.tick{font-size:12px;fill:#333}.head{font-size:16px;"
            "font-weight:bold}.unit{font-size:13px;font-weight:normal;fill:#555}.name{font-size:13px;font-weight:bold;"
            "fill:#a33c00;stroke:#fff;stroke-width:3;paint-order:stroke}"
            ".frontier{fill:none;stroke:#0072b2;stroke-width:2}.other{fill:#999;fill-opacity:.55}"
            ".best{fill:#0072b2}.shipped{fill:#d55e00;stroke:#fff;stroke-width:1.5}</style>");
    const glm::dvec2 size(1000, 760);
    svg.rect({0, 0}, size, "fill=\"#fff\"");
    svg.text({62, 30}, title, "class=\"head\"");
    svg.text({62, 50},
        "Lower is better, further left is faster. Orange: the shipped settings; blue: what no other setting beats in FLIP "
        "and time.",
        "class=\"unit\"");
    for (std::size_t i = 0; i < 4; ++i)
        draw(svg, all, best, metrics[i], {i % 2 == 0 ? 0 : 500, i < 2 ? 62 : 408});
    return svg.drawn(size, "font-family=\"sans-serif\"");
}

std::string accuracy_page(const std::vector<MeasuredSetting>& all, const MeasuredOn& on)
{
    const std::vector<bool> best = frontier(all);
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a].ms < all[b].ms; });
    std::string out
        = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Starbow: speed and "
          "accuracy</title>\n<style>body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}"
          "table{border-collapse:collapse;font-size:13px}td,th{padding:3px 9px;border-bottom:1px solid #ddd;"
          "text-align:right}td:first-child,th:first-child{text-align:left}tr.best td:first-child{color:#0072b2;"
          "font-weight:bold}tr.shipped td:first-child{color:#a33c00;font-weight:bold}svg{width:100%}</style>"
          "</head><body>\n<h1>Speed and accuracy</h1>\n";
    out += "<p>" + escaped_html(on.what) + ". " + escaped_html(on.machine)
        + text(". Frame times are medians of %d rounds, each in turn with the default setting. Errors are against the "
               "reference, "
               "%d rays a pixel, on the picture as it is shown.</p>\n",
            on.rounds, on.samples);
    out += accuracy_chart(all, on.what);
    out += "<table><tr><th>setting</th><th>ms</th><th>of the default</th><th>MiB</th><th>texels a pixel</th><th>images</th>"
           "<th>FLIP</th><th>PSNR, dB</th><th>CIEDE2000 mean</th><th>95 %</th><th>edges, px</th><th>direction, px</th>"
           "<th>D</th></tr>\n";
    for (std::size_t i : order) {
        const MeasuredSetting& m = all[i];
        out += text("<tr class=\"%s\"><td>",
                   m.setting.shipped ? "shipped"
                       : best[i]     ? "best"
                                     : "other")
            + escaped_html(m.setting.name)
            + text(
                "</td><td>%.1f</td><td>%.2f</td><td>%.0f</td><td>%.2f</td><td>%d</td><td>%.4f</td><td>%.1f</td><td>%.2f</td>"
                "<td>%.2f</td><td>%.3f</td><td>%.4f</td><td>%.1e</td></tr>\n",
                m.ms, m.ratio, m.megabytes, m.texels_per_pixel, m.images, m.errors.flip, m.errors.psnr_dB,
                m.errors.ciede2000_mean, m.errors.ciede2000_95, m.errors.edges_95_px, m.direction_px, m.doppler);
    }
    return out
        + "</table>\n<p>FLIP: 0 where nobody could tell the pictures apart, 1 at worst. Edges: how far an edge stands from "
          "where it should. Direction: how far a pixel looks from where it should, 99th percentile. D: the same for the "
          "Doppler factor, relative.</p>\n</body></html>\n";
}

} // namespace starbow
