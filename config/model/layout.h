#pragma once
#include "config/json/error.h"
#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace starbow {

// Directions and places are in the cockpit's frame, metres: the visitor looks along -z, +x is right, +y is up.

/// A turn away from straight ahead, in this order: yaw to the right, then pitch up, then roll. A roll leans the picture's
/// upper edge to the right as the viewer sees it.
struct Turn {
    double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

/// The edges of a picture as angles from its axis. To the right and up are positive, so left and down are negative in a
/// picture that holds its axis.
struct Sides {
    double left_deg, right_deg, down_deg, up_deg;
};

/// A flat window. Without `sides` the eye is on its axis, and the horizontal angle follows from the pixels' aspect.
struct Planar {
    double fov_y_deg = 60;
    std::optional<Sides> sides;
    Turn turn;
};

/// A flat wall or screen in the room; the eye sees the world through it, from any place (Kooima 2008). The corners are those
/// of the picture as somebody measured them; displays/projections/wall.h fits a rectangle or a plane to them.
struct Wall {
    glm::dvec3 lower_left_m{0}, lower_right_m{0}, upper_left_m{0};
    std::optional<glm::dvec3> upper_right_m{}; ///< of a picture that is no rectangle; none: a rectangle
};

enum class FisheyeMapping { equidistant, equisolid, stereographic, orthographic };

/// A domemaster: a circle whose centre is the zenith. The zenith is the cockpit's up tilted forward: tilt_deg 0 looks
/// straight up, 90 straight ahead. The bottom of the picture is towards the visitor's front.
struct Fisheye {
    double aperture_deg = 180; ///< across the circle
    double tilt_deg = 0;
    double rotation_deg = 0; ///< turns the picture counterclockwise about the circle's centre
    FisheyeMapping mapping = FisheyeMapping::equidistant;
    glm::dvec2 centre{0.5, 0.5}; ///< of the circle, in fractions of the picture from its top left
    double diameter = 1; ///< of the circle, in the picture's shorter side; more than 1 is cropped by the picture's edges
};

/// A cylinder about the upright axis: columns are evenly spaced in azimuth, rows in height on the cylinder's wall.
struct Cylinder {
    Sides sides{-180, 180, -45, 45};
    Turn turn;
};

/// Columns evenly spaced in azimuth, rows in elevation.
struct Equirectangular {
    Sides sides{-180, 180, -90, 90};
    Turn turn;
};

/// The six faces of a cube in one picture. row: 6 x 1: +x -x +y -y +z -z as cube map files have them, seen from inside.
/// Their axes are left-handed, and +z is straight ahead: right, left, up, down, front, back.
/// displays/projections/cube_faces.h has the edges. cross: 4 x 3, up above and down below the front, the middle row left,
/// front, right, back.
struct CubeFaces {
    enum class Arrangement { row, cross } arrangement = Arrangement::row;
    Turn turn;
};

/// A projector that lights a dome by way of a spherical mirror, as the eye at the viewport's eye_m sees the dome.
struct SphericalMirror {
    glm::dvec3 projector_m{0}; ///< its lens
    Planar projector; ///< the angles of the projector's picture, from its lens
    glm::dvec3 mirror_m{0}; ///< the sphere's centre
    double mirror_radius_m = 0.3;
    glm::dvec3 dome_m{0}; ///< the dome's centre
    double dome_radius_m = 3;
    double dome_tilt_deg = 0; ///< as a fisheye's
    double dome_aperture_deg = 180; ///< light that lands beyond it is not shown
};

/// A headset's lens: each colour of each pixel has a direction of its own. Let p be the place in the picture from `centre`,
/// in halves of its height, y up, and r = |p|. The lens shows the point p f(r) of a flat picture of fov_y_deg.
struct Lens {
    enum class Form {
        panotools, ///< f = k0 r^3 + k1 r^2 + k2 r + k3
        vive ///< f = 1 / (1 + k0 r^2 + k1 r^4 + k2 r^6) + k3
    } form
        = Form::vive;
    struct Colour {
        glm::dvec2 centre{0.5, 0.5}; ///< in fractions of the picture from its top left
        std::array<double, 4> k{0, 0, 0, 0};
    };
    std::array<Colour, 3> colours; ///< red, green, blue
    double fov_y_deg = 90;
    Turn turn;
};

using Projection = std::variant<Planar, Wall, Fisheye, Cylinder, Equirectangular, CubeFaces, SphericalMirror, Lens>;

/// A text in which every number of a projection stands: the key of what is computed from it.
std::string projection_key(const Projection& projection);

/// The form of a PFM's values, which no PFM declares. The defaults are those of the format's standard and of MPCDI's.
struct FloatMapForm {
    bool first_row_on_top = false;
    bool v_up = false; ///< places count from the picture's lower edge
    bool edge_to_edge = false; ///< the outer samples lie on the viewport's edges, not half a cell inside
    bool offsets = false; ///< not places: a regular grid's points move by these, right and up, in fractions of the viewport
    bool operator==(const FloatMapForm&) const = default;
};

/// A calibration's file that warps the viewport's projection, or has a projection of its own.
struct Warp {
    std::filesystem::path file;
    std::filesystem::path frustum; ///< domeprojection's second file; empty: NAME_frustum.csv beside NAME_mesh.csv if there
    std::string region; ///< of an MPCDI file with several
    FloatMapForm map; ///< of a PFM, also in an MPCDI file
    std::optional<double> aspect; ///< of a Bourke mesh: the x of the viewport's right edge; empty: the file's own
};

// A picture that is pulled into shape on site, over the viewport's projection and warp. Places are fractions of the viewport
// from its top left.

/// The places of the picture's corners: a corner pin.
struct Quad {
    glm::dvec2 upper_left{0, 0}, upper_right{1, 0}, lower_right{1, 1}, lower_left{0, 1};
};

/// A net of handles over the picture, whose outer ones are its edges: displays/compile/bend.h has the surface through them.
struct HandleGrid {
    static constexpr int least = 3, most = 17; ///< handles across or down
    int columns = 5, rows = 5;
    std::vector<double> right, down; ///< by how far each handle is moved, in fractions; rows from the top
};

/// The observer whose sky a viewport shows. All observers are at the ship's event.
struct ViewportObserver {
    bool at_rest = false; ///< in the world, the head turned as in the ship
    glm::dvec3 passing_u{0}; ///< otherwise it passes the ship with this proper velocity, cockpit's axes
    bool operator==(const ViewportObserver&) const = default;
};

enum class Eye { middle, left, right };
struct Viewport {
    glm::dvec4 rect{0, 0, 1, 1}; ///< x, y, width, height as fractions of the output, from its top left
    Projection projection;
    bool projection_given = true; ///< false: the projection is the warp file's own, if it has one
    std::optional<Warp> warp;
    std::optional<Quad> quad; ///< over the grid
    std::optional<HandleGrid> grid; ///< over projection and warp
    std::filesystem::path alpha_mask; ///< picture over the viewport that multiplies its light, or empty
    std::filesystem::path black_level; ///< picture over the viewport that is added to its light, or empty
    double mask_gamma = 1; ///< of both pictures' values: light = value^gamma
    Eye eye = Eye::middle;
    glm::dvec3 eye_m{0}; ///< the head's place; the left and right eye are half the separation beside it
    ViewportObserver observer;
    int order = 0; ///< covers viewports of a lower order; those of the same order add their masked light
};

/// A text in which every number of a viewport's quad and grid stands; empty without them.
std::string bend_key(const Viewport& viewport);

/// The packing of two eyes in an output. The half forms squeeze each eye's picture. In rows and columns the first is the
/// left eye's, in the checkerboard the top left pixel.
enum class Packing {
    mono,
    side_by_side,
    side_by_side_half,
    top_and_bottom,
    top_and_bottom_half,
    rows,
    columns,
    checkerboard,
    anaglyph_red_cyan,
    anaglyph_dubois,
    anaglyph_amber_blue
};

/// The map from linear light to a screen's or projector's input.
struct Colour {
    glm::dmat3 matrix{1}; ///< on linear Rec. 709 light
    double gamma = 0; ///< input = light^(1 / gamma); 0: sRGB's curve
    std::vector<glm::dvec3> lut; ///< instead: inputs for evenly spaced linear light from 0 to 1; empty: none
};

/// The names of an output's monitor. Every given member must fit.
struct MonitorName {
    std::string connector; ///< the system's name of it: "HDMI-1"
    std::string model, serial; ///< from its EDID
    std::optional<glm::ivec2> position; ///< of its top left corner on the desktop, pixels
    bool empty() const { return connector.empty() && model.empty() && serial.empty() && !position; }
};

struct Output {
    std::string name;
    std::string node; ///< the machine that shows it; empty: the one that shows the exhibit
    glm::ivec2 size{800, 600}; ///< pixels
    bool resizable = false;
    std::vector<Viewport> viewports; ///< none in a preview, where every other output is shown small
    bool preview = false; ///< the operator's window
    Packing packing = Packing::mono;
    Colour colour;
    MonitorName monitor;
    bool whole_monitor = false; ///< a borderless window over all of it
    std::optional<glm::ivec2> place; ///< of the window's top left corner from the monitor's, pixels
};

enum class StereoMethod { shared, exact, reprojected };

struct Stereo {
    StereoMethod method = StereoMethod::exact;
    double separation_m = 0.065; ///< between the eyes
    double hyper_stereo = 1; ///< multiplies every distance of an eye in the world
    bool by_light = false; ///< instead of hyper_stereo: a metre of an eye's place is metre_of_light_s of the world's light
    bool turning = false; ///< the eyes' baseline turns with the azimuth: for domes
    double full_from_zenith_deg = 40; ///< turning: closer to the zenith the separation fades

    /// The scene units that a metre of an eye's place is in a world of this unit and this speed of light.
    double units_per_m(double unit_m, double light_speed_m_s) const
    {
        return (by_light ? metre_of_light_s * light_speed_m_s : hyper_stereo) / unit_m;
    }
    /// Seconds. Eyes 65 mm apart are 9,750 km apart in a world of light-seconds, and 16 cm where light flies 5 m/s.
    static constexpr double metre_of_light_s = 0.5;
};

/// Blend ramps where outputs overlap, computed from their views.
struct Blend {
    bool ramps = false;
    double power = 1; ///< of the ramps before they are made to add up to 1; more is steeper in the middle
};

/// The head-up display's place in the cockpit: its centre's direction and its angular width.
struct HudPlacement {
    double azimuth_deg = 0; ///< to the right of straight ahead
    double elevation_deg = 0; ///< above straight ahead
    double width_deg = 40;
};

/// The port that receives a tracked head over UDP.
struct HeadTracking {
    int port = 4242;
    std::string address = "127.0.0.1"; ///< of this computer, on which it listens
    glm::dvec3 room_m{2, 1, 2}; ///< how far the head may be from the layout's place, to each side along x, y and z
    bool operator==(const HeadTracking&) const = default;
};

/// A layout: the exhibit's outputs and displays.
struct Layout {
    std::string name;
    std::filesystem::path file;
    Stereo stereo;
    Blend blend;
    std::optional<HudPlacement> hud; ///< none: found from the views, by placed_hud in runtime/hud/hud_place.h
    std::optional<HeadTracking> head_tracker;
    bool surrounds = false; ///< the visitor, as a dome does: tours come nearer
    std::vector<Output> outputs;
};

/// True for an output that the machine `node` shows; empty: it shows all.
inline bool is_shown_by(const std::string& node, const Output& output) { return node.empty() || output.node == node; }

/// The machines of a layout's outputs, in their order; none where one machine shows all.
std::vector<std::string> nodes_of(const Layout& layout);

/// True if some pictures of a layout are those of a left or a right eye.
bool has_two_eyes(const Layout& layout);

/// The pixels of a viewport in an output of `size`: x, y, width, height. Its edges are rounded, so that neighbours meet.
glm::ivec4 pixel_rect(const Viewport& viewport, glm::ivec2 size);

/// True if the rectangles of two viewports of one output share more than a rounding error.
bool overlap(const Viewport& a, const Viewport& b);

/// The end of a message about viewport `upper`, which overlaps viewport `lower` though nothing says how they combine.
std::string unordered_overlap(std::size_t lower);

/// Reads and checks a layout. Throws InputError with file, line, JSON pointer, value and what would be right. Its paths
/// start at the layout's folder.
Layout load_layout(const std::filesystem::path& file);

/// The place for messages about a layout in use: "FILE:LINE: POINTER" of its present file. The line is left out where the
/// file no longer has the pointer.
std::string place_in(const Layout& layout, const std::string& pointer);
std::string viewport_pointer(std::size_t output, std::size_t viewport);

/// Returns work(); puts the layout's place in front of its InputError.
template <class Work> auto on_behalf_of(const Layout& layout, const std::string& pointer, Work&& work)
{
    try {
        return work();
    } catch (const InputError& error) {
        throw InputError(place_in(layout, pointer), "", error.what());
    }
}

} // namespace starbow
