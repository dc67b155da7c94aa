#include "lamp.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {

shared::LightEntry light_entry(const GpuWorld& world, const Lamp& lamp, const EyeEvent& eye_event, double scale)
{
    const RestFrame& here = world.world.frames[std::size_t(eye_event.frame)];
    const RestFrame& there = world.world.frames[std::size_t(lamp.frame)];
    const Light& light = world.scene.lights[lamp.light];
    const LampKinds& spectra = world.spectra.lamps[lamp.light][std::size_t(eye_event.frame)];
    const bool moves = lamp.frame != eye_event.frame;
    constexpr float never = 1e30f;
    shared::LightEntry entry{};
    entry.kind = glm::vec4(moves ? spectra.first_shift : spectra.kind, -never, never, 1);
    if (moves)
        entry.shifts = glm::vec4(spectra.first_log2_D, spectra.per_octave, spectra.shifts, 1);
    if (const auto* far = std::get_if<DirectionalLight>(&light)) {
        double D = 1;
        const glm::dvec3 towards = moves ? aberrated(here.u, far->towards, D) : far->towards;
        entry.place = glm::vec4(eye_event.cube_from_frame * towards, 0);
        entry.radiance = glm::vec4(far->radiance * scale, 0);
        entry.kind.w = float(D);
        return entry;
    }
    const PointLight& point = std::get<PointLight>(light);
    entry.radiance = glm::vec4(point.radiance * scale, point.distance * point.distance);
    glm::dmat3 cube_from_lamp = eye_event.cube_from_frame; // of directions in the lamp's own axes
    // The lamp's place at the eye's time, and the lamp's proper time then.
    glm::dvec3 place = lamp.position;
    double own = eye_event.time;
    if (moves) {
        // The lamp's worldline in the eye event's rest frame: a lamp at rest at `position` there moves with proper
        // velocity u here.
        const physics::Relative relative = physics::relative(here.u, there.u);
        // The event at the lamp's proper time 0.
        const Event at_world{there.origin.time + physics::world_time(there.u, 0, lamp.position),
            there.origin.position + physics::world_place(there.u, 0, lamp.position)};
        const Event at = in_frame(here, at_world);
        const double gamma = physics::gamma_of(relative.u), u = glm::length(relative.u);
        const glm::dvec3 v = relative.u / gamma;
        cube_from_lamp = cube_from_lamp * glm::mat3_cast(quaternion(relative.turn));
        place = at.position + v * (eye_event.time - at.time);
        own = (eye_event.time - at.time) / gamma;
        entry.way = glm::vec4(eye_event.cube_from_frame * (relative.u / u), u);
        entry.shifts.w = float(gamma);
    }
    entry.place = glm::vec4(eye_event.cube_from_frame * (place - eye_event.place), 0);
    if (point.cone) {
        entry.cone = glm::vec4(cube_from_lamp * point.cone->axis, 0);
        const double outer = std::cos(point.cone->outer_rad), inner = std::cos(point.cone->inner_rad);
        entry.edge.x = float(1 / std::max(inner - outer, 1e-3)); // as glTF's formula, whose edge is never sharper
        entry.edge.y = float(-outer / std::max(inner - outer, 1e-3));
    }
    if (lamp.existence >= 0) {
        const ExistenceInterval& existence = world.world.existence_intervals[std::size_t(lamp.existence)];
        entry.kind.y = float(std::clamp(existence.begin - own, -1e30, 1e30));
        entry.kind.z = float(std::clamp(existence.end - own, -1e30, 1e30));
    }
    return entry;
}

} // namespace starbow
