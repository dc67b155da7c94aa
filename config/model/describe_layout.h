#pragma once
#include "config/json/describe.h"
#include "layout_reader.h"

namespace starbow {

// Layout files, as config/json/describe.h says.

/// Limits of a flat picture's angles: the tangent stays below 600.
constexpr Range flat_fov{0.1, 179};
constexpr Range whole_turn{-360, 360};
/// Far beyond any building, and its square is far from overflow.
constexpr Range room_m{-1e4, 1e4};
constexpr const char* place_in_cockpit = "A place in the cockpit, [x, y, z] in metres: +x right, +y up, -z ahead.";
/// Windows may begin left of and above the main monitor.
constexpr int farthest_px = 100000;
constexpr int most_pixels_across = 16384;
static_assert(most_pixels_across <= (1 << 28) / most_pixels_across, "an output's pixels are counted in an int");

/// A path, from the layout's folder, of a file that is there.
struct ExistingFile : Text {
    std::filesystem::path read(const Place& place, const Folder& folder) const { return existing_file(place, folder.path); }
};

template <>
inline constexpr auto description<Turn> = describe<Turn>("turn_deg",
    "The turn away from straight ahead, degrees: first yaw, then pitch, then roll.",
    field("yaw", Number{whole_turn, 0.1, "yaw"}, "To the right, degrees.", &Turn::yaw_deg),
    field("pitch", Number{whole_turn, 0.1, "pitch"}, "Up, degrees.", &Turn::pitch_deg),
    field("roll", Number{whole_turn, 0.1, "roll"},
        "Leans the picture's upper edge to the right as the viewer sees it, degrees.", &Turn::roll_deg));
static_assert(is_complete<Turn>());

inline void add_to_key(std::string& text, const Sides& sides)
{
    for (const double angle : {sides.left_deg, sides.right_deg, sides.down_deg, sides.up_deg})
        described::add_number(text, angle);
}
/// The edges of a picture as angles, within limits.
struct SidesWithin {
    Range across, upright;
    Sides usual; ///< without the member; all 0: other members say them
    const char* says[4]; ///< of left, right, down, up
    Sides read(const Place& place, const Folder&) const;
    Json schema(Json& definitions) const;
};
/// The angle across a flat picture, for its sides.
struct FovAcross {
    void read_into(const Place& place, Planar& planar, const Folder&) const;
    Json schema(Json& definitions) const { return Number{flat_fov}.schema(definitions); }
};
template <>
inline constexpr auto description<Planar> = with_rules(
    describe<Planar>("planar", "A flat window, seen from its axis unless sides_deg says otherwise.",
        field("fov_y_deg", Number{flat_fov}, "The angle from the picture's lower to its upper edge, degrees.",
            &Planar::fov_y_deg),
        again("fov_x_deg", FovAcross{},
            "The angle from the picture's left to its right edge, degrees, beside fov_y_deg; left out, it follows from "
            "square "
            "pixels.",
            &Planar::sides),
        field("sides_deg",
            SidesWithin{{-89.9, 89.9}, {-89.9, 89.9}, {},
                {"The angle of the left edge, degrees; below 0 left of the axis.",
                    "The angle of the right edge, degrees; above 0 right of the axis.",
                    "The angle of the lower edge, degrees; below 0 below the axis.",
                    "The angle of the upper edge, degrees; above 0 above the axis."}},
            "Instead of the fields of view: the edges of a picture that is not viewed from its middle, degrees from its "
            "axis.",
            &Planar::sides),
        field("turn_deg", Object<Turn>{}, "", &Planar::turn)),
    R"({ "dependencies": { "fov_x_deg": ["fov_y_deg"], "sides_deg": { "not": { "required": ["fov_y_deg"] } } },
        "examples": [{ "type": "planar", "fov_y_deg": 60 }] })");
static_assert(is_complete<Planar>());
void check_members(const Place& place, const Planar*);

/// The four corners of a picture that is no rectangle.
struct FourCorners {
    void read_into(const Place& place, Wall& wall, const Folder&) const;
    Json schema(Json& definitions) const;
};
template <>
inline constexpr auto description<Wall> = with_rules(
    describe<Wall>("wall",
        "A flat screen that stands in the room, by three corners of its picture as the visitor sees it. The nearest "
        "rectangle is shown; they may miss it as a tape does, by 20 mm per metre.",
        field("lower_left_m", Numbers<3>{room_m}, place_in_cockpit, &Wall::lower_left_m),
        field("lower_right_m", Numbers<3>{room_m}, place_in_cockpit, &Wall::lower_right_m),
        field("upper_left_m", Numbers<3>{room_m}, place_in_cockpit, &Wall::upper_left_m),
        field("corners_m", FourCorners{},
            "Instead of the three, metres: all corners of a picture that is no rectangle, because its projector stands "
            "askew. Lower left, lower right, upper right, upper left, in one plane within 20 mm per metre.",
            &Wall::upper_right_m)),
    R"({ "oneOf": [{ "required": ["lower_left_m", "lower_right_m", "upper_left_m"], "not": { "required": ["corners_m"] } },
        { "required": ["corners_m"], "not": { "anyOf": [{ "required": ["lower_left_m"] }, { "required": ["lower_right_m"] },
          { "required": ["upper_left_m"] }] } }],
        "examples": [{ "type": "wall", "lower_left_m": [-1.2, -0.675, -2], "lower_right_m": [1.2, -0.675, -2],
        "upper_left_m": [-1.2, 0.675, -2] }] })");
static_assert(is_complete<Wall>());
void check_members(const Place& place, const Wall*);
void check(const Place& place, const Wall& wall, const Folder&);

inline const std::vector<std::pair<std::string_view, FisheyeMapping>> fisheye_mappings{
    {"equidistant", FisheyeMapping::equidistant}, {"equisolid", FisheyeMapping::equisolid},
    {"stereographic", FisheyeMapping::stereographic}, {"orthographic", FisheyeMapping::orthographic}};
template <>
inline constexpr auto description<Fisheye> = with_rules(
    describe<Fisheye>("fisheye",
        "A domemaster: a circle whose centre is the dome's zenith, the front at the bottom, the right hand on the right.",
        field("aperture_deg", Number{{1, 360}},
            "The angle across the whole circle, degrees: 180 is a half sphere. At most 180 with the mapping orthographic "
            "and 350 "
            "with stereographic.",
            &Fisheye::aperture_deg),
        field("tilt_deg", Number{{-180, 180}, 0.1, "tilt"},
            "The dome's tilt forward, degrees: 0 is a level planetarium, 90 has the circle's centre straight ahead.",
            &Fisheye::tilt_deg),
        field("rotation_deg", Number{whole_turn, 0.1, "rotation"},
            "Turns the picture counterclockwise about the circle's centre, degrees.", &Fisheye::rotation_deg),
        field("mapping", Named{&fisheye_mappings},
            "The function from the angle at the zenith to the distance from the circle's centre. It belongs to the "
            "projector's "
            "lens; domemasters are equidistant.",
            &Fisheye::mapping),
        field("centre", Numbers<2>{{-10, 10}}, "The circle's centre, in fractions of the picture from its top left.",
            &Fisheye::centre),
        field("diameter", Number{{0.01, 100}},
            "The circle's diameter, in the picture's shorter side; more than 1 is cropped by the picture's edges.",
            &Fisheye::diameter)),
    R"({ "allOf": [
        { "if": { "properties": { "mapping": { "const": "orthographic" } }, "required": ["mapping"] },
          "then": { "properties": { "aperture_deg": { "maximum": 180 } } } },
        { "if": { "properties": { "mapping": { "const": "stereographic" } }, "required": ["mapping"] },
          "then": { "properties": { "aperture_deg": { "maximum": 350 } } } }],
        "examples": [{ "type": "fisheye", "aperture_deg": 180, "tilt_deg": 30 }] })");
static_assert(is_complete<Fisheye>());
void check(const Place& place, const Fisheye& fisheye, const Folder&);

constexpr const char* panorama_sides
    = "The picture's edges, degrees: azimuth to the right of straight ahead, elevation above it. "
      "At most a whole turn across.";
constexpr SidesWithin sides_of_panorama(double least_elevation, double most_elevation, const Sides& usual)
{
    return {whole_turn, {least_elevation, most_elevation}, usual,
        {"Azimuth of the left edge, degrees.", "Azimuth of the right edge, degrees.",
            "Elevation of the lower edge, degrees.", "Elevation of the upper edge, degrees."}};
}
template <>
inline constexpr auto description<Cylinder> = describe<Cylinder>("cylinder",
    "A cylinder about the upright axis: columns evenly spaced in azimuth, rows in height on its wall.",
    field("sides_deg", sides_of_panorama(-89, 89, Cylinder{}.sides), panorama_sides, &Cylinder::sides),
    field("turn_deg", Object<Turn>{}, "", &Cylinder::turn));
static_assert(is_complete<Cylinder>());

template <>
inline constexpr auto description<Equirectangular> = describe<Equirectangular>("equirectangular",
    "A panorama: columns evenly spaced in azimuth, rows in elevation.",
    field("sides_deg", sides_of_panorama(-90, 90, Equirectangular{}.sides), panorama_sides, &Equirectangular::sides),
    field("turn_deg", Object<Turn>{}, "", &Equirectangular::turn));
static_assert(is_complete<Equirectangular>());

inline const std::vector<std::pair<std::string_view, CubeFaces::Arrangement>> cube_arrangements{
    {"row", CubeFaces::Arrangement::row}, {"cross", CubeFaces::Arrangement::cross}};
template <>
inline constexpr auto description<CubeFaces> = describe<CubeFaces>("cube", "The six faces of a cube in one picture.",
    field("arrangement", Named{&cube_arrangements},
        "row: 6 x 1, +x -x +y -y +z -z as cube map files have them, seen from inside. cross: 4 x 3, up above and down below "
        "the "
        "front; the middle row left, front, right, back.",
        &CubeFaces::arrangement),
    field("turn_deg", Object<Turn>{}, "", &CubeFaces::turn));
static_assert(is_complete<CubeFaces>());

template <>
inline constexpr auto description<SphericalMirror> = describe<SphericalMirror>("mirror",
    "A projector that lights a dome through a spherical mirror, with the dome seen by the eye at eye_m.",
    needed("projector_m", Numbers<3>{room_m}, place_in_cockpit, &SphericalMirror::projector_m),
    needed("projector", Varied<Planar>{}, "The angles of the projector's picture at its lens, before the mirror.",
        &SphericalMirror::projector),
    needed("mirror_m", Numbers<3>{room_m}, place_in_cockpit, &SphericalMirror::mirror_m),
    needed("mirror_radius_m", Number{{0.001, 1000}}, "The radius of the mirror's sphere, metres.",
        &SphericalMirror::mirror_radius_m),
    field("dome_m", Numbers<3>{room_m}, place_in_cockpit, &SphericalMirror::dome_m),
    needed("dome_radius_m", Number{{0.01, 1e4}}, "The dome's radius, metres.", &SphericalMirror::dome_radius_m),
    field("dome_tilt_deg", Number{{-180, 180}, 0.1, "tilt"}, "The dome's tilt forward, degrees, as a fisheye's tilt_deg.",
        &SphericalMirror::dome_tilt_deg),
    field("dome_aperture_deg", Number{{1, 360}},
        "The angle across the whole dome, degrees; light beyond its rim is not shown.",
        &SphericalMirror::dome_aperture_deg));
static_assert(is_complete<SphericalMirror>());
void check(const Place& place, const SphericalMirror& mirror, const Folder&);

/// The numbers of a lens's form.
struct LensNumbers {
    std::array<double, 4> read(const Place& place, const Folder&) const;
    Json schema(Json& definitions) const { return Numbers<4>{{-1e3, 1e3}}.schema(definitions); }
};
template <>
inline constexpr auto description<Lens::Colour> = describe<Lens::Colour>("lens_colour",
    "The lens's distortion of one colour. Red and blue equal green if left out.",
    field("centre", Numbers<2>{{-1, 2}}, "The lens's centre, in fractions of the picture from its top left.",
        &Lens::Colour::centre),
    needed("k", LensNumbers{}, "The form's numbers k0, k1, k2, k3. No unit.", &Lens::Colour::k));
static_assert(is_complete<Lens::Colour>());

/// The distortion of one colour of a lens; of green: of all, until the others say theirs.
struct LensColour {
    int which; ///< 0 red, 1 green, 2 blue
    void read_into(const Place& place, Lens& lens, const Folder& folder) const;
    Json schema(Json& definitions) const { return Object<Lens::Colour>{}.schema(definitions); }
};
inline const std::vector<std::pair<std::string_view, Lens::Form>> lens_forms{
    {"panotools", Lens::Form::panotools}, {"vive", Lens::Form::vive}};
template <>
inline constexpr auto description<Lens> = describe<Lens>("lens",
    "A headset's lens: each colour of each pixel has a direction of its own.",
    field("form", Named{&lens_forms},
        "With r the distance from centre in halves of the picture's height, the lens shows at p the point p f(r) of a flat "
        "picture. panotools: f = k0 r^3 + k1 r^2 + k2 r + k3. vive: f = 1 / (1 + k0 r^2 + k1 r^4 + k2 r^6) + k3. f stays "
        "between 0.001 and 1000 out to r = 1.",
        &Lens::form),
    field("fov_y_deg", Number{flat_fov},
        "The angle of the flat picture behind the lens, from its lower to its upper edge, degrees.", &Lens::fov_y_deg),
    field("turn_deg", Object<Turn>{}, "", &Lens::turn), needed("green", LensColour{1}, "", &Lens::colours),
    again("red", LensColour{0}, "", &Lens::colours), again("blue", LensColour{2}, "", &Lens::colours));
static_assert(is_complete<Lens>());
void check(const Place& place, const Lens& lens, const Folder&);

inline const std::vector<std::pair<std::string_view, bool>> first_rows{{"top", true}, {"bottom", false}},
    v_directions{{"down", false}, {"up", true}}, sample_places{{"centres", false}, {"edges", true}},
    map_values{{"places", false}, {"offsets", true}};
template <>
inline constexpr auto description<Warp> = describe<Warp>("warp",
    "A calibration's file that warps the projection, or has one of its own. Under a warp a fisheye's picture is a square.",
    needed("file", ExistingFile{}, "Its path, from this layout's folder.", &Warp::file),
    field("frustum", ExistingFile{},
        "The path of domeprojection's second file; left out, NAME_frustum.csv beside NAME_mesh.csv.", &Warp::frustum),
    field("region", Text{}, "The region of an MPCDI file with several.", &Warp::region),
    field("first_row", Within{Named{&first_rows}, &Warp::map, &FloatMapForm::first_row_on_top},
        "The first row of a PFM file. By the standard it is the bottom row; some tools write the top row first.",
        &Warp::map),
    again("v", Within{Named{&v_directions}, &Warp::map, &FloatMapForm::v_up},
        "The direction in which a PFM's places count: down from the picture's upper edge, or up from its lower edge.",
        &Warp::map),
    again("samples", Within{Named{&sample_places}, &Warp::map, &FloatMapForm::edge_to_edge},
        "Where a PFM's samples lie: at the centres of equal cells, or from edge to edge of the viewport.", &Warp::map),
    again("values", Within{Named{&map_values}, &Warp::map, &FloatMapForm::offsets},
        "What a PFM's values are: places in the picture, or the offsets of a regular grid's points, to the right and up.",
        &Warp::map),
    field("aspect", Number{{0.01, 100}},
        "The x of the viewport's right edge in a Bourke mesh, whose x counts in heights of the viewport's half. Left out, "
        "it is "
        "in the file's last line, or the largest x of the mesh. No unit.",
        &Warp::aspect));
static_assert(is_complete<Warp>());
void check(const Place& place, const Warp& warp, const Folder&);

/// A place that the alignment keys move, [x, y].
struct Handle : Numbers<2> {
    glm::dvec2 Quad::*member;
    const char* name; ///< for people
    void add_turnables(std::vector<described::Turnable>& all, const std::string& at, Quad& quad) const;
};
/// By how far the handles of a grid are moved along one axis.
struct Offsets {
    static constexpr bool tells_nothing_usual = true; // as many zeros as there are handles
    Range range;
    std::vector<double> HandleGrid::*member;
    const char* way; ///< for people
    std::vector<double> read(const Place& place, const Folder&) const;
    Json schema(Json& definitions) const;
    void add_turnables(std::vector<described::Turnable>& all, const std::string& at, HandleGrid& grid) const;
};
/// Handles may be pulled beyond the viewport, where nothing is seen of the picture.
constexpr Range handle_places{-1, 2};
/// One key press: half a pixel of a picture 2,000 pixels wide.
constexpr double handle_step = 0.00025;
template <>
inline constexpr auto description<Quad> = describe<Quad>("quad",
    "The places of the picture's corners, [x, y] in fractions of the viewport from its top left; what is left out stays in "
    "its corner.",
    field("upper_left", Handle{{handle_places}, &Quad::upper_left, "upper left corner"},
        "The place of the picture's upper left corner.", &Quad::upper_left),
    field("upper_right", Handle{{handle_places}, &Quad::upper_right, "upper right corner"},
        "The place of its upper right corner.", &Quad::upper_right),
    field("lower_right", Handle{{handle_places}, &Quad::lower_right, "lower right corner"},
        "The place of its lower right corner.", &Quad::lower_right),
    field("lower_left", Handle{{handle_places}, &Quad::lower_left, "lower left corner"},
        "The place of its lower left corner.", &Quad::lower_left));
static_assert(is_complete<Quad>());

template <>
inline constexpr auto description<HandleGrid> = describe<HandleGrid>("grid",
    "Handles in rows and columns over the picture, the outer ones on its edges. A smooth surface goes through them.",
    field("columns", Whole{HandleGrid::least, HandleGrid::most}, "The handles from left to right.", &HandleGrid::columns),
    field("rows", Whole{HandleGrid::least, HandleGrid::most}, "The handles from top to bottom.", &HandleGrid::rows),
    field("right", Offsets{{-1, 1}, &HandleGrid::right, "to the right"},
        "By how far each handle is moved to the right, in fractions of the viewport's width; row by row from the top. Left "
        "out, none is.",
        &HandleGrid::right),
    field("down", Offsets{{-1, 1}, &HandleGrid::down, "down"}, "The same downwards, in fractions of the viewport's height.",
        &HandleGrid::down));
static_assert(is_complete<HandleGrid>());
void check(const Place& place, HandleGrid& grid, const Folder&);

struct ObserverForm {
    ViewportObserver read(const Place& place, const Folder&) const;
    Json written(const ViewportObserver&) const { return "ship"; } // the usual one; layouts are not written
    Json schema(Json&) const;
};
inline const std::vector<std::pair<std::string_view, Eye>> eye_names{
    {"middle", Eye::middle}, {"left", Eye::left}, {"right", Eye::right}};
template <>
inline constexpr auto description<Viewport> = with_rules(
    describe<Viewport>("viewport", "A rectangle of an output with one projection and one eye.",
        field("rect", Numbers<4>{{0, 1}},
            "x, y, width and height as fractions of the output (with a packing, of an eye's picture), from its top left.",
            &Viewport::rect),
        field("eye", Named{&eye_names},
            "The eye of its picture. Not in an output with a packing, which shows both eyes' pictures.", &Viewport::eye),
        field("eye_m", Numbers<3>{{-1e3, 1e3}}, "The place of the visitor's head in the cockpit, [x, y, z] in metres.",
            &Viewport::eye_m),
        field("projection", Tagged<Projection>{},
            "The projection of the rectangle. It may be left out if a warp file has one.", &Viewport::projection),
        field("warp", Object<Warp>{}, "", &Viewport::warp), field("quad", Object<Quad>{}, "", &Viewport::quad),
        field("grid", Object<HandleGrid>{}, "", &Viewport::grid),
        field("alpha_mask", ExistingFile{},
            "The path, from this layout's folder, of a PNG picture over the viewport that multiplies its light. Where "
            "viewports "
            "overlap it is the viewport's share.",
            &Viewport::alpha_mask),
        field("black_level", ExistingFile{},
            "The path, from this layout's folder, of a PNG picture over the viewport that is added to its light, so that "
            "places "
            "lit by one projector get the black of those lit by two.",
            &Viewport::black_level),
        field("mask_gamma", Number{{0.1, 10}}, "The gamma of both pictures' values: light = value^mask_gamma. No unit.",
            &Viewport::mask_gamma),
        field("order", Whole{-1000, 1000},
            "Its place among viewports that overlap. One of a higher order hides those of a lower one where it shows "
            "something, "
            "with an alpha_mask by that share. Viewports of one order add their light; each of them needs a mask. No unit.",
            &Viewport::order),
        field("observer", ObserverForm{},
            "The observer whose sky it shows, at the ship's place and time: the visitor, an observer at rest in the world, "
            "or one "
            "who passes the ship with a velocity in cockpit axes (right, up, back).",
            &Viewport::observer),
        not_in_file(&Viewport::projection_given)),
    R"({ "anyOf": [{ "required": ["projection"] }, { "required": ["warp"] }] })");
static_assert(is_complete<Viewport>());
void check(const Place& place, Viewport& viewport, const Folder&);

/// Rows of a matrix.
struct Matrix {
    glm::dmat3 read(const Place& place, const Folder&) const;
    Json written(const glm::dmat3& matrix) const;
    Json schema(Json& definitions) const;
};
/// Inputs in a list, or in a .cube file.
struct Table {
    std::vector<glm::dvec3> read(const Place& place, const Folder& folder) const;
    Json schema(Json&) const;
};
template <>
inline constexpr auto description<Colour> = with_rules(
    describe<Colour>("colour",
        "The map from linear light to this screen's or projector's input; left out, it is an sRGB screen.",
        field("gamma", Number{{0.1, 10}}, "Input = light^(1 / gamma); left out, sRGB's curve. Not beside lut. No unit.",
            &Colour::gamma),
        field("matrix", Matrix{},
            "Three rows that turn linear Rec. 709 light into this screen's own red, green and blue. No unit.",
            &Colour::matrix),
        field("lut", Table{},
            "Inputs, 0 to 1, for evenly spaced linear light from 0 to 1, never falling: numbers, or [red, green, blue], or "
            "the "
            "path of a one-dimensional .cube file from this layout's folder. Not beside gamma.",
            &Colour::lut)),
    R"({ "not": { "required": ["gamma", "lut"] } })");
static_assert(is_complete<Colour>());
void check_members(const Place& place, const Colour*);

template <>
inline constexpr auto description<MonitorName> = with_rules(
    describe<MonitorName>("monitor", "The monitor or projector of the window; every given member must fit.",
        field("connector", Text{}, "The system's name of the connector; xrandr lists them.", &MonitorName::connector),
        field("model", Text{}, "The monitor's own name (in its EDID).", &MonitorName::model),
        field("serial", Text{}, "The monitor's own serial number (in its EDID).", &MonitorName::serial),
        field("position", WholePair{-farthest_px, farthest_px},
            "The place of the monitor's top left corner on the desktop, pixels.", &MonitorName::position)),
    R"({ "minProperties": 1 })");
static_assert(is_complete<MonitorName>());
void check(const Place& place, const MonitorName& monitor, const Folder&);

/// A name that can be part of a file's name.
struct FileNamePart {
    std::string read(const Place& place, const Folder&) const;
    Json schema(Json&) const { return {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]{1,64}$"}}; }
};
inline const std::vector<std::pair<std::string_view, Packing>> packings{{"mono", Packing::mono},
    {"side-by-side", Packing::side_by_side}, {"side-by-side-half", Packing::side_by_side_half},
    {"top-and-bottom", Packing::top_and_bottom}, {"top-and-bottom-half", Packing::top_and_bottom_half},
    {"rows", Packing::rows}, {"columns", Packing::columns}, {"checkerboard", Packing::checkerboard},
    {"anaglyph-red-cyan", Packing::anaglyph_red_cyan}, {"anaglyph-dubois", Packing::anaglyph_dubois},
    {"anaglyph-amber-blue", Packing::anaglyph_amber_blue}};
template <>
inline constexpr auto description<Output> = with_rules(
    describe<Output>("output", "A window on one monitor or projector.",
        needed("name", FileNamePart{},
            "The output's name, also of its picture's file, so every output has a name of its own: letters A-Z a-z, digits, "
            "_ and "
            "-.",
            &Output::name),
        field("node", FileNamePart{},
            "The machine that shows this output, where several machines show one exhibit: each is started with starbow run "
            "--node "
            "and this name. All outputs of a layout have a node, or none.",
            &Output::node),
        field("size", WholePair{1, most_pixels_across},
            "Width and height in pixels; of both eyes' pictures together where a packing puts them side by side.",
            &Output::size),
        field("resizable", Flag{}, "true: the window's edges can be dragged.", &Output::resizable),
        field("preview", Flag{},
            "true: the operator's window, which shows every other output small. At most one output is a preview.",
            &Output::preview),
        field("packing", Named{&packings},
            "The packing of both eyes in this output; mono: it shows one eye. The half forms squeeze each eye's picture "
            "into half "
            "the screen, as 3D television sets need it. rows, columns: the eyes alternate, and the first is the left eye's; "
            "checkerboard: the top left pixel is the left eye's. The anaglyphs are for coloured glasses.",
            &Output::packing),
        field("colour", Object<Colour>{}, "", &Output::colour),
        field("monitor", Object<MonitorName>{}, "", &Output::monitor),
        field("whole_monitor", Flag{}, "true: a window without a border over the whole monitor.", &Output::whole_monitor),
        field("place", WholePair{-farthest_px, farthest_px},
            "The place of the window's top left corner, from its monitor's, pixels to the right and down.", &Output::place),
        field("viewports", List{Object<Viewport>{}, 1, 64, "viewports"},
            "The parts of the output; one that covers it, most often. Not in a preview.", &Output::viewports)),
    R"({ "if": { "properties": { "preview": { "const": true } }, "required": ["preview"] },
        "then": { "not": { "anyOf": [{ "required": ["viewports"] }, { "required": ["packing"] }] } },
        "else": { "required": ["viewports"] },
        "not": { "properties": { "whole_monitor": { "const": true } }, "required": ["whole_monitor", "place"] } })");
static_assert(is_complete<Output>());
void check_members(const Place& place, const Output*);
void check(const Place& place, const Output& output, const Folder&);

/// A factor, or "by-light".
struct HyperStereo {
    void read_into(const Place& place, Stereo& stereo, const Folder&) const;
    Json written(double factor) const { return factor; }
    Json schema(Json& definitions) const;
};
inline const std::vector<std::pair<std::string_view, StereoMethod>> stereo_methods{
    {"shared", StereoMethod::shared}, {"exact", StereoMethod::exact}, {"reprojected", StereoMethod::reprojected}};
inline const std::vector<std::pair<std::string_view, bool>> baselines{{"fixed", false}, {"turning", true}};
template <>
inline constexpr auto description<Stereo> = with_rules(
    describe<Stereo>("stereo",
        "The method for two eyes' pictures, for every output with a packing and every viewport with an eye.",
        field("method", Named{&stereo_methods},
            "shared: one world picture for both eyes; only walls and mirrors differ, for worlds at infinity. exact: a world "
            "picture for each eye, twice the work. reprojected: both eyes' pictures are made from one world picture with "
            "its "
            "depth, with small faults at edges: for worlds of very many triangles, and the only method for a turning "
            "baseline.",
            &Stereo::method),
        field("separation_m", Number{{0, 10}},
            "The distance of a visitor's eyes, metres: 0.065 for grown visitors, 0.05 for small children. Not 0, except "
            "with the "
            "method shared.",
            &Stereo::separation_m),
        field("hyper_stereo", HyperStereo{},
            "Multiplies every distance of an eye in the world (not before a wall): in a world measured in light-seconds "
            "eyes 65 "
            "mm apart see no depth. No unit. by-light: by the world's own speed of light; a metre is the distance that its "
            "light "
            "travels in half a second, so that eyes 65 mm apart are 9,750 km apart among light-seconds, and 16 cm apart "
            "where "
            "light flies 5 m/s.",
            &Stereo::hyper_stereo, &Stereo::by_light),
        field("baseline", Named{&baselines},
            "fixed: the line between the eyes points along the cockpit's x. turning: it turns with the azimuth of the view, "
            "for "
            "domes whose visitors look all around; it needs the method reprojected.",
            &Stereo::turning),
        field("full_from_zenith_deg", Number{{0, 90}},
            "For a turning baseline: closer to the zenith than this the eyes' separation fades to nothing. Degrees from the "
            "zenith.",
            &Stereo::full_from_zenith_deg)),
    R"({ "if": { "properties": { "baseline": { "const": "turning" } }, "required": ["baseline"] },
        "then": { "properties": { "method": { "const": "reprojected" } }, "required": ["method"] } })");
static_assert(is_complete<Stereo>());
void check(const Place& place, const Stereo& stereo, const Folder&);

template <>
inline constexpr auto description<Blend> = describe<Blend>("blend", "Blend ramps for outputs that overlap on a screen.",
    field("ramps", Flag{},
        "true: ramps are computed where viewports that share no pixels show the same direction. Leave it out where masks of "
        "a "
        "calibration do the same.",
        &Blend::ramps),
    field("power", Number{{0.1, 10}, 0.05, "power"},
        "The power of the ramps before they are scaled to add up to 1: more than 1 is steeper in the middle. No unit.",
        &Blend::power));
static_assert(is_complete<Blend>());

template <>
inline constexpr auto description<HudPlacement> = describe<HudPlacement>("hud",
    "The place of the head-up display in the cockpit. Left out: the program finds one where it is seen whole, in a window "
    "of any "
    "shape.",
    field("azimuth_deg", Number{{-180, 180}}, "The azimuth of its middle, to the right of straight ahead, degrees.",
        &HudPlacement::azimuth_deg),
    field("elevation_deg", Number{{-90, 90}, 0.5, "height"}, "The elevation of its middle, above straight ahead, degrees.",
        &HudPlacement::elevation_deg),
    field("width_deg", Number{{1, 120}}, "Its apparent width, degrees.", &HudPlacement::width_deg));
static_assert(is_complete<HudPlacement>());

/// An IPv4 address of this computer.
struct OwnAddress {
    std::string read(const Place& place, const Folder&) const;
    Json written(const std::string& address) const { return address; }
    Json schema(Json&) const { return {{"type", "string"}, {"format", "ipv4"}}; }
};
template <>
inline constexpr auto description<HeadTracking> = describe<HeadTracking>("head_tracker",
    "The address and port that receive a tracked head; the view through walls follows it. The format is that of opentrack's "
    "\"UDP over network\" output: x (right), y (up), z (back) in centimetres from eye_m, yaw (left), pitch (up) and roll "
    "(left) "
    "in degrees. If the tracker is silent for a second, the head returns to eye_m.",
    field("port", Whole{1024, 65535}, "UDP port to listen on. No unit.", &HeadTracking::port),
    field("address", OwnAddress{},
        "Address of this computer to listen on: 127.0.0.1 for a tracker on this computer, 0.0.0.0 for one anywhere.",
        &HeadTracking::address),
    field("room_m", Numbers<3>{{0.1, 10}},
        "How far the head may be from eye_m to each side: along x (right), y (up) and z (back), in metres. A head that the "
        "tracker reports beyond is drawn at the edge.",
        &HeadTracking::room_m));
static_assert(is_complete<HeadTracking>());

template <>
inline constexpr auto description<Layout> = describe_file<Layout>("layout",
    "The outputs of an exhibit: its windows, the view in each part of them, and its eye. Places are metres in the cockpit, "
    "from "
    "its middle: +x right, +y up, -z ahead. // and /* */ comments are allowed.",
    field("stereo", Object<Stereo>{}, "", &Layout::stereo), field("blend", Object<Blend>{}, "", &Layout::blend),
    field("hud", Object<HudPlacement>{}, "", &Layout::hud),
    field("head_tracker", Object<HeadTracking>{}, "", &Layout::head_tracker),
    field("surrounds", Flag{},
        "true: the display surrounds the visitor, as a dome or a room of screens does; tours come nearer to what would be "
        "small there.",
        &Layout::surrounds),
    needed("outputs", List{Object<Output>{}, 1, 64, "outputs"}, "The exhibit's windows, or pictures when drawn off-screen.",
        &Layout::outputs),
    not_in_file(&Layout::name, &Layout::file));
static_assert(is_complete<Layout>());
void check(const Place& place, const Layout& layout, const Folder&);

} // namespace starbow
