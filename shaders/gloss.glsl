// The reflection of a glossy surface by glTF's metallic-roughness model (glTF 2.0, appendix B): microfacets whose slopes
// GGX distributes, height-correlated shadowing by Smith, Fresnel's reflection by Schlick. All light is over that of a matt
// white surface that faces its source, so the model's densities are multiplied by pi.

#include "constants.h"

GLOSS_CONSTANTS(DECLARED)

layout(set = 1, binding = 2) uniform sampler2D roughness_texture; // green: roughness, blue: metallic
layout(set = 1, binding = 3) uniform sampler2D normal_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture; // red
layout(set = 1, binding = 5) uniform sampler2D gloss_table; // gloss.h
layout(set = 1, binding = 6) uniform Surface { MaterialEntry surface; };

layout(location = 5) in vec4 uvs; // two of the file's sets
layout(location = 6) in vec4 tangent; // w: the bitangent's sense

vec2 coordinates(MapEntry map)
{
    vec2 set = mix(uvs.xy, uvs.zw, map.u.z);
    return vec2(dot(map.u.xy, set) + map.u.w, dot(map.v.xy, set) + map.v.w);
}

// A surface where a ray meets it.
struct Glossy {
    vec3 n; // unit normal
    vec3 towards_eye; // unit
    float facing; // of the eye
    float metallic, roughness, occlusion;
};

// The parts of some light that a surface sends to the eye: by its base colour, and as white.
struct Reflected {
    vec3 by_base, white;
};

// n: the unit normal of the triangle's side that is seen.
Glossy glossy_at(vec3 place, vec3 n, bool front)
{
    Glossy at;
    at.n = n;
    at.metallic = surface.gloss.x;
    at.roughness = surface.gloss.y;
    at.occlusion = 1.0;
    if (ROUGHNESS_MAP) {
        vec2 map = texture(roughness_texture, coordinates(surface.metallic_roughness)).gb;
        at.roughness *= map.x;
        at.metallic *= map.y;
    }
    if (OCCLUSION_MAP)
        at.occlusion += surface.gloss.w * (texture(occlusion_texture, coordinates(surface.occlusion)).r - 1.0);
    float spread = 0.0;
    if (NORMAL_MAP) {
        vec3 map = texture(normal_texture, coordinates(surface.normal)).rgb * (255.0 / 127.0) - (128.0 / 127.0);
        // A mean of several normals is shorter than one: their spread makes the surface rougher (Toksvig 2005). Eight bits
        // make one shorter by less than a hundredth.
        float size = length(map);
        spread = max(1.0 / max(size, 0.1) - 1.01, 0.0);
        map.xy *= surface.gloss.z;
        // On a back side all three axes are turned round (glTF 2.0, section 3.9.7).
        float side = front ? 1.0 : -1.0;
        vec3 along = side * (tangent.xyz - n * dot(n, tangent.xyz));
        float length_ = length(along);
        if (length_ > 0.0) {
            along /= length_;
            at.n = normalize(along * map.x + cross(n, along) * (side * tangent.w * map.y) + n * map.z);
        }
    }
    at.roughness = max(at.roughness, LEAST_ROUGHNESS);
    if (NORMAL_MAP) { // the variance of the slopes is half the square of GGX's width
        float width = at.roughness * at.roughness;
        at.roughness = sqrt(min(sqrt(width * width + 2.0 * spread), 1.0));
    }
    at.towards_eye = -normalize(place);
    at.facing = max(dot(at.n, at.towards_eye), 1e-3);
    return at;
}

float fifth_power(float x) { return x * x * x * x * x; }

// A lamp's light of which a matt surface reflects `facing`, the cosine of its angle to the normal. towards: unit.
// Returns the parts by base colour and white.
vec2 reflected_lamp(Glossy at, vec3 towards, float facing)
{
    if (MATT)
        return vec2(facing, 0.0);
    vec3 sum = at.towards_eye + towards;
    float length_ = max(length(sum), 1e-6);
    vec3 h = sum / length_;
    float width = at.roughness * at.roughness, square = width * width;
    // 1 - dot(n, h)^2 without cancellation.
    vec3 across = cross(at.n, h);
    float d = dot(across, across) * (1.0 - square) + square;
    float density = square / (d * d); // times pi
    float shadowing = 0.5 / (facing * sqrt(at.facing * at.facing * (1.0 - square) + square) + at.facing * sqrt(facing * facing * (1.0 - square) + square));
    float mirror = dot(at.n, h) > 0.0 ? density * shadowing * facing : 0.0;
    float grazing = fifth_power(clamp(1.0 - 0.5 * length_, 0.0, 1.0)); // half the sum's length is dot(h, towards)
    float fresnel = mix(surface.dielectric.x, 1.0, grazing);
    return vec2((1.0 - at.metallic) * (1.0 - fresnel) * facing + at.metallic * (1.0 - grazing) * mirror,
        ((1.0 - at.metallic) * fresnel + at.metallic * grazing) * mirror);
}

// The light from all around: on matt surfaces the ambient light; reflected, the sky's gradient. The table's lookups are
// gloss.h's.
Reflected reflected_surroundings(Glossy at, vec3 up, vec3 ambient, vec4 around[3])
{
    ambient *= at.occlusion;
    if (MATT)
        return Reflected(ambient, vec3(0.0));
    vec2 first = vec2(0.5 / float(GLOSS_TABLE)), part = vec2(float(GLOSS_TABLE - 1) / float(GLOSS_TABLE));
    float row = at.roughness;
    vec4 mirror = textureLod(gloss_table, first + part * vec2(at.facing, row), 0.0);
    // A rough surface's light comes from nearer to its normal than the mirror's (Lagarde and de Rousiers 2014, 4.9.3).
    float smooth_ = 1.0 - row;
    float height = dot(normalize(mix(at.n, reflect(-at.towards_eye, at.n), smooth_ * (sqrt(smooth_) + row))), up);
    float above = textureLod(gloss_table, first + part * vec2(0.5 + 0.5 * height, row), 0.0).b;
    float below = textureLod(gloss_table, first + part * vec2(0.5 - 0.5 * height, row), 0.0).b;
    vec3 seen = at.occlusion * (around[0] * above + around[2] * below + around[1] * (1.0 - above - below)).rgb;
    float dielectric = surface.dielectric.x * mirror.x + mirror.y;
    return Reflected((1.0 - at.metallic) * (1.0 - surface.dielectric.x) * (1.0 - mirror.a) * ambient + at.metallic * mirror.x * seen,
        ((1.0 - at.metallic) * dielectric + at.metallic * mirror.y) * seen);
}
