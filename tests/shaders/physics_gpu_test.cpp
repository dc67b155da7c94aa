// The formulas of shaders/physics as the device computes them, compared with the same text compiled as float and as double.
// physics_test shows that the double build is right.
#include "config/model/angles.h"
#include "shaders/physics/physics.h"
#include "spirv/physics_probe_comp.h"
#include "tests/support/gpu_environment.h"
#include "tests/support/quad.h"
#include <cstring>
#include <random>

namespace starbow::gpu_test::physics_gpu_test {
namespace {

using glm::dvec4;
using glm::vec3;
using glm::vec4;
namespace pd = physics_double;
namespace pf = physics_float;

constexpr double round_float = 0x1p-24;

/// Runs physics_probe.comp on the device; that file describes the inputs and outputs.
std::vector<vec4> probe(const std::vector<vec4>& inputs, std::uint32_t mode, double E = 1)
{
    const std::uint32_t in = mode == 0 ? 1 : 4, out = mode == 0 ? 2 : 7;
    const std::uint32_t count = std::uint32_t(inputs.size()) / in;
    const vk::raii::Device& vk = device().device;
    Buffer from = make_mapped_buffer(device(), inputs.size() * sizeof(vec4), vk::BufferUsageFlagBits::eStorageBuffer);
    Buffer to = make_mapped_buffer(device(), count * out * sizeof(vec4), vk::BufferUsageFlagBits::eStorageBuffer);
    std::memcpy(from.mapped, inputs.data(), inputs.size() * sizeof(vec4));

    constexpr auto stage = vk::ShaderStageFlagBits::eCompute;
    constexpr auto storage = vk::DescriptorType::eStorageBuffer;
    vk::DescriptorSetLayoutBinding bindings[] = {{0, storage, 1, stage}, {1, storage, 1, stage}};
    auto set_layout = vk.createDescriptorSetLayout({{}, bindings});
    vk::PushConstantRange range(stage, 0, 16);
    auto layout = vk.createPipelineLayout({{}, *set_layout, range});
    auto shader = vk.createShaderModule({{}, sizeof physics_probe_comp, physics_probe_comp});
    auto pipeline = vk.createComputePipeline(nullptr, {{}, {{}, stage, *shader, "main"}, *layout});
    vk::DescriptorPoolSize size(storage, 2);
    auto pool = vk.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
    auto set = std::move(vk.allocateDescriptorSets({*pool, *set_layout}).front());
    vk::DescriptorBufferInfo infos[] = {{*from.buffer, 0, VK_WHOLE_SIZE}, {*to.buffer, 0, VK_WHOLE_SIZE}};
    vk.updateDescriptorSets({{*set, 0, 0, storage, {}, infos[0]}, {*set, 1, 0, storage, {}, infos[1]}}, {});

    struct {
        float E, inverse_E;
        std::uint32_t count, mode;
    } push = {float(E), float(1 / E), count, mode};
    device().now([&](vk::CommandBuffer commands) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, *set, {});
        commands.pushConstants(*layout, stage, 0, sizeof push, &push);
        commands.dispatch((count + 63) / 64, 1, 1);
        vk::MemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eComputeShader, vk::AccessFlagBits2::eShaderStorageWrite,
            vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
        commands.pipelineBarrier2(vk::DependencyInfo({}, barrier));
    });
    std::vector<vec4> outputs(count * out);
    std::memcpy(outputs.data(), to.mapped, outputs.size() * sizeof(vec4));
    return outputs;
}

// Directions everywhere: logarithmically close to both poles, the poles, the axes, and both zeros of z. They are unit
// vectors to a float's rounding.
std::vector<vec4> directions()
{
    std::vector<vec4> list = {{0, 0, 1, 0}, {0, 0, -1, 0}, {1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, -0.0f, 0}, {0, -1, 0, 0},
        {0.6f, 0.8f, 0, 0}, {0.6f, 0.8f, -0.0f, 0}, {-0.0f, -0.0f, -1, 0}};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> one(0, 1);
    for (int i = 0; i < 40000; ++i) {
        double phi = 2 * pi * one(random), z = 2 * one(random) - 1, across = std::sqrt((1 - z) * (1 + z));
        list.push_back(vec4(dvec3(across * std::cos(phi), across * std::sin(phi), z), 0));
        double theta = std::pow(1e-18, one(random)); // down to the smallest angle whose square a float holds
        list.push_back(vec4(
            dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), (i % 2 ? 1 : -1) * std::cos(theta)), 0));
    }
    return list;
}

double angle(const dvec3& a, const dvec3& b) { return quad::angle(quad::of(a), quad::of(b)); }

bool finite(const vec4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w); }

// Required accuracy. The 14 roundings of the computation (see physics_test) make 8e-7.
constexpr double required = 1e-6;

TEST(PhysicsOnTheDevice, AberrationAgreesWithFloatAndDoubleAtEveryGamma)
{
    const std::vector<vec4> inputs = directions();
    for (double gamma : {1.0, 1 + 1e-7, 2.0, 4.0, 10.0, 1e2, 1e3, 1e4, 1e6}) {
        const double E = pd::exp_rapidity(u_of_gamma(gamma));
        const std::vector<vec4> outputs = probe(inputs, 0, E);
        double direction = 0, D = 0, length = 0, float_direction = 0, float_D = 0, back = 0, back_D = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const vec3 n(inputs[i]);
            const vec4 world = outputs[2 * i], camera = outputs[2 * i + 1];
            ASSERT_TRUE(finite(world) && finite(camera)) << gamma << ' ' << n.x << ' ' << n.y << ' ' << n.z;
            const pd::AberratedRay expected = pd::world_from_camera(dvec3(n), E, 1 / E);
            const pf::AberratedRay same = pf::world_from_camera(n, float(E), float(1 / E));
            // A world direction's error appears in the camera 1/D times as large.
            direction = std::max(direction, angle(dvec3(world), expected.n) / expected.D);
            D = std::max(D, std::abs(world.w / expected.D - 1));
            length = std::max(length, std::abs(glm::length(dvec3(world)) - 1));
            float_direction = std::max(float_direction, angle(dvec3(world), dvec3(same.n)) / expected.D);
            float_D = std::max(float_D, std::abs(double(world.w) / same.D - 1));
            const pd::AberratedRay again = pd::camera_from_world(dvec3(world), E, 1 / E);
            back = std::max(back, angle(dvec3(camera), again.n));
            back_D = std::max(back_D, std::abs(camera.w / again.D - 1));
        }
        std::printf(
            "  gamma-1 %8.1e  to double: direction %.1e D %.1e length %.1e   to float: %.1e %.1e   back: %.1e %.1e\n",
            gamma - 1, direction, D, length, float_direction, float_D, back, back_D);
        for (double error : {direction, D, length, float_direction, float_D, back, back_D})
            EXPECT_LE(error, required) << gamma;
    }
}

TEST(PhysicsOnTheDevice, AtRestIsTheIdentityToTheBit)
{
    std::vector<vec4> inputs = directions();
    for (vec4& n : inputs)
        n.w = 0;
    const std::vector<vec4> outputs = probe(inputs, 0, 1);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        for (int k = 0; k < 2; ++k) {
            ASSERT_EQ(std::memcmp(&outputs[2 * i + k], &inputs[i], sizeof(vec3)), 0) << i;
            ASSERT_EQ(outputs[2 * i + k].w, 1.0f);
        }
}

TEST(PhysicsOnTheDevice, BoostsAndMotionAgreeWithDouble)
{
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> one(0, 1);
    auto somewhere = [&] {
        double phi = 2 * pi * one(random), z = 2 * one(random) - 1, across = std::sqrt((1 - z) * (1 + z));
        return dvec3(across * std::cos(phi), across * std::sin(phi), z);
    };
    std::vector<vec4> inputs;
    for (int i = 0; i < 20000; ++i) {
        dvec3 u = i == 0 ? dvec3(0) : somewhere() * std::pow(10.0, -6 + 10 * one(random));
        dvec3 w = i == 1 ? dvec3(0) : somewhere() * std::pow(10.0, -6 + 7 * one(random));
        double strength = i % 5 == 0 ? 0 : std::pow(10.0, -3 + 4 * one(random)) * (i % 2 ? 1 : -1);
        inputs.push_back(vec4(u, strength));
        inputs.push_back(vec4(somewhere(), 0.7 * one(random)));
        inputs.push_back(vec4(somewhere() * std::pow(10.0, -3 + 6 * one(random)), 4 * one(random) - 2));
        inputs.push_back(vec4(w, std::pow(10.0, -4 + 8 * one(random)))); // D^3 still fits a float
    }
    const std::vector<vec4> outputs = probe(inputs, 1);
    double segment = 0, composed = 0, turn = 0, eye = 0, event = 0, scalars = 0;
    auto worst = [](double& worst, double error) { worst = std::max(worst, error); };
    for (std::size_t i = 0; i < inputs.size() / 4; ++i) {
        const vec4 *in = &inputs[4 * i], *out = &outputs[7 * i];
        for (int k = 0; k < 7; ++k)
            ASSERT_TRUE(finite(out[k])) << i << ' ' << k;
        const dvec3 u(in[0]), way(in[1]), x(in[2]), w(in[3]);
        const double strength = in[0].w, dtau = in[1].w, t = in[2].w, D = in[3].w, angle = strength * dtau;
        const double gamma = pd::gamma_of(u), gamma_w = pd::gamma_of(w);
        const pd::ThrustSegment expected = pd::thrust_segment(u, way, strength, dtau);
        // Errors are relative to the size of the summands.
        const double reach = gamma * std::exp(std::abs(angle));
        worst(segment, glm::length(dvec3(out[0]) - expected.du) / reach);
        worst(segment, glm::length(dvec3(out[1]) - expected.dx) / reach);
        worst(segment, std::abs(out[0].w - expected.dt) / reach);
        worst(composed, glm::length(dvec3(out[2]) - pd::composed(u, w)) / (gamma * gamma_w));
        worst(turn, glm::length(dvec4(out[3]) - dvec4(pd::wigner_turn(u, w))) / std::min(gamma, gamma_w));
        worst(eye, glm::length(dvec3(out[4]) - pd::eye_place(u, x)) / (gamma * glm::length(x)));
        worst(eye, std::abs(out[4].w - pd::eye_time(u, x)) / (gamma * glm::length(x)));
        const double event_size = gamma * (std::abs(t) + glm::length(x));
        worst(event, std::abs(out[2].w - pd::world_time(u, t, x)) / event_size);
        worst(event, glm::length(dvec3(out[5]) - pd::world_place(u, t, x)) / event_size);
        auto scalar = [&](double got, double truth, double size) { worst(scalars, std::abs(got - truth) / size); };
        scalar(out[1].w, gamma, gamma);
        const double E = pd::exp_rapidity(glm::length(u));
        scalar(out[5].w, E, E);
        scalar(out[6].x, pd::headlight(D), pd::headlight(D));
        scalar(out[6].y, pd::unshifted_cosine(E), 1); // near rest the float E has lost E - 1
        scalar(out[6].z, pd::sinh_ratio(angle), pd::sinh_ratio(angle));
        scalar(out[6].w, pd::cosh_less_one_ratio(angle), pd::sinh_ratio(angle));
    }
    std::printf("  thrust segment %.1e  composed %.1e  turn %.1e  eye %.1e  event %.1e  scalars %.1e\n", segment, composed,
        turn, eye, event, scalars);
    EXPECT_LE(segment, 20 * round_float); // a dozen roundings as in physics_test, plus the device's sinh and square roots
    EXPECT_LE(composed, 12 * round_float);
    EXPECT_LE(eye, 12 * round_float);
    EXPECT_LE(event, 12 * round_float);
    EXPECT_LE(scalars, 20 * round_float);
    EXPECT_LE(turn, 2 * 12 * round_float); // boosts that nearly cancel lose up to twice the smaller gamma
}

} // namespace
} // namespace starbow::gpu_test::physics_gpu_test
