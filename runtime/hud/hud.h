#pragma once
#include "caption.h"
#include "config/model/flying.h"
#include "config/model/information.h"
#include "config/model/scene_file.h"
#include "config/model/words.h"
#include "runtime/flight/flight.h"
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// A picture of text, two bytes a pixel: the letter's coverage and the plate's. Rows from the top.
struct Panel {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> texels;
};

/// An empty plate of `size` pixels with rounded corners and a soft edge. corner: their radius, pixels.
Panel plate(glm::ivec2 size, double corner);

/// Numbers for people: 3 or 4 figures, or a given number of decimals. Times in seconds have a given number of decimals.
/// Lengths are in metres or, at the real speed of light, in light's travel time.
std::string shown_number(double x, const Words& words);
std::string shown_number(double x, int decimals, const Words& words);
std::string shown_duration(double s, const Words& words, int decimals = 1);
std::string shown_length(double m, double light_speed_m_s, const Words& words);

/// The faintest letters that can be read on a plate before any picture.
constexpr double faintest_letters = 0.6;

/// Height of the panel over its width.
constexpr double panel_aspect = 0.2;

/// The head-up display's values.
struct Readings {
    double beta_deficit; ///< 1 - v/c, without cancellation
    double gamma, doppler_ahead; ///< D straight ahead of the nose
    double looked_cosine; ///< of the angle between the motion and the view, on board; 1 at rest
    double ship_s, world_s, distance_m; ///< world_s: on the displays for visitors and guides since the start
    double light_speed_m_s;
    double frames_per_s;
    Effects effects;
    FlightMode mode = FlightMode::guided;
    bool frozen = false; ///< the world stands still
    double exposure_ev = 0;
    bool exposure_locked = false; ///< the visitor has locked it
    bool filtered = false; ///< the picture, by a dark filter
    /// Stops of the view's luminance and of the shown one, where a curve shows everything at once.
    struct Range {
        double stops, shown;
    };
    std::optional<Range> range{};
    std::optional<double> lever{}; ///< the throttle's place, 0 to 1
    std::string prompt{}; ///< the tutorial's prompt, or empty
    /// A caption; it replaces the figures, but for the first of them where the visitor flies.
    std::optional<Caption> caption{};
    std::string notice{}; ///< one line for the exhibit's operator, or empty
    Information information = Information::laboratory;
};
/// The view is that of the nose.
Readings readings(const Ship& ship, const SceneFile& scene, const Effects& effects);
/// The same of a flight, whose view is that of the turned head.
Readings readings(const Flight& flight, const SceneFile& scene, const Comfort& comfort = {});
/// Chooses the display of information. On those for visitors and guides both clocks begin at 0; start_s: the world's time at
/// the flight's start.
void show_on(Information information, double start_s, Readings& readings);

/// The sentence that brightness is compressed, and by how much.
std::string range_sentence(const Readings::Range& range, const Words& words);

/// The name of the shown light, in a few words.
std::string light_name(const Effects& effects, const Words& words);

/// The lines as text, for the log and for tests: label and value in turn.
std::vector<std::pair<std::string, std::string>> hud_fields(const Readings& readings, const Words& words);

/// The font file of the head-up display.
inline constexpr const char* hud_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// The fault of a TrueType file whose tables are missing, cut off or differ from their sums, as a predicate, or "". The
/// library that reads fonts trusts every number in them.
std::string font_fault(std::string_view bytes);

/// The display's letters (DejaVu Sans), ready to draw.
class Typesetter {
public:
    /// Throws InputError if the font is not installed, or is damaged.
    explicit Typesetter(const std::filesystem::path& file = hud_font);
    ~Typesetter();
    Panel draw(const Readings& readings, const Words& words, int width) const;

    /// Draws a line (UTF-8) from x on its baseline (pixels), `size` pixels high, at `strength` of full white: at least
    /// `faintest_letters` on a plate.
    void write(Panel& panel, const std::string& line, double x, double baseline, int size, double strength) const;
    double width_of(const std::string& line, int size) const;

private:
    struct Font;
    std::unique_ptr<Font> font_;
};

} // namespace starbow
