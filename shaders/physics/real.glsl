// GLSL's definitions of the dual-compiled formulas' words. physics.h has the C++ ones.
#define real float
#define rvec2 vec2
#define rvec3 vec3
#define rvec4 vec4
#define FN
