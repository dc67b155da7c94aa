#version 460
// Runs every formula of physics/ on the device, for the tests to compare with the same formulas in double.
//
// Dispatch ceil(count / 64) groups of one dimension. Set 0, both buffers std430, tightly packed vec4:
//   binding 0 (read)     inputs
//   binding 1 (written)  outputs
// Push constants, 16 bytes: float E; float inverse_E; uint count; uint mode. E and inverse_E are used by mode 0 only.
//
// mode 0, a line of sight, in axes whose z is the motion. Per item 1 input and 2 outputs:
//   inputs[i]       n of the camera, unit; w unused
//   outputs[2i]     world_from_camera(n): n of the world; w = D
//   outputs[2i+1]   camera_from_world of that n of the world: n of the camera again; w = D again
//
// mode 1, boosts and motion. Per item 4 inputs and 7 outputs:
//   inputs[4i]      u, proper velocity;                      w = strength of the thrust
//   inputs[4i+1]    way of the thrust, unit;                 w = dtau
//   inputs[4i+2]    x, place in the moving frame;            w = t, time in the moving frame
//   inputs[4i+3]    w, proper velocity in the moving frame;  w = D for the headlight
//   outputs[7i]     thrust_leg du;                           w = dt
//   outputs[7i+1]   thrust_leg dx;                           w = gamma_of(u)
//   outputs[7i+2]   composed(u, w);                          w = world_time(u, t, x)
//   outputs[7i+3]   wigner_turn(u, w), quaternion x, y, z, w
//   outputs[7i+4]   eye_place(u, x);                         w = eye_time(u, x)
//   outputs[7i+5]   world_place(u, t, x);                    w = exp_rapidity(|u|)
//   outputs[7i+6]   x = headlight(D), y = unshifted_cosine(exp_rapidity(|u|)), z = sinh_ratio(strength dtau),
//                   w = cosh_less_one_ratio(strength dtau)
#extension GL_GOOGLE_include_directive : require
#include "physics/real.glsl"
#include "physics/boost.glsl"
#include "physics/aberration.glsl"
#include "physics/motion.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };
layout(push_constant) uniform Push
{
    float E;
    float inverse_E;
    uint count;
    uint mode;
};

void look(uint i)
{
    AberratedRay world = world_from_camera(inputs[i].xyz, E, inverse_E);
    AberratedRay camera = camera_from_world(world.n, E, inverse_E);
    outputs[2 * i] = vec4(world.n, world.D);
    outputs[2 * i + 1] = vec4(camera.n, camera.D);
}

void move(uint i)
{
    vec4 first = inputs[4 * i], second = inputs[4 * i + 1], third = inputs[4 * i + 2], fourth = inputs[4 * i + 3];
    vec3 u = first.xyz, x = third.xyz, w = fourth.xyz;
    ThrustSegment leg = thrust_segment(u, second.xyz, first.w, second.w);
    float E_of_u = exp_rapidity(length(u));
    float angle = first.w * second.w;
    uint o = 7 * i;
    outputs[o] = vec4(leg.du, leg.dt);
    outputs[o + 1] = vec4(leg.dx, gamma_of(u));
    outputs[o + 2] = vec4(composed(u, w), world_time(u, third.w, x));
    outputs[o + 3] = wigner_turn(u, w);
    outputs[o + 4] = vec4(eye_place(u, x), eye_time(u, x));
    outputs[o + 5] = vec4(world_place(u, third.w, x), E_of_u);
    outputs[o + 6] = vec4(headlight(fourth.w), unshifted_cosine(E_of_u), sinh_ratio(angle), cosh_less_one_ratio(angle));
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    if (mode == 0)
        look(i);
    else
        move(i);
}
