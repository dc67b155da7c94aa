// Distances interpolated in the cube map's depth: near / depth is linear across a plane's picture, so interpolation is
// exact. Needs received_light.glsl.

// The same as distance_at, but smooth on surfaces. Where the four texels around belong to different surfaces, only the
// nearest texel is used.
float smooth_distance_at(Place place)
{
    vec2 at = place.texel - 0.5;
    vec4 image = texelFetch(tiles, place.entry + 1);
    vec2 low = image.xy, high = image.zw;
    ivec2 t = ivec2(clamp(floor(at), low, max(low, high - 1.0)));
    vec2 part = clamp(at - vec2(t), 0.0, 1.0);
    ivec2 next = min(t + 1, ivec2(high));
    vec4 four = vec4(texelFetch(depth_atlas, t, 0).r, texelFetch(depth_atlas, ivec2(next.x, t.y), 0).r,
        texelFetch(depth_atlas, ivec2(t.x, next.y), 0).r, texelFetch(depth_atlas, next, 0).r);
    float least = min(min(four.x, four.y), min(four.z, four.w)), most = max(max(four.x, four.y), max(four.z, four.w));
    if (least <= 0.0 || most > 1.25 * least)
        return distance_at(place);
    float depth = mix(mix(four.x, four.y, part.x), mix(four.z, four.w, part.x), part.y);
    return view.boost.w * sqrt(1.0 + dot(place.face, place.face)) / depth;
}
