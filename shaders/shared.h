// Data that the processor writes and the shaders read, one text for both. C++ includes it through
// shaders/shared_structs.h, which asserts the sizes. All members are 16-byte aligned, so that std140, std430 and C++
// agree.
//
// A number that decides a branch must not have a constant place in a uniform buffer: there, llvmpipe (Mesa 22.3) takes it
// for a constant, compiles the shader again whenever the buffer is bound, if that makes it much shorter, and keeps every
// copy. Such a number is therefore in an array, and the array's index has an addend that is 0, and that only the buffer
// tells: the bits of a float, which need no conversion. In a stage with four uniform buffers and push constants, it crashes
// over such a number in the last of them.

// The fixed division's tiles (see tiles.h); every tile has an entry, drawn or not.
#define TILE_FRONT 0
#define TILE_SIDES 1
#define SIDE_BANDS 3
#define TILE_REAR 13
#define REAR_LEVELS 43
#define TILE_COUNT 56
#define TILE_SUB_TILES 16 // along each side of a tile, a power of 2; a tile's images are rectangles of them

#define REPROJECT_STEPS 12
#define REPROJECT_ROUNDS 4
// The sky's distance in shaders, farther than any thing's: a driver may leave out infinities, and then isinf() is never
// true. The processor reads it as infinite.
#define SKY_DISTANCE 3e38
#define MOST_PARALLAX 0.35 // radians between two eyes' directions of a point, at most: nearer surfaces all have this value
#define MAX_LIGHTS 8
#define POSES 17 // odd; poses of an animated instance, around the retarded time of its middle
#define WEIGHTS_PER_ENTRY 12 // of morph targets, in an InstanceEntry
#define MAX_REST_FRAMES 16 // velocities of moving bodies, and rest
#define MOST_REFLECTED 12 // basis coefficients of reflected sunlight
#define MAX_OWN 4 // emission basis spectra of a scene, each with one coefficient
#define MAX_GROUPS 4 // groups of coefficients: one image of the cube map for each
// A group has four coefficients; three in worlds with blended surfaces, whose alpha blends its image as the fourth number.
#define GROUP_COUNT(coefficients, with_alpha) ((with_alpha) ? ((coefficients) + 2) / 3 : ((coefficients) + 3) / 4)
#define PLACE_IN_GROUPS(k, with_alpha) ((with_alpha) ? (k) + (k) / 3 : (k)) // group = place / 4
#define MAX_MATRICES 4096 // columns of a group: 64 KiB, a uniform buffer's size on present devices
#define RESPONSE_ROWS 2048 // over log2 D; see response.h
#define RESPONSE_TEXELS(reflected) ((3 * (reflected) + 5) / 4) // of a row
#define RESPONSE_OWN_STEP(own)                                                                                              \
    ((own) > 2 ? 2 : 1) // step between the stored rows of emission basis spectra: all rows or every second one
#define MOST_OWN_ROWS 4096 // of all together
#define STAR_COLDEST 512.0 // K: colder black bodies are practically dark (1e-9 of the Sun's surface at 550 K)
#define STAR_STEPS_PER_OCTAVE 64
#define STAR_STEPS                                                                                                          \
    769 // 12 octaves: to 2 million K; beyond, a black body's visible light grows linearly with its temperature
#define STAR_RADIUS 2.0 // radius of a star's spot, pixels
#define STAR_SPOT (3.14159265 * STAR_RADIUS * STAR_RADIUS / 5.0) // the integral of (1 - r^2 / R^2)^4, pixels
#define STAR_BEYOND_POLE 0.18 // pixels: a spot reaches over a pole by STAR_RADIUS / sqrt(12), and a whole sphere's rim in a
                              // circle narrows by a pi-th of that
#define STAR_REACH 96.0 // greatest radius of a star's glare, pixels: a device draws points of twice the size
#define STAR_DISC_POINTS 16 // of the Sun's disc, each hidden or not
#define GLARE_LEAST 0.1 // degrees; nearer, light is the star's own spot, as is all light within a pixel
#define GLARE_MOST 3.0 // degrees; farther, glare is left out
#define DISC_GLARE_MOST 6.0 // the same for a star with a disc, the Sun
#define SUN_GLARE_MOST 15.0 // degrees; up to there the Sun's glare fades out
#define GLARE_SHOWN 5e-4 // of white: dimmer glare does not show
#define RANGE_KNOTS 192 // of the curve that shows everything at once, one for each stop of luminance; see range_curve.h
#define RANGE_FIRST (-128.0) // log2 of the luminance at its first knot: of the least normal float, about

#define HIDDEN_SKY_PART 0.4 // of the ambient light; see hidden_sky_part
#define GLOSS_TABLE 32 // texels along both sides of the table of reflected surroundings; see gloss.h
#define LEAST_ROUGHNESS 0.05 // the highlight of a perfect mirror is then as wide as the Sun

#define MAX_GLOBES 16
#define MAX_GLOWS 8
#define GLOBE_LEVELS 8 // of a kind of light, through more and more air, or towards the middle of the Sun's disc
#define GLOBE_COLUMNS 1024 // over log2 D
#define GLOBE_FIRST_LOG2_D (-8.0)
#define GLOBE_PER_OCTAVE 64.0
#define GLOBE_AIR_STEPS 12
#define GLOBE_AIR_DEPTH 0.0973 // optical depth of the Earth's air at 550 nm, from the ground upwards (Bucholtz 1995)
#define GLOBE_CLOUD_RELIEF 3.2e-5 // standard deviation of the heights of clouds and of land, radii: 200 m and 300 m of the Earth
#define GLOBE_LAND_RELIEF 5e-5
#define GLOBE_LAND_CONTRAST 0.3 // of land's detail: standard deviation of its factor of light
#define GLOBE_WIND_CONTRAST 0.5 // of the wind on water, of its mean
#define GLOBE_LAMP_CONTRAST 1.2 // of the logarithm of lamplight
#define GLOBE_DEEPEST_RING 8.0 // optical depth, of the ring profile's white
#define GLOBE_CLOUDY 0.0 // scatters light as a matt surface
#define GLOBE_DUSTY 1.0 // as grains that shade each other (Lommel and Seeliger)
#define GLOBE_SUN 2.0

// One image of the plan, in the warp pass's form: texel of the atlas = face coordinate * scale + offset. Each tile has
// one entry for each of its sub-tiles, rows along the second coordinate, in a texel buffer after the rest frames'
// sub_tiles_from_face.
struct TileEntry {
    vec4 texel_from_face; // x: texels per unit of face coordinate; y, z: offset; w: coarsest mip level
    vec4 texels; // of the atlas: the image's first x, y and last x, y; 0 for a tile that is not drawn
};

#define TILE_ENTRY(tile, cell) (MAX_REST_FRAMES * TILE_COUNT + 2 * (TILE_SUB_TILES * TILE_SUB_TILES * (tile) + (cell)))

struct LightEntry {
    vec4 place; // of a point lamp: its place from the eye, at the eye's time; of a directional one: unit direction towards it.
                // The cube map's axes.
    vec4 radiance; // Rec. 709 linear, pre-exposed; w: square of the distance at which it holds, 0 for a direction
    vec4 kind; // x: index of its spectrum, 0 for sunlight; for a moving lamp the first of `shifts`. y, z: begin and end of
               // its existence in its proper time, counted from that at `place`. w: D of a moving directional light
    vec4 way; // of a moving lamp: unit direction of its motion; w: its gamma beta, 0: it rests
    vec4 shifts; // of a moving lamp: x: log2 D of the first, y: number per octave, z: their number; w: gamma
    vec4 cone; // of a lamp with a cone: unit axis along which it shines, in its own frame's axes, as the surface's frame carries them
    vec4 edge; // its light has the part (edge.x cosine + edge.y)^2, within 0 to 1; x: 0: it shines to all sides
};

// A lamp's shadow maps. Directional: u, v: texels of the fine map, depth: the number that it holds, of a place from the eye in
// the cube map's axes; coarse: the other map's texels, from the fine one's: xy: scale, zw: offset. Point: rows from there to
// the frame's axes, from the lamp; coarse: x: the number's change with the distance, y: at distance 0.
struct ShadowEntry {
    vec4 u, v, depth, coarse;
    vec4 map; // x: its first layer; y: 1 over its texels along a side; z: the steepest slope, per texel; w: bias of the number
};

// The sky: coefficients of the light, pre-exposed.
struct SkyConstants {
    vec4 up; // the world's, in the cube map's axes
    vec4 zenith[MAX_GROUPS], horizon[MAX_GROUPS], nadir[MAX_GROUPS];
    vec4 equatorial0, equatorial1,
        equatorial2; // rows of the turn from the cube map's axes to those of the Milky Way's panorama
    vec4 red[MAX_GROUPS], green[MAX_GROUPS], blue[MAX_GROUPS]; // of the panorama's colours
};

// The cube pass, one entry per eye, rest frame and picture.
struct CubeConstants {
    vec4 ambient; // Rec. 709 linear, w: pre-exposure
    vec4 around[3]; // what glossy surfaces reflect beside the lamps, pre-exposed sunlit colours: at the zenith, the horizon
                    // and the nadir
    SkyConstants sky;
    vec4 first; // indices of this rest frame's first x: instance, y: TimeEntry, z: pose; w: 0, see above
    vec4 sky_cells[3]; // rows: the cells of Shadows::sky of a place from the eye, in the cube map's axes
    ShadowEntry shadows[MAX_LIGHTS];
    vec4 now[1]; // w: 1 where everything is shown at the ship's present; xyz: the ship's velocity here
    vec4 growth[1]; // an angle here over that in the ship, in a unit direction n: w + dot(xyz, n)
    LightEntry lights[MAX_LIGHTS];
};

// One instance relative to one eye: rows of cube_from_local. A pose of a deforming instance has such an entry for each bone,
// and after them entries of its targets' weights.
struct InstanceEntry {
    vec4 row0, row1, row2;
};

// A vertex of a deforming surface before it deforms, in its mesh's coordinates.
struct DeformingVertex {
    vec4 position, normal, tangent; // w: not used
    vec4 weights[2]; // of its bones; their sum is 1
    vec4 bones[2]; // their indices
};
#define DEFORMING_VERTEX_ROWS 7
#define BONES_PER_VERTEX 8
#define WEIGHTS_ROW 3 // of `weights`
#define BONES_ROW 5 // of `bones`

// The displacement of a vertex by a morph target of weight 1.
struct Displacement {
    vec4 position, normal; // w: not used
};
#define DISPLACEMENT_ROWS 2

// The times of an instance relative to one eye: of clocks, of blinking and animated instances, and of those with finite
// existence.
struct TimeEntry {
    vec4 middle; // from the eye, the cube map's axes; w: its distance. The other members hold at its retarded time
    vec4 turns; // 0 to 1 of a clock's hands: one turn in a minute, in ten seconds, in an hour; w: seconds per scene unit of
                // light's travel
    vec4 digits; // x, y: six figures each, of four bits, the first lowest; 10: a minus, 11: blank. z: their number
    vec4 there; // x, y: the light-travel offsets from the middle between which it existed
    vec4 poses; // of an animated instance: x: its first pose, from the rest frame's first; y, z: poses per scene time
                // before the middle one, and after it; w: the middle one's offset
    vec4 deforming; // of a deforming instance: x: entries of each pose; y: targets; z: its first vertex' row, w: its first
                    // displacement's, both as the bits of integers
    vec4 blink; // x: the elapsed part of a period, 0 to 1; y: periods per scene unit of time; z: the part in which it is on
};

// Push constants of the cube pass.
struct CubePush {
    vec4 clip_x, clip_y, clip_w; // rows of clip_from_cube
    vec4 surface; // x: z in clip space of all vertices, as z is reversed and the far plane infinite; y: index of the first
                  // draw's DrawEntry; z: texels of a pixel of the ship in the middle of the face
};

// The sky of one image of the plan.
struct SkyImage {
    vec4 corner, along_a, along_b; // directions: of its low corner, and from there to the two next to it
    vec4 place; // in the clip space of the area that all images take: xy: the low corner, zw: from there to the opposite one
};

// One draw into one image of the plan.
struct DrawEntry {
    uint material; // index of its SurfaceEntry
    float apart; // how far the drawn surface may lie below the full one, scene units
};

// The light of a material's surfaces.
struct SurfaceEntry {
    vec4 base_colour;
    vec4 emissive; // pre-exposed; w: alpha cut-off
    vec4 beyond; // reflectance in the ultraviolet and the infrared, below 0: the colour's mean; z: index of the matrices;
                 // w: the emissive light's basis spectrum, -1: a sunlit colour
    vec4 own; // its glow in each emission basis spectrum, pre-exposed
};

// A texture's coordinates from two of the file's sets: u = dot(u, (x, y, 0, 1)), of the second set where `set` is 1.
struct MapEntry {
    vec4 u, v; // x, y: rows of the transform; w: offset; u.z: the set
};

// A surface with gloss or with maps that have coordinates of their own.
struct MaterialEntry {
    vec4 gloss; // x: metallic, y: roughness, z: scale of the normal map, w: strength of the occlusion map
    vec4 dielectric; // x: its reflectance at right angles
    MapEntry emissive, metallic_roughness, normal, occlusion;
};

// Push constants of the passes that run once per output pixel.
struct ViewPush {
    vec4 row0, row1, row2; // planar: rows of direction_from_pixel; map: rows of the rotation from the map's axes. The star
                           // pass has the inverse of both. row0.w: planar: a pixel's step on the plane at distance 1;
                           // row1.w: finest clip level; row2.w: the place of D = 1 in the response, whose width is 1; in the
                           // star pass the light at which glare ends, or 0: no glare
    vec4 boost; // E, 1/E, exposure gain / pre-exposure (star pass: pre-exposure), near plane
    vec4 origin; // viewport's top left corner in the target, pixels; z, w: 1 / the atlas's size in texels
    vec4 eye; // REPROJECT: the eye's place from the cube map's, world, the cube map's axes. TURNING: xyz: the cockpit's
              // up in motion axes; w: the eye's distance from the middle, to the right. SINGLE: TileEntry::texel_from_face
    vec4 zenith; // x: TURNING: sine of the angle from the zenith at which the separation is full; without REPROJECT: log2 of
                 // boost.z. y: REPROJECT: distance of the nearest possible surface, scene units. z, w: the viewport's size,
                 // pixels; in the meter: pixels of the viewport for each sample
    vec4 corner; // xy: the viewport's top left corner in the output, pixels, also where it is drawn elsewhere; for stars'
                 // luminance samples: pixels across and down, and z: the number of stars for each sample. Otherwise z: twice
                 // log2 of the response's greatest D, w: the part of the response's width that an octave of D takes
};

// The warp pass's data of one rest frame for one view's eye, like ViewPush, which has the world's.
struct RestFrameEntry {
    vec4 row0, row1, row2; // rows of the rotation from the world's motion axes, both in the ship; row1.w: as ViewPush's
    vec4 cube0, cube1, cube2; // UNALIGNED: rows of cube_from_motion
    vec4 boost; // E, 1/E; z: index of its first tile, w: its index among the world's frames
    vec4 eye;
    vec4 nearest; // y: as ViewPush's zenith
    vec4 cap; // its surfaces lie in the ship's directions n with dot(n, xyz) >= w, the world's motion axes; w = -2: in any
};

// The rest frames of one view, and the sky behind them.
struct RestFrameConstants {
    vec4 count[1]; // x: number of rest frames
    vec4 first; // w: 0, see above
    SkyConstants sky;
    RestFrameEntry entries[MAX_REST_FRAMES]; // the world's first
};

// A globe as one eye sees it. Its own axes: z to its north pole, x to its prime meridian; its unit is its equatorial radius.
struct GlobeEntry {
    vec4 near; // direction to its middle, the cube map's axes; w: chord of the angle from there within which it shows
    vec4 row0, row1, row2; // rows from the cube map's axes to its own, each over its radius there; w: the eye's place
    vec4 shape; // x: factor of its map; y: polar over equatorial radius; z: radius as an angle; w: its way to scatter
    vec4 light; // direction to the Sun, its own axes; w: light of a white surface that faces it
    vec4 kinds; // rows of globe_light: of its map's red, green and blue, and of its water or of all without a map; -1: none
    vec4 map; // x: layer of globe_maps, -1: none; y: its rows of texels; z: row of light that is reflected as it came; w: of its mean
    vec4 air; // x: scale height, 0: no air; y: height of its end; rows z: of light that the air scatters, w: of clouds
    vec4 ring; // x: inner, y: outer radius, 0: none; z: its row; w: the Sun's radius from here as an angle
    vec4 shade; // place of the globe that may hide the Sun from it; w: that one's radius, 0: none
    vec4 lamps; // x: row of the light of its cities; y: their radiance, over a sunlit white surface's; z: its radius over the Sun's distance
};

// The globes before one view's sky, the farthest first.
struct GlobeConstants {
    vec4 first; // x: pre-exposure; y: even glows; z: those of aurora, after them; w: 0, see above
    vec4 sun; // direction in which the ship sees the Sun's middle, motion axes; w: its radius there, degrees
    vec4 sunlight; // illuminance from there, as starlight in star.vert, pre-exposed
    vec4 aurora; // the middle of the northern oval, axes of the globe with air, unit; the southern one is opposite; w: its highest radius
    vec4 glows[MAX_GLOWS]; // layers above the air of that globe, which shine by themselves, those of aurora last; x: inner, y: outer
                           // radius; z: radiance of a radius of way, over a sunlit white surface's; w: row of globe_light
    GlobeEntry entries[MAX_GLOBES];
};

// The curve of luminance that shows everything at once.
struct RangeConstants {
    vec4 knots[RANGE_KNOTS]; // x: log2 of the shown luminance; y: its change to the next knot
};

// A star, in the scene's world at rest.
struct StarEntry {
    vec4 direction; // unit, towards it; w: temperature, K; below 0: it is a globe, of number -1 - w
    vec4 light; // illuminance at rest, in the scene's white times steradians: x: over the luminance of its temperature
                // (black_body_xyz), y: the illuminance itself, z: its radius as an angle, of the Sun alone; w: its distance, scene
                // units. Of a globe: x: times its mean's light; y: its radius as an angle
};

// The stars' pass, one per frame.
struct StarConstants {
    vec4 row0, row1, row2; // rows of motion_from_world
};

// The measuring overlays of a viewport.
struct OverlayConstants {
    vec4 world0, world1, world2; // rows of world_from_motion; world0.w: 0, see above
    vec4 ring; // x: cosine, y: sine of the angle from the motion where D = 1; z: 1 where there is one;
               // w: 1 without light delay
    vec4 scale; // of the colours: x: lowest log10 of a distance in seconds of light, y: 1 over the range; z: log10 of
                // seconds of light per scene unit
    vec4 steps; // retarded time: x: seconds between contours, y: the eye's time since a heavier one, seconds; z: seconds
                // of light per scene unit; w: the proper velocity, without light delay
    vec4 aim[1], right, up; // the look's axes, in motion axes; aim[0].w: 1: the crosshair is drawn
    vec4 marks[2]; // directions in the ship, motion axes; w: 1 where there is one
};

#define OVERLAY_NONE 0
#define OVERLAY_GRID 1
#define OVERLAY_RING 2
#define OVERLAY_DISTANCE 3
#define OVERLAY_EMISSION 4
#define OVERLAY_PROTRACTOR 5
#define OVERLAY_FIGURES 6

// The table of the constellations' lines, as figure_table() of runtime/world/sky_names.h has it: cells, and the distance in
// radians up to which a cell has lines.
#define FIGURE_ROWS 64
#define FIGURE_COLUMNS 128
#define FIGURE_REACH 0.05

// Push constants of the finish pass: from light to the screen's input. The vectors are rows of matrices.
struct FinishPush {
    vec4 left0, left1, left2; // of the first canvas, or the only one
    vec4 right0, right1, right2; // of the second canvas, where both are added
    vec4 curve; // x: 1 / gamma or the table's last index; y: headroom under the black level
};

// Push constants of the glow.
struct BloomPush {
    vec4 step; // xy: 1 / size of the drawn picture, pixels
    vec4 texel; // xy: 1 / size of the read picture, texels
    vec4 part; // x: the share that glows of the light brighter than y; zw: the viewport's top left corner in the target, pixels
};

// Push constants of the test patterns.
struct PatternPush {
    vec4 row0, row1, row2; // as ViewPush's, to the cockpit's axes
    vec4 origin; // xy: as ViewPush's; zw: pixels of the view
    vec4 tint; // rgb: this output's, or this eye's
    vec4 label; // xy: size of the label in pixels; z: part of the view around its middle that is
                // shown; w: the output's gamma, 0: sRGB's curve
};

// Test patterns, by number.
#define PATTERN_GRID 1
#define PATTERN_RINGS 2
#define PATTERN_NAMES 3
#define PATTERN_WEDGES 4
#define PATTERN_OVERLAP 5
