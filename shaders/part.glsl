// The part that a view has of an output's pixel where viewports overlap (Shade::shares), for the exposure's samples.

layout(constant_id = 21) const bool LAYERED = false;

layout(set = 0, binding = 13) uniform sampler2D shares;

float part_of(ivec2 pixel) { return texelFetch(shares, pixel, 0).a; }
