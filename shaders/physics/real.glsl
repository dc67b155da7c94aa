// The words of the dual-compiled formulas, for GLSL. physics.h has the same for C++.
#define real float
#define rvec2 vec2
#define rvec3 vec3
#define rvec4 vec4
#define FN
