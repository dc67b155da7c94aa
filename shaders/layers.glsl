// Where something moves: what stands still in each frame has a cube map of its own, boosted straight to the camera. Along a
// line of sight the light's way in the ship is D times its way in any frame: by that they are sorted, in front of the sky.

Layer layer_of(LayerEntry entry)
{
    return Layer(entry.boost.xy, entry.eye, entry.nearest.y, int(entry.boost.z), int(entry.row1.w));
}

// Part of the sky, at the world's direction n: sky.frag's.
void sky_at(vec3 n, out vec4 numbers[MAX_GROUPS])
{
    float height = dot(n, layered.world_up.xyz), part = smoothstep(0.0, 1.0, abs(height));
    for (int group = 0; group < GROUPS; ++group)
        numbers[group] = mix(layered.sky_horizon[group], height > 0.0 ? layered.sky_zenith[group] : layered.sky_nadir[group], part);
}

// What one layer shows, and how far off in the ship it is: infinite where it shows nothing.
struct Part {
    Place place;
    float D, world_angle, way;
    float covers; // of the pixel
};
Part part_of(int i, vec3 n0, float pixel_angle, float D_beside)
{
    LayerEntry entry = layered.layers[i];
    Layer layer = layer_of(entry);
    vec3 n = i == 0 ? n0 : vec3(dot(entry.row0.xyz, n0), dot(entry.row1.xyz, n0), dot(entry.row2.xyz, n0));
    Sight sight = world_from_camera(n, layer.E.x, layer.E.y);
    Part part;
    part.world_angle = sight.D * pixel_angle;
    if (REPROJECT)
        sight.n = reprojected(sight.n, eye_offset(n, layer), part.world_angle, layer);
    part.place = place_of(sight.n, layer);
    part.D = sight.D * D_beside;
    part.way = intBitsToFloat(0x7f800000);
    part.covers = 0.0;
    vec4 image = slots[part.place.slot].texels;
    vec2 texel = part.place.atlas * view.origin.zw;
    // What moves does not fill its images, and pixels look past them: nothing beyond their edges is filtered in.
    float margin = i == 0 ? 0.5 : 2.0 * exp2(part.place.detail.y);
    if (image.z > 0.0 && all(greaterThanEqual(texel, image.xy + margin)) && all(lessThanEqual(texel, image.zw + 1.0 - margin))) {
        vec2 covered = textureLod(covered_atlas, part.place.atlas, level_of(part.place, part.world_angle)).rg;
        part.covers = min(covered.x, 1.0);
        if (covered.x > 0.0 && covered.y > 0.0)
            part.way = sight.D * view.boost.w * sqrt(1.0 + dot(part.place.face, part.place.face)) * covered.x / covered.y;
    }
    return part;
}

// What the ship's direction n0 (the world's motion axes) shows: the light of all layers, the nearest first, and of the sky. sight: the world's; its D, and the distance, become those of
// what most of the pixel shows of them.
vec3 light_of_layers(vec3 n0, float pixel_angle, inout Sight sight, out float distance_, out float frame)
{
    const float infinite = intBitsToFloat(0x7f800000);
    // Without aberration directions are as in the world, and what moves there is seen as from there; D is the ship's own beside.
    float D_beside = ABERRATION ? 1.0 : sight.D, sky_D = sight.D;
    int count = int(layered.count.x);
    Part parts[MAX_LAYERS];
    for (int i = 0; i < count; ++i)
        parts[i] = part_of(i, n0, pixel_angle, D_beside);
    vec3 light = vec3(0.0);
    float left = 1.0, before = -1.0, most = 0.0;
    distance_ = infinite;
    frame = 0.0;
    for (int round = 0; round < count && left > 0.002; ++round) {
        int next = -1;
        float way = infinite;
        for (int i = 0; i < count; ++i)
            if (parts[i].way > before && parts[i].way < way)
                way = parts[i].way, next = i;
        if (next < 0)
            break;
        before = way;
        Part part = parts[next];
        vec4 numbers[MAX_GROUPS];
        cube_map(part.place, part.world_angle, numbers);
        light += left * light_of(numbers, part.D);
        if (left * part.covers > most) {
            most = left * part.covers;
            distance_ = way / (ABERRATION ? sky_D : 1.0);
            sight.D = part.D;
            frame = layered.layers[next].boost.w;
        }
        left *= 1.0 - part.covers;
    }
    vec4 sky[MAX_GROUPS];
    sky_at(sight.n, sky);
    return light + left * light_of(sky, sky_D);
}
