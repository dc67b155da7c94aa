// The specialization constants of all passes, one text for GLSL and for C++, which includes it in runtime/render/pipelines.h.
// A row is CONSTANT(id, type, name in shaders, name in C++, value where a pipeline gives none). An id has one meaning in all
// passes. A shader declares the lists that it uses:
//
//   RANGE_CONSTANTS(DECLARED)
//
// A pipeline may give constants that its shaders lack.
#ifndef STARBOW_CONSTANTS
#define STARBOW_CONSTANTS

#ifndef __cplusplus
#define DECLARED(id, type, name, member, usual) layout(constant_id = id) const type name = usual;
#endif

// The coefficients of light.
#define COEFFICIENT_CONSTANTS(CONSTANT) \
    CONSTANT(0, int, REFLECTED, reflected, 3) /* of reflected sunlight: 3 are a colour */ \
    CONSTANT(1, int, OWN, own, 0) /* of emission basis spectra */ \
    CONSTANT(2, bool, WITH_ALPHA, with_alpha, false) /* a group has three, as some surfaces are blended */

// A world's rest frames: several have each their own part of the cube map.
#define MOTION_CONSTANTS(CONSTANT) CONSTANT(3, bool, SEVERAL_REST_FRAMES, several_rest_frames, false)

// Surfaces, in the vertex and the fragment stage.
#define CORNER_CONSTANTS(CONSTANT) \
    CONSTANT(4, bool, CLOCK, clock, false) \
    CONSTANT(5, bool, FINITE_EXISTENCE, finite_existence, false) /* tests existence intervals */ \
    CONSTANT(6, bool, BLINK, blink, false)

// Surfaces, in the vertex stage alone.
#define POSE_CONSTANTS(CONSTANT) \
    CONSTANT(7, bool, MOVES, moves, false) /* animated */ \
    CONSTANT(8, bool, DEFORMS, deforms, false) /* and of a changing shape */

// Pipelines that differ in their topology alone must not be taken for each other.
#define TOPOLOGY_CONSTANTS(CONSTANT) CONSTANT(9, int, TOPOLOGY, topology, 0)

// Surfaces, in the fragment stage alone.
#define TEXEL_CONSTANTS(CONSTANT) \
    CONSTANT(10, bool, BASE_TEXTURE, base_texture, false) \
    CONSTANT(11, bool, EMISSIVE_TEXTURE, emissive_texture, false) \
    CONSTANT(12, bool, MASKED, masked, false) /* texels below an alpha are left out */ \
    CONSTANT(13, bool, UNLIT, unlit, false) \
    CONSTANT(14, int, LIGHTS, lights, 0) \
    CONSTANT(15, int, KINDS, kinds, 1) /* of spectra that illuminate surfaces */ \
    CONSTANT(16, bool, MATRICES, matrices, false) /* otherwise the coefficients are the colour, ultraviolet and infrared */ \
    CONSTANT(17, bool, LAMPS_MOVE, lamps_move, false) \
    CONSTANT(18, bool, CONES, cones, false) /* some lamps shine in cones */ \
    CONSTANT(19, bool, UNSHIFTED, unshifted, false) /* light is stored as its colour at D = 1 */ \
    CONSTANT(20, int, SHADOWS, shadows, 0) /* bits: lamps with maps; the 16th daylight */ \
    CONSTANT(21, bool, BLENDED, blended, false) /* over what is behind it, by its alpha */ \
    CONSTANT(26, int, POINT_LAMPS, point_lamps, 0) /* bits: point lamps; the others are directional */ \
    CONSTANT(27, bool, EMITS, emits, false) /* light of its own */ \
    CONSTANT(28, bool, COLOURED, coloured, false) /* its corners have colours */

// Surfaces with gloss, or with maps that have coordinates of their own.
#define GLOSS_CONSTANTS(CONSTANT) \
    CONSTANT(22, bool, MATT, matt, false) /* no gloss: the maps alone */ \
    CONSTANT(23, bool, ROUGHNESS_MAP, roughness_map, false) \
    CONSTANT(24, bool, NORMAL_MAP, normal_map, false) \
    CONSTANT(25, bool, OCCLUSION_MAP, occlusion_map, false)

#define SURFACE_CONSTANTS(CONSTANT) \
    MOTION_CONSTANTS(CONSTANT) CORNER_CONSTANTS(CONSTANT) POSE_CONSTANTS(CONSTANT) TEXEL_CONSTANTS(CONSTANT) \
    GLOSS_CONSTANTS(CONSTANT)

// A view's pixels, and the light that they receive.
#define MAP_CONSTANTS(CONSTANT) CONSTANT(30, bool, MAP, map, false) /* a direction map; otherwise linear in the pixel */
#define SAMPLE_CONSTANTS(CONSTANT) CONSTANT(42, int, CUBE_SAMPLES, cube_samples, 1) /* of each texel; also in the cube pass */
#define RECEIVED_CONSTANTS(CONSTANT) \
    CONSTANT(31, bool, ABERRATION, aberration, false) \
    CONSTANT(32, bool, DOPPLER, doppler, false) \
    CONSTANT(33, bool, HEADLIGHT, headlight, false) \
    CONSTANT(34, bool, GALILEAN, galilean, false) /* Galilean aberration, for comparison */ \
    CONSTANT(35, bool, MIPS, mips, false) \
    CONSTANT(36, bool, CHANNELS, channels, false) /* red, green and blue have directions of their own */ \
    CONSTANT(37, bool, STARS, stars, false) /* added to the cube map's light */ \
    CONSTANT(38, bool, BY_TABLE, by_table, true) /* otherwise the coefficients are the unshifted colour */ \
    CONSTANT(39, bool, SINGLE, single, false) /* one image of the plan, ahead, covers all: view.eye is its \
                                                 TileEntry::texel_from_face */ \
    CONSTANT(40, int, RAYS, rays, 1) /* along each side of a pixel */ \
    CONSTANT(41, bool, CUT, cut, false) /* some tile of the plan has more than one image */ \
    SAMPLE_CONSTANTS(CONSTANT) \
    CONSTANT(43, bool, UNALIGNED, unaligned, false) /* some cube map has other axes than the motion's */

// Two eyes that share one cube map.
#define EYE_CONSTANTS(CONSTANT) \
    CONSTANT(44, bool, REPROJECT, reproject, false) /* the eye is not where the cube map was drawn */ \
    CONSTANT(45, bool, TURNING, turning, false) /* the eye's side depends on the azimuth */

#define REST_FRAME_CONSTANTS(CONSTANT) \
    CONSTANT(46, bool, WORLD_ALONE, world_alone, false) /* of several rest frames only the world's is seen here */ \
    CONSTANT(47, int, REST_FRAMES, rest_frames, 1) /* of the world; MAX_REST_FRAMES: more than a few */
#define PANORAMA_CONSTANTS(CONSTANT) CONSTANT(48, bool, MILKY_WAY, milky_way, false) /* the sky has a panorama */
#define GLOBE_CONSTANTS(CONSTANT) \
    CONSTANT(49, int, GLOBES, globes, 0) /* of the world */ \
    CONSTANT(54, bool, EACH_GLOBE, each_globe, false) /* in turn for all pixels of a group, which then share its numbers: \
                                                        faster on a GPU; otherwise those alone that a pixel meets */ \
    CONSTANT(55, bool, GLOWS, glows, false) /* what shines above a globe's air shows */
#define RANGE_CONSTANTS(CONSTANT) CONSTANT(50, bool, RANGE, range, false) /* through the curve that shows all at once */
#define PART_CONSTANTS(CONSTANT) CONSTANT(51, bool, LAYERED, layered, false) /* by the view's part of each pixel */
// Light for the glow, before the tone curve; alpha 0: shows nothing.
#define LINEAR_CONSTANTS(CONSTANT) CONSTANT(52, bool, LINEAR, linear, false)

#define VIEW_CONSTANTS(CONSTANT) MOTION_CONSTANTS(CONSTANT) VIEW_CONSTANTS_ALONE(CONSTANT)
#define VIEW_CONSTANTS_ALONE(CONSTANT) \
    MAP_CONSTANTS(CONSTANT) RECEIVED_CONSTANTS(CONSTANT) EYE_CONSTANTS(CONSTANT) REST_FRAME_CONSTANTS(CONSTANT) \
    PANORAMA_CONSTANTS(CONSTANT) GLOBE_CONSTANTS(CONSTANT) RANGE_CONSTANTS(CONSTANT) PART_CONSTANTS(CONSTANT) \
    LINEAR_CONSTANTS(CONSTANT) RESPONSE_CONSTANTS(CONSTANT)

// The device's sampler interpolates the response: faster on a GPU, slower in software, and 0.3 % off at most.
#define RESPONSE_CONSTANTS(CONSTANT) CONSTANT(53, bool, SAMPLED_RESPONSE, sampled_response, false)

// Single passes.
#define DITHER_CONSTANTS(CONSTANT) CONSTANT(60, bool, DITHERED, dithered, true) /* the target has 8 bits */
#define STAR_CONSTANTS(CONSTANT) CONSTANT(61, bool, HALVES, halves, false) /* the picture has 16 bits a number */
// Luminance samples for the exposure: one pixel for each star.
#define STAR_METER_CONSTANTS(CONSTANT) CONSTANT(62, bool, METERING_SAMPLES, metering_samples, false)
#define OVERLAY_PASS_CONSTANTS(CONSTANT) CONSTANT(63, int, OVERLAY, overlay, 0) /* OVERLAY_NONE */
#define PATTERN_CONSTANTS(CONSTANT) CONSTANT(64, int, PATTERN, pattern, 0)
#define SKY_PASS_CONSTANTS(CONSTANT) CONSTANT(65, int, GROUPS, groups, 1)
#define BLOOM_CONSTANTS(CONSTANT) \
    CONSTANT(66, bool, UP, up, false) \
    CONSTANT(67, bool, FIRST, first, false) /* from the light itself */
#define COMPRESS_CONSTANTS(CONSTANT) \
    CONSTANT(68, bool, COLOURS, colours, true) /* the picture is decoded by sRGB's curve, the block keeps stored values */
#define LAYER_CONSTANTS(CONSTANT) \
    CONSTANT(69, bool, PLAIN, plain, false) /* by the parts of the viewports alone, without masks and brightness */
#define PANEL_CONSTANTS(CONSTANT) \
    CONSTANT(70, bool, SCALE, scale, false) /* with the scale of false colours in the rectangle view.eye of the panel */ \
    CONSTANT(71, bool, LIGHT, light, false) /* the panel is a picture of light with a frame around it */
// COMBINE: 0 one canvas; two by 1 rows, 2 columns, 3 checkerboard; 4 both added. CURVE: 0 sRGB, 1 gamma, 2 table.
#define FINISH_CONSTANTS(CONSTANT) \
    CONSTANT(72, int, COMBINE, combine, 0) \
    CONSTANT(73, bool, SCREENED, screened, false) /* with blend ramps, masks and a black level */ \
    CONSTANT(74, int, CURVE, curve, 0)

#define PASS_CONSTANTS(CONSTANT) \
    DITHER_CONSTANTS(CONSTANT) STAR_CONSTANTS(CONSTANT) STAR_METER_CONSTANTS(CONSTANT) OVERLAY_PASS_CONSTANTS(CONSTANT) \
    PATTERN_CONSTANTS(CONSTANT) SKY_PASS_CONSTANTS(CONSTANT) BLOOM_CONSTANTS(CONSTANT) COMPRESS_CONSTANTS(CONSTANT) \
    LAYER_CONSTANTS(CONSTANT) PANEL_CONSTANTS(CONSTANT) FINISH_CONSTANTS(CONSTANT) TOPOLOGY_CONSTANTS(CONSTANT)

#endif
