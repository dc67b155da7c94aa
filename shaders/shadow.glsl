// Shadows and daylight of still things under still lamps, in the world's rest frame (runtime/world/shadows.h). Places are from
// the eye, in the cube map's axes; a triangle's plane follows from its texels' middles. A driver in software takes both ways of
// a branch, so there is none.

layout(set = 0, binding = 5) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 6) uniform sampler2DArray sky_cells; // layers along z

// The part of the four texels around that the light reaches: interpolated. at: in texels. depths: the surface's own at the
// texels' middles, in the order of textureGather.
float reached(ShadowEntry map, vec2 at, vec2 part, float layer, vec4 depths)
{
    vec4 lit = vec4(lessThanEqual(textureGather(shadow_maps, vec3(at * map.map.y, layer)), depths));
    return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}

// The same of nine texels around, by a quadratic B-spline, about as wide as the Sun's own blur. depth: the surface's own at
// the place; slope: its change per texel. A ground that is far larger than the things on it lies beyond the maps' depth, and
// has the number 0 there, whatever its slope.
float reached_smoothly(ShadowEntry map, vec2 at, float layer, float depth, vec2 slope)
{
    vec2 middle = floor(at) + 0.5, off = at - middle;
    vec2 low = 0.5 * (0.5 - off) * (0.5 - off), high = 0.5 * (0.5 + off) * (0.5 + off), here = 1.0 - low - high;
    float lit = 0.0;
    for (int k = 0; k < 4; ++k) { // four texels each, of which the outer rows count once
        vec2 corner = vec2(k & 1, k >> 1); // 0: the two texels up to the middle, 1: the one after it
        vec4 nearest = textureGather(shadow_maps, vec3((middle - 0.5 + 2.0 * corner) * map.map.y, layer));
        vec2 first = 2.0 * corner - 1.0 - off; // from the place to the block's lowest texel
        vec4 x = first.x + vec4(0.0, 1.0, 1.0, 0.0), y = first.y + vec4(1.0, 1.0, 0.0, 0.0);
        vec2 a = (k & 1) == 0 ? vec2(low.x, here.x) : vec2(high.x, 0.0), b = k < 2 ? vec2(low.y, here.y) : vec2(high.y, 0.0);
        lit += dot(a.xyyx * b.yyxx, vec4(lessThanEqual(nearest, max(depth + slope.x * x + slope.y * y, 0.0) + map.map.w)));
    }
    return lit;
}

vec3 rows(vec4 u, vec4 v, vec4 w, vec3 at) { return vec3(dot(u.xyz, at), dot(v.xyz, at), dot(w.xyz, at)); }

// The part of a directional lamp's light that reaches a place. The triangle's own plane tells the depth at each texel, so that
// it does not shade itself and yet is shaded by things that touch it. The maps hold the full surface; above: from the drawn one
// to its lit side.
float reached_from_afar(ShadowEntry map, vec3 point, vec3 above)
{
    vec3 from_eye = rows(map.u, map.v, map.depth, point), at = from_eye + vec3(map.u.w, map.v.w, map.depth.w);
    at += rows(map.u, map.v, map.depth, above);
    vec3 middle_ = rows(map.u, map.v, map.depth, place); // the texel's
    vec3 x = dFdx(middle_), y = dFdy(middle_); // without the offset, beside which near steps would be rounded away
    float area = x.x * y.y - x.y * y.x;
    vec2 slope = vec2(x.z * y.y - y.z * x.y, y.z * x.x - x.z * y.x) / (abs(area) > 0.0 ? area : 1e-30);
    slope = clamp(slope, vec2(-map.map.z), vec2(map.map.z));
    // The outer two texels are for the look-ups of places further in: nothing that hides light lies there.
    float half_ = 0.5 / map.map.y, inside = half_ - 2.0;
    bool fine = all(lessThan(abs(at.xy - half_), vec2(inside)));
    vec4 scale = fine ? vec4(1.0, 1.0, 0.0, 0.0) : map.coarse;
    vec2 texel = at.xy * scale.xy + scale.zw;
    slope /= scale.xy;
    float lit = reached_smoothly(map, texel, map.map.x + (fine ? 0.0 : 1.0), at.z, slope);
    return all(lessThan(abs(texel - half_), vec2(inside))) ? lit : 1.0;
}

// The direction of a place on a face of the cube around a point light.
vec3 cube_direction(vec2 side, bool x, bool y, float sign_)
{
    return x ? vec3(sign_, side) : y ? vec3(side.x, sign_, side.y) : vec3(side, sign_);
}

// The same for a resting point lamp.
float reached_from_near(ShadowEntry map, vec3 point, vec3 above)
{
    vec3 from_eye = rows(map.u, map.v, map.depth, point), way = from_eye + vec3(map.u.w, map.v.w, map.depth.w);
    way += rows(map.u, map.v, map.depth, above);
    vec3 middle_ = rows(map.u, map.v, map.depth, place); // the texel's
    vec3 facet = cross(dFdx(middle_), dFdy(middle_)), size = abs(way);
    bool x = size.x >= size.y && size.x >= size.z, y = !x && size.y >= size.z;
    float along = x ? way.x : y ? way.y : way.z, sign_ = along < 0.0 ? -1.0 : 1.0;
    vec2 side = (x ? way.yz : y ? way.xz : way.xy) / max(abs(along), 1e-30);
    vec2 texel = (0.5 + 0.5 * side) / map.map.y, part = fract(texel - 0.5), first = texel - part;
    float distance_ = length(way), to_plane = dot(facet, way);
    facet *= sign(to_plane);
    vec4 depths;
    for (int k = 0; k < 4; ++k) {
        // At the face's border the nearest texel is read.
        vec2 middle = clamp(2.0 * (first + vec2(k == 1 || k == 2, k < 2)) * map.map.y - 1.0, map.map.y - 1.0, 1.0 - map.map.y);
        float cosine = dot(facet, normalize(cube_direction(middle, x, y, sign_)));
        float there = cosine > 0.0 ? min(abs(to_plane) / cosine, 2.0 * distance_) : distance_;
        depths[k] = max(there * map.coarse.x + map.coarse.y, 0.0) + map.map.w;
    }
    return reached(map, texel, part, map.map.x + (x ? 0.0 : y ? 2.0 : 4.0) + (along < 0.0 ? 1.0 : 0.0), depths);
}

// The part of the ambient light that reaches a place with the unit normal n: of the sky, and from the surfaces that hide it.
float ambient_part(vec3 point, vec3 n)
{
    vec3 size = vec3(textureSize(sky_cells, 0)) * vec3(1.0, 1.0, 0.5);
    vec3 normal = rows(cube.sky_cells[0], cube.sky_cells[1], cube.sky_cells[2], n); // over the cells' width
    vec3 cells = rows(cube.sky_cells[0], cube.sky_cells[1], cube.sky_cells[2], point)
        + vec3(cube.sky_cells[0].w, cube.sky_cells[1].w, cube.sky_cells[2].w);
    normal *= inversesqrt(dot(normal, normal));
    // A whole cell above the surface: no cell behind a ground or a wall along the axes is read.
    vec3 above = cells + normal;
    cells = clamp(above, vec3(0.0), size - 1.001);
    vec2 across = (cells.xy + 0.5) / size.xy;
    float plane = floor(cells.z), part = cells.z - plane;
    vec4 b = mix(textureLod(sky_cells, vec3(across, 2.0 * plane), 0.0), textureLod(sky_cells, vec3(across, 2.0 * plane + 2.0), 0.0), part);
    vec4 s = mix(textureLod(sky_cells, vec3(across, 2.0 * plane + 1.0), 0.0), textureLod(sky_cells, vec3(across, 2.0 * plane + 3.0), 0.0), part);
    float seen = clamp(dot(b.xyz - 0.5, normal) + dot(s.xyz, normal * normal), 0.0, 1.0);
    // Outside the grid things hide the less of the sky, the farther away they are, and a ground hides what it hides there.
    float margin = 255.0 * s.w, near = margin / (margin + distance(above, cells)), far = 1.0 - b.w * (0.5 - 0.5 * normal.y);
    return mix(HIDDEN_SKY_PART, 1.0, mix(far, seen, near * near));
}
