#include "lab_scales.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// The strips' place on their panel, as parts of its width and height.
constexpr double strip_left = 0.04, strip_right = 0.96, strip_top = 0.30, strip_bottom = 0.62;

LabScale scale_of(double low, double high, double step)
{
    LabScale scale{low, high, {}};
    for (long k = std::lround(std::ceil(low / step - 1e-6)); double(k) * step <= high * (1 + 1e-9); ++k)
        scale.ticks.push_back({double(k) * step, k % 10 == 0 ? 2 : k % 5 == 0 ? 1 : 0});
    return scale;
}

/// A strip with what is read, between its ends.
struct Strip {
    Panel panel;
    double left, right, top, bottom;

    explicit Strip(glm::ivec2 size)
        : panel(plate(size, 0.12 * size.y))
        , left(strip_left * size.x)
        , right(strip_right * size.x)
        , top(strip_top * size.y)
        , bottom(strip_bottom * size.y)
    {
    }
    double x_of(const LabScale& scale, double value) const { return left + (right - left) * scale.across(value); }
    /// Fills rows with the strengths of their columns: strength_at(part of the way from left to right).
    template <class Strength> void fill(double from_y, double to_y, const Strength& strength_at)
    {
        for (int x = int(left); x < int(right); ++x) {
            const double strength = strength_at((x + 0.5 - left) / (right - left));
            for (int y = int(from_y); y < int(to_y); ++y)
                panel.texels[2 * (std::size_t(y) * std::size_t(panel.size.x) + std::size_t(x))]
                    = std::uint8_t(std::lround(255 * std::clamp(strength, 0.0, 1.0)));
        }
    }
    void tick(double x, double from_y, double to_y)
    {
        for (int y = int(from_y); y < int(to_y); ++y)
            for (int side = 0; side < 2; ++side) { // one pixel wide, at parts of a pixel
                const double covered = side ? x - 0.5 - std::floor(x - 0.5) : 1 - (x - 0.5 - std::floor(x - 0.5));
                const int column = int(std::floor(x - 0.5)) + side;
                std::uint8_t& texel = panel.texels[2 * (std::size_t(y) * std::size_t(panel.size.x) + std::size_t(column))];
                texel = std::max(texel, std::uint8_t(std::lround(230 * covered)));
            }
    }
};

void write_scale_below(const Typesetter& typesetter, const Words& words, Strip& strip, const LabScale& scale)
{
    const double height = strip.panel.size.y;
    const int letters = std::max(6, int(0.15 * height));
    constexpr double lengths[] = {0.05, 0.09, 0.12};
    for (const LabScale::Tick& tick : scale.ticks) {
        const double x = strip.x_of(scale, tick.at);
        strip.tick(x, strip.bottom + 1, strip.bottom + 1 + lengths[tick.rank] * height);
        if (tick.rank < 2)
            continue;
        std::array<char, 32> number;
        std::snprintf(number.data(), number.size(), "%.4g", tick.at);
        const std::string text = words.number(number.data());
        const double half = 0.5 * typesetter.width_of(text, letters);
        typesetter.write(strip.panel, text,
            std::clamp(x - half, 0.02 * strip.panel.size.x, 0.98 * strip.panel.size.x - 2 * half), 0.92 * height, letters,
            1);
    }
}

void write_sentence(const Typesetter& typesetter, Panel& panel, const std::string& sentence)
{
    int letters = std::max(6, int(0.16 * panel.size.y));
    while (letters > 6 && typesetter.width_of(sentence, letters) > (strip_right - strip_left) * panel.size.x)
        --letters;
    typesetter.write(panel, sentence, strip_left * panel.size.x, 0.21 * panel.size.y, letters, 0.9);
}

} // namespace

double LabScale::across(double value) const { return std::log(value / low) / std::log(high / low); }

LabScale spectroscope_scale(double nm)
{
    // 400, 800, 1600 ... or 200, 100 ... is the greatest that is not above nm; the range has a tenth more on each side.
    const double base = 400 * std::exp2(std::floor(std::log2(nm / 400)));
    const double power = std::pow(10, std::floor(std::log10(base / 25)));
    const double least = base / 25 / power;
    return scale_of(base / 1.1, base * 2.2, (least < 2 ? 1 : least < 5 ? 2 : 5) * power);
}

LabScale photometer_scale(double light)
{
    const double base = std::pow(10, std::floor(std::log10(light)));
    LabScale scale{base / 1.25, base * 12.5, {}};
    // Numbers at 1, 2, 5 and 10 times the power, and ticks that stay apart.
    for (long tenths = 8; tenths <= 125; tenths += tenths < 20 ? 1 : tenths < 50 ? 2 : 5) {
        const bool numbered = tenths == 10 || tenths == 20 || tenths == 50 || tenths == 100;
        scale.ticks.push_back({0.1 * base * double(tenths), numbered ? 2 : tenths % 10 == 0 ? 1 : 0});
    }
    return scale;
}

Panel draw_spectroscope(const Typesetter& typesetter, const Words& words, double nm, glm::ivec2 size)
{
    Strip strip(size);
    const LabScale scale = spectroscope_scale(nm);
    const double at = scale.across(nm), wide = slit_part / std::log(scale.high / scale.low);
    constexpr double dark = 0.008;
    strip.fill(strip.top, strip.bottom, [&](double part) {
        const double off = (part - at) / wide;
        return dark + (1 - dark) * std::exp(-0.5 * off * off);
    });
    write_scale_below(typesetter, words, strip, scale);
    write_sentence(typesetter, strip.panel, words("lab.spectrum"));
    return std::move(strip.panel);
}

Panel draw_photometer(const Typesetter& typesetter, const Words& words, double light, glm::ivec2 size)
{
    Strip strip(size);
    if (!(light > 0)) {
        write_sentence(typesetter, strip.panel, words("lab.photometer_dark"));
        return std::move(strip.panel);
    }
    const LabScale scale = photometer_scale(light);
    // To the eye the wedge's greys grow evenly with the logarithm of the light; the panel's strengths are of light.
    constexpr double faintest = 0.2, display_gamma = 2.2;
    const auto grey
        = [&](double part) { return std::pow(faintest + (1 - faintest) * std::clamp(part, 0.0, 1.0), display_gamma); };
    const double middle = 0.5 * (strip.top + strip.bottom), step = std::log(10) / photometer_steps;
    strip.fill(strip.top, middle, [&](double) { return grey(scale.across(light)); });
    strip.fill(middle, strip.bottom, [&](double part) {
        const double steps = part * std::log(scale.high / scale.low) / step;
        return grey((std::floor(steps) + 0.5) * step / std::log(scale.high / scale.low));
    });
    write_scale_below(typesetter, words, strip, scale);
    write_sentence(typesetter, strip.panel, words("lab.photometer"));
    return std::move(strip.panel);
}

Panel draw_lines(const Typesetter& typesetter, const std::vector<std::string>& lines, glm::ivec2 size)
{
    Panel panel = plate(size, 0.024 * size.x);
    const double margin = 0.035 * size.x;
    int letters = std::max(6, int(std::min(0.045 * size.x, (size.y - 2 * margin) / (1.35 * double(lines.size())))));
    const auto too_wide = [&](const std::string& line) { return typesetter.width_of(line, letters) > size.x - 2 * margin; };
    while (letters > 6 && std::ranges::any_of(lines, too_wide))
        --letters;
    double baseline = margin + letters;
    for (const std::string& line : lines) {
        typesetter.write(panel, line, margin, baseline, letters, 0.95);
        baseline += 1.35 * letters;
    }
    return panel;
}

} // namespace starbow
