#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace starbow {

// Flashes by WCAG 2.2, success criterion 2.3.1 and its definition of the general flash and red flash thresholds
// (https://www.w3.org/TR/WCAG22/#dfn-general-flash-and-red-flash-thresholds); the red flash in the form of WCAG 2.1.

/// A change of relative luminance counts from this part of the greatest one, 1, on, where its darker end is below the
/// second number.
constexpr double flash_luminance = 0.1, flash_dark = 0.8;
/// A colour is a saturated red from this part of red in the sum of its linear channels on. A change of a red counts beyond
/// the second number, of redness().
constexpr double saturated_red = 0.8, flash_redness = 20;
/// Flashes may fill so much of any field of this width, as an eye sees it.
constexpr double flash_area_sr = 0.006, flash_field_deg = 10;
/// Pairs of opposing changes in any period of one second.
constexpr int most_flashes = 3;

/// Relative luminance of linear Rec. 709 light, 0 to 1.
double relative_luminance(const glm::vec3& light);
/// (R - G - B) * 320 of linear light, and 0 where that is negative.
double redness(const glm::vec3& light);

/// A pixel as one eye sees it.
struct SeenPixel {
    glm::vec3 direction{0}; ///< unit
    float solid_angle_sr = 0;
    int output = 0; ///< counted from 0
};

enum class FlashKind { general, red };
constexpr std::size_t flash_kinds = 2;

/// The flashes in the second up to a frame: an area of more than flash_area_sr of some field of flash_field_deg saw at
/// least `changes` opposing changes, each of its pixels.
struct Flashes {
    int changes = 0; ///< two are a flash; fewer count as none
    double area_sr = 0; ///< the largest such area of a field; 0 without changes
    glm::vec3 field{0}; ///< the field's centre, unit
    std::int64_t time_ns = 0; ///< of the frame
    double flashes() const { return 0.5 * changes; }
    bool breaks_limit() const { return changes > 2 * most_flashes; }
    bool operator==(const Flashes&) const = default;
};

/// Counts the flashes that one eye sees, pixel by pixel, in pictures that come one after the other. A change runs from an
/// extreme of a pixel to the next one, over any number of frames, and counts at the first frame in which it is large enough.
/// Fields have their centres at pixels, at most 0.75 degrees apart: exact for areas that are compact, and down to nine
/// tenths for those that fill a field evenly.
class FlashCounter {
public:
    /// outputs: their number; each field belongs to the output of its centre, and reaches into the others.
    FlashCounter(std::vector<SeenPixel> pixels, int outputs);

    /// light: of the pixels in the constructor's order, linear Rec. 709, 0 to 1. Times grow from call to call.
    void take(std::int64_t time_ns, std::span<const glm::vec3> light);

    /// Of an output in the second up to the last frame.
    const Flashes& now(FlashKind kind, int output) const { return now_[std::size_t(kind)][std::size_t(output)]; }
    /// The most of an output so far: of equally many changes the first with the largest area.
    const Flashes& worst(FlashKind kind, int output) const { return worst_[std::size_t(kind)][std::size_t(output)]; }
    /// Changes of each pixel in the second up to the last frame.
    std::span<const std::uint16_t> changes(FlashKind kind) const { return counts_[std::size_t(kind)]; }
    std::span<const SeenPixel> pixels() const { return pixels_; }

private:
    /// A value's way from one extreme to the next.
    struct Leg {
        float from = 0, to = 0; ///< the extreme that it began at, and the farthest value since
        std::int8_t way = 0; ///< 1 rises, -1 falls, 0: neither so far; then `from` is the lowest and `to` the highest
        bool counted = false;
        /// A saturated red: on the leg; after `to`; at `to`. Where neither rises nor falls: since `from`; since `to`.
        bool red = false, red_since = false, red_end = false;
    };
    /// Takes a value and returns true where a change counts from now on.
    static bool advance(Leg& leg, float value, bool red, FlashKind kind);
    void find_fields(FlashKind kind, std::int64_t time_ns);

    struct Field {
        std::uint32_t first, end; ///< in near_
        int output;
        std::uint32_t centre; ///< a pixel
    };
    std::vector<SeenPixel> pixels_;
    std::vector<Field> fields_;
    std::vector<std::uint32_t> near_; ///< the pixels of each field
    std::array<std::vector<Leg>, flash_kinds> legs_;
    std::array<std::vector<std::uint16_t>, flash_kinds> counts_;
    /// The pixels whose changes began to count in each frame of the last second.
    struct Frame {
        std::int64_t time_ns;
        std::array<std::vector<std::uint32_t>, flash_kinds> changed;
    };
    std::deque<Frame> second_;
    bool begun_ = false;
    std::array<std::vector<Flashes>, flash_kinds> now_, worst_;
};

} // namespace starbow
