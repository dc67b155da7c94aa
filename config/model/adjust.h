#pragma once
#include "config/json/patch.h"
#include "layout.h"
#include <cstdint>
#include <span>

namespace starbow {

/// A number of a layout that a builder may change on site, in view of the picture.
struct Adjustable {
    std::string name; ///< for people: "dome, tilt"
    /// Its JSON pointers in the layout's file. Several where projectors share a dome and the number; they change
    /// together.
    struct Spot {
        std::string pointer;
        std::size_t output = 0, viewport = 0;
    };
    std::vector<Spot> spots;
    std::string what; ///< the number's own name: "tilt"; of a place's two numbers the place's
    std::string way; ///< of a place's two numbers: "to the right" or "down"; else empty
    std::optional<glm::dvec2> unmoved; ///< of such a place: where it is in a viewport that nobody has pulled
    double low = 0, high = 0; ///< by the file's format
    double step = 0.1; ///< of one key press: degrees, fractions of a viewport, or the power's own unit
};

/// All adjustable numbers of a layout. They are the tilt and the rotation of all domes that agree on them, then for each
/// viewport the turn of its dome or picture and the handles of its quad and its grid. The blend's power and the head-up
/// display's height follow.
std::vector<Adjustable> adjustables(const Layout& layout);

double value_of(const Layout& layout, const Adjustable& adjustable);

/// The layout with one number changed by `steps`, clamped to the file format's range.
Layout adjusted(Layout layout, const Adjustable& adjustable, double steps);

/// The grip of a builder's hand on a layout: one number, or a place with its two numbers.
struct Grip {
    std::string name; ///< for people: "dome, tilt", "left, upper left corner"
    std::vector<Adjustable> numbers; ///< of a place to the right, then down
};

/// All grips of a layout, in the order of its adjustable numbers.
std::vector<Grip> grips(const Layout& layout);

/// The layout with a grip moved by steps to the right and down. A number grows to the right and upwards.
Layout moved(Layout layout, const Grip& grip, double right, double down);

/// The differences of two layouts as changes of the first one's file. Members that the first lacks are left out.
std::vector<Change> changes(const Layout& saved, const Layout& now);

/// A number that a builder has turned: its place among the adjustables of the file's layout, and its value.
struct TurnedNumber {
    std::uint16_t place = 0;
    double value = 0;
    bool operator==(const TurnedNumber&) const = default;
};

/// The differences of a layout from its file's, for another machine that has the same file.
std::vector<TurnedNumber> turned_numbers(const Layout& kept, const Layout& now);

/// A file's layout with such differences. Throws InputError for a place or a value that the layout has not.
Layout with_turned(Layout kept, std::span<const TurnedNumber> numbers);

/// A newly read layout with the builder's changes since the last reading (from `kept` to `turned`). Numbers that the file
/// itself has changed keep the file's value.
Layout turned_again(Layout fresh, const Layout& kept, const Layout& turned);

} // namespace starbow
