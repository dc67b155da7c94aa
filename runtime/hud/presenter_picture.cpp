#include "presenter_picture.h"
#include "caption.h"
#include "hud.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {
namespace {

using Tint = std::array<std::uint8_t, 3>; ///< red, green, blue

// Dark, for a room in which others look at a dark picture.
constexpr Tint ground{12, 13, 18}, plate_colour{26, 29, 38}, button_colour{40, 45, 60}, on_colour{124, 78, 8},
    now_colour{30, 62, 110}, unusable_colour{24, 26, 33}, refused_colour{112, 28, 28}, key_colour{70, 78, 102};

/// The size of the design, to which every other one is scaled.
constexpr glm::dvec2 design(1280, 800);

double unit_of(glm::ivec2 size) { return std::min(size.x / design.x, size.y / design.y); }

class Canvas {
public:
    Canvas(const Typesetter& typesetter, PresenterPicture& out, bool blue_first)
        : typesetter_(typesetter)
        , out_(out)
        , blue_first_(blue_first)
    {
        letters_.size = out.size;
        letters_.texels.assign(std::size_t(out.size.x) * std::size_t(out.size.y) * 2, 0);
        fill({{0, 0}, out.size}, ground);
    }
    void fill(const PresenterBox& box, Tint colour)
    {
        if (blue_first_)
            std::swap(colour[0], colour[2]);
        const glm::ivec2 from = glm::max(box.corner, 0), to = glm::min(box.corner + box.size, out_.size);
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) {
                std::uint8_t* texel = &out_.texels[4 * (std::size_t(y) * std::size_t(out_.size.x) + std::size_t(x))];
                texel[0] = colour[0], texel[1] = colour[1], texel[2] = colour[2], texel[3] = 255;
            }
    }
    double width_of(const std::string& line, int size) const { return typesetter_.width_of(line, size); }
    /// A line that is shrunk where it is wider than its room. Returns its width.
    double line(const std::string& text, double x, double baseline, int size, double room, double strength = 1)
    {
        int fits = size;
        while (fits > 7 && width_of(text, fits) > room)
            --fits;
        if (!text.empty())
            out_.tightest = std::min(out_.tightest, fits / double(size));
        typesetter_.write(letters_, text, x, baseline, fits, strength);
        return width_of(text, fits);
    }
    /// A line whose end is left out where it is wider than its room.
    void cut_line(std::string text, double x, double baseline, int size, double room, double strength)
    {
        if (width_of(text, size) > room) {
            while (!text.empty() && width_of(text + "…", size) > room) {
                while (text.size() > 1 && (text.back() & 0xc0) == 0x80)
                    text.pop_back();
                text.pop_back();
            }
            text += "…";
        }
        typesetter_.write(letters_, text, x, baseline, size, strength);
    }
    /// A picture as large as it fits into the box, in its own shape. A pixel is the mean of those that it stands for.
    void picture(const PresenterBox& box, const SmallPicture& view)
    {
        const auto [corner, size] = shown_box(box, view.size);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::ivec2 from = glm::ivec2(x, y) * view.size / size,
                                 to = glm::max(glm::ivec2(x + 1, y + 1) * view.size / size, from + 1);
                glm::ivec3 sum(0);
                for (int row = from.y; row < to.y; ++row)
                    for (int column = from.x; column < to.x; ++column) {
                        const std::uint8_t* pixel = &view.rgb[3 * std::size_t(row * view.size.x + column)];
                        sum += glm::ivec3(pixel[0], pixel[1], pixel[2]);
                    }
                sum /= (to.x - from.x) * (to.y - from.y);
                fill({corner + glm::ivec2(x, y), {1, 1}}, {std::uint8_t(sum.r), std::uint8_t(sum.g), std::uint8_t(sum.b)});
            }
    }
    /// Lays the letters over all that is filled. Call it once, at the end.
    void finish()
    {
        for (std::size_t i = 0; i < out_.texels.size() / 4; ++i)
            if (const int letter = letters_.texels[2 * i]; letter > 0)
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    std::uint8_t& value = out_.texels[4 * i + channel];
                    value = std::uint8_t(value + (244 - value) * letter / 255);
                }
    }

private:
    const Typesetter& typesetter_;
    PresenterPicture& out_;
    Panel letters_;
    bool blue_first_;
};

void paint_button(Canvas& canvas, const PresenterKey& key, const PresenterBox& box, double unit, bool two_lines)
{
    canvas.fill(box, key.on ? on_colour : key.usable ? button_colour : unusable_colour);
    const double strength = key.usable ? 1 : 0.5, pad = 8 * unit;
    // Two lines of letters, with their descents, have 44 units; in a lower button they are smaller.
    const double fits = two_lines && !key.state.empty() ? std::min(1.0, box.size.y / (44 * unit)) : 1;
    const int large = int(22 * unit), label = int(18 * fits * unit), small = int(15 * fits * unit);
    const double name_width = std::max(canvas.width_of(key.name, large), 14 * unit) + 2 * pad;
    canvas.fill({box.corner, {int(name_width), box.size.y}}, key_colour);
    const double middle = box.corner.y + 0.5 * box.size.y, x = box.corner.x + name_width + pad,
                 room = box.size.x - name_width - 1.5 * pad;
    canvas.line(key.name, box.corner.x + 0.5 * (name_width - canvas.width_of(key.name, large)), middle + 0.35 * large, large,
        name_width, strength);
    if (key.state.empty()) {
        canvas.line(key.label, x, middle + 0.35 * label, label, room, strength);
    } else if (two_lines) {
        canvas.line(key.label, x, middle - 0.1 * label, label, room, strength);
        canvas.line(key.state, x, middle + 1.1 * small, small, room, strength * 0.85);
    } else {
        const double state = canvas.width_of(key.state, small);
        canvas.line(key.label, x, middle + 0.35 * label, label, room - state - pad, strength);
        canvas.line(key.state, x + room - state, middle + 0.35 * label, small, state + 1, strength * 0.85);
    }
}

/// A button with the small picture of its choice, where there is one, at its right.
void paint_choice(Canvas& canvas, const PresenterKey& key, PresenterBox box, double unit, const Thumbnails& thumbnails)
{
    const auto found = thumbnails.find(thumbnail_of(key));
    if (found != thumbnails.end() && found->second.size.y > 0) {
        const int width = box.size.y * found->second.size.x / found->second.size.y;
        canvas.picture({box.corner + glm::ivec2(box.size.x - width, 0), {width, box.size.y}}, found->second);
        box.size.x -= width;
    }
    paint_button(canvas, key, box, unit, false);
}

void paint_facts(Canvas& canvas, const PresenterSheet& sheet, const PresenterBox& box, double unit)
{
    const int size = int(19 * unit), small = int(15 * unit);
    const double step = std::min(27 * unit, double(box.size.y) / std::max<std::size_t>(1, sheet.facts.size()));
    const double column = 0.3 * box.size.x;
    double y = box.corner.y + 0.75 * step;
    for (const auto& [label, value] : sheet.facts) {
        canvas.line(label, box.corner.x, y, small, column - 8 * unit, 0.7);
        canvas.cut_line(value, box.corner.x + column, y, size, box.size.x - column, 1);
        y += step;
    }
}

/// The present step and the next one are shown whole; the others are a line each, from the one before the present on.
void paint_cues(Canvas& canvas, const PresenterSheet& sheet, const PresenterBox& box, double unit)
{
    canvas.fill(box, plate_colour);
    const double pad = 10 * unit, left = box.corner.x + pad;
    const int title = int(20 * unit), large = int(20 * unit), small = int(16 * unit);
    double y = box.corner.y + 1.5 * title;
    canvas.line(sheet.cue_title, left, y, title, box.size.x - 2 * pad);
    y += 0.6 * title;
    const double end = box.corner.y + box.size.y, number_width = 34 * unit, seconds_width = 52 * unit;
    const std::size_t first = sheet.step > 0 ? sheet.step - 1 : 0;
    for (std::size_t i = first; i < sheet.cues.size(); ++i) {
        const bool now = i == sheet.step, whole = now || i == sheet.step + 1;
        const int size = now ? large : small;
        const double strength = now ? 1
            : i < sheet.step        ? 0.5
            : whole                 ? 0.9
                                    : 0.7,
                     room = box.size.x - 2 * pad - number_width - seconds_width;
        std::vector<std::string> lines{sheet.cues[i].text};
        if (whole)
            lines = wrapped(sheet.cues[i].text, room, [&](const std::string& line) { return canvas.width_of(line, size); });
        const double height = (1.3 * double(lines.size()) + 0.5) * size;
        if (y + height > end)
            break;
        if (now)
            canvas.fill({{box.corner.x, int(y)}, {box.size.x, int(height)}}, now_colour);
        double baseline = y + 1.2 * size;
        canvas.line(std::to_string(i + 1), left, baseline, size, number_width, strength);
        canvas.line(std::to_string(int(std::lround(sheet.cues[i].seconds))) + " s",
            box.corner.x + box.size.x - seconds_width, baseline, small, seconds_width - pad / 2, 0.7);
        for (const std::string& line : lines) {
            canvas.cut_line(line, left + number_width, baseline, size, room, strength);
            baseline += 1.3 * size;
        }
        y += height;
    }
}

/// The present item's title and time, as many lines of its notes as there is room for, and the next item.
void paint_programme(Canvas& canvas, const PresenterSheet& sheet, const PresenterBox& box, double unit)
{
    if (sheet.item_title.empty())
        return;
    canvas.fill(box, plate_colour);
    const double pad = 10 * unit, left = box.corner.x + pad, room = box.size.x - 2 * pad, end = box.corner.y + box.size.y;
    const int title = int(20 * unit), notes = int(17 * unit), small = int(16 * unit);
    double y = box.corner.y + 1.4 * title;
    canvas.line(sheet.item_title, left, y, title, room);
    canvas.cut_line(sheet.item_then, left, end - 0.6 * small, small, room, 0.8);
    y += 0.3 * notes;
    for (const std::string& line :
        wrapped(sheet.item_notes, room, [&](const std::string& text) { return canvas.width_of(text, notes); })) {
        y += 1.3 * notes;
        if (y > end - 1.8 * small)
            break;
        canvas.cut_line(line, left, y, notes, room, 0.95);
    }
}

void paint_said(Canvas& canvas, const PresenterSheet& sheet, const PresenterBox& box, double unit)
{
    const int size = int(19 * unit), small = int(15 * unit);
    const double pad = 10 * unit, baseline = box.corner.y + 0.5 * box.size.y + 0.35 * size;
    canvas.fill(box, sheet.typed ? now_colour : sheet.refused ? refused_colour : plate_colour);
    if (!sheet.typed) {
        canvas.cut_line(sheet.said, box.corner.x + pad, baseline, size, box.size.x - 2 * pad, 1);
        return;
    }
    const double help = canvas.width_of(sheet.typed_help, small), room = box.size.x - 3 * pad - help;
    canvas.line(sheet.typed_help, box.corner.x + box.size.x - pad - help, baseline, small, help + 1, 0.85);
    std::string shown = *sheet.typed + "▏"; // the end of a long text is what is being typed
    while (canvas.width_of(shown, size) > room && shown.size() > 4) {
        shown.erase(0, 1);
        while ((shown.front() & 0xc0) == 0x80)
            shown.erase(0, 1);
    }
    canvas.cut_line(shown, box.corner.x + pad, baseline, size, room, 1);
}

} // namespace

PresenterPlaces places_of(const PresenterSheet& sheet, glm::ivec2 size)
{
    const double unit = unit_of(size), gap = 10 * unit, width = size.x, height = size.y;
    const auto box = [](double x, double y, double w, double h) {
        return PresenterBox{{int(x), int(y)}, {std::max(0, int(w)), std::max(0, int(h))}};
    };
    constexpr int columns = 5;
    const std::size_t count = sheet.keys.size(), rest = count % columns;
    const double keys_top = 0.62 * height, upper = 0.55 * height, // the end of what stands above the line about commands
        left = 0.31 * width, list = 0.27 * width;
    PresenterPlaces places;
    places.picture = box(gap, gap, left - 1.5 * gap, 0.34 * height - gap);
    places.facts = box(gap, 0.35 * height, left - 1.5 * gap, upper - 0.35 * height);
    const double programme = sheet.item_title.empty() ? 0 : 0.19 * height;
    places.programme = box(left, gap, programme > 0 ? width - left - list - gap : 0, programme);
    const double cues_top = gap + (programme > 0 ? programme + gap : 0);
    places.cues = box(left, cues_top, width - left - list - gap, upper - cues_top);
    places.list = box(width - list, gap, list - gap, upper - gap);
    places.said = box(gap, upper + gap, width - 2 * gap, keys_top - upper - 2 * gap);
    const double title = 34 * unit, choice = (places.list.size.y - title) / double(most_choices + 1);
    for (std::size_t i = 0; i < sheet.choices.size(); ++i)
        places.choices.push_back(box(places.list.corner.x, places.list.corner.y + title + double(i) * choice,
            places.list.size.x, choice - 0.4 * gap));
    const double row = (height - keys_top) / std::max<double>(1, std::ceil(double(count) / columns));
    for (std::size_t i = 0; i < count; ++i) {
        const bool last = i >= count - rest; // the last row's are wider
        const double in_row = last ? double(rest) : columns, column = (width - gap) / in_row,
                     at = double(last ? i - (count - rest) : i % columns);
        places.keys.push_back(box(gap + at * column, keys_top + double(i / columns) * row, column - gap, row - 0.7 * gap));
    }
    return places;
}

PresenterBox shown_box(const PresenterBox& place, glm::ivec2 picture)
{
    if (picture.x <= 0 || picture.y <= 0)
        return {};
    const double scale = std::min(double(place.size.x) / picture.x, double(place.size.y) / picture.y);
    const glm::ivec2 size = glm::max(glm::ivec2(glm::dvec2(picture) * scale), 1);
    return {place.corner + (place.size - size) / 2, size};
}

int key_at(const PresenterSheet& sheet, glm::ivec2 size, glm::ivec2 at)
{
    const PresenterPlaces places = places_of(sheet, size);
    for (std::size_t i = 0; i < places.choices.size(); ++i)
        if (places.choices[i].holds(at))
            return sheet.choices[i].key;
    for (std::size_t i = 0; i < places.keys.size(); ++i)
        if (places.keys[i].holds(at))
            return sheet.keys[i].key;
    return 0;
}

void paint(const PresenterSheet& sheet, const SmallPicture& view, const Thumbnails& thumbnails, const Typesetter& typesetter,
    glm::ivec2 size, bool blue_first, PresenterPicture& out)
{
    out.size = size;
    out.tightest = 1;
    out.texels.resize(std::size_t(size.x) * std::size_t(size.y) * 4);
    const double unit = unit_of(size);
    const PresenterPlaces places = places_of(sheet, size);
    Canvas canvas(typesetter, out, blue_first);
    canvas.fill(places.picture, plate_colour);
    if (view.size.x > 0)
        canvas.picture(places.picture, view);
    paint_facts(canvas, sheet, places.facts, unit);
    paint_programme(canvas, sheet, places.programme, unit);
    paint_cues(canvas, sheet, places.cues, unit);
    canvas.fill(places.list, plate_colour);
    const int title = int(20 * unit);
    canvas.line(sheet.list_title, places.list.corner.x + 10 * unit, places.list.corner.y + 1.2 * title, title,
        places.list.size.x - 20 * unit);
    for (std::size_t i = 0; i < sheet.choices.size(); ++i)
        paint_choice(canvas, sheet.choices[i], places.choices[i], unit, thumbnails);
    paint_said(canvas, sheet, places.said, unit);
    for (std::size_t i = 0; i < sheet.keys.size(); ++i)
        paint_button(canvas, sheet.keys[i], places.keys[i], unit, true);
    canvas.finish();
}

} // namespace starbow
