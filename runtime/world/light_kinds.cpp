#include "light_kinds.h"
#include "config/json/error.h"
#include "shaders/physics/physics.h"
#include "worldline.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

const std::optional<Emission>& emission_of(const Light& light)
{
    return std::visit([](const auto& l) -> const std::optional<Emission>& { return l.spectrum; }, light);
}

/// The range of D with which a lamp's light reaches surfaces that move against it.
struct Shift {
    double lowest = 1, highest = 1;
    bool even() const { return lowest == highest; }
};
std::optional<Shift> shift_of(const World& world, const SceneFile& scene, std::size_t light, std::size_t frame)
{
    std::optional<Shift> shift;
    for (const Lamp& lamp : world.lamps) {
        if (lamp.light != light || std::size_t(lamp.frame) == frame)
            continue;
        const RestFrame &here = world.frames[frame], &there = world.frames[std::size_t(lamp.frame)];
        if (const auto* far = std::get_if<DirectionalLight>(&scene.lights[light])) {
            double D;
            aberrated(here.u, far->towards, D);
            return Shift{D, D};
        }
        const double E = physics::exp_rapidity(glm::length(physics::relative(here.u, there.u).u));
        const double most = std::max(E, shift ? shift->highest : 1);
        shift = {1 / most, most};
    }
    return shift;
}

/// One light's kinds in one rest frame. New ones are added.
LampKinds lamp_kinds(const std::optional<Emission>& light, const std::optional<Shift>& shift, double per_octave,
    std::vector<LightKind>& kinds)
{
    LampKinds lamp;
    const auto at = std::find(kinds.begin(), kinds.end(), LightKind{light});
    lamp.kind = int(at - kinds.begin());
    if (at == kinds.end())
        kinds.push_back({light});
    if (!shift)
        return lamp;
    lamp.per_octave = per_octave;
    const int least = shift->even() ? 0 : int(std::floor(std::log2(shift->lowest) * per_octave));
    lamp.first_log2_D = shift->even() ? std::log2(shift->lowest) : least / per_octave;
    lamp.shifts = 1 - 2 * least;
    lamp.first_shift = int(kinds.size());
    for (int k = 0; k < lamp.shifts; ++k)
        kinds.push_back({light, shift->even() ? shift->lowest : std::exp2((least + k) / per_octave)});
    return lamp;
}

void reject_passing_lines(const World& world, const SceneFile& scene)
{
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        for (std::size_t frame = 0; frame < world.frames.size(); ++frame)
            if (const auto shift = shift_of(world, scene, i, frame);
                shift && !shift->even() && LightKind{emission_of(scene.lights[i])}.is_line())
                throw InputError(scene.file, "/lights/" + std::to_string(i),
                    "is a line, and it passes what does not move with it, at wavelengths that change; a "
                    "\"temperature_K\" or a \"spectrum\" is right there");
}

} // namespace

SpectralLine shifted_line(const LightKind& kind) { return {law_of(*kind.light).line_nm / kind.D}; }

Spectrum spectrum_of(const LightKind& kind)
{
    if (!kind.light)
        return [light = sunlit_white(), D = kind.D](double nm) { return light(nm * D); };
    return [law = law_of(*kind.light), D = kind.D](double nm) { return law.sunlit_part * law.spectrum(nm * D); };
}

LightKinds light_kinds(const World& world, const SceneFile& scene, int most)
{
    reject_passing_lines(world, scene);
    LightKinds all;
    // Between two shifts of a sixteenth of an octave light that falls as a black body's tail is straight within 0.5 %.
    for (double per_octave : {16.0, 8.0, 4.0, 2.0}) {
        all = {{LightKind{}}, {}};
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            all.lamps.emplace_back();
            for (std::size_t frame = 0; frame < world.frames.size(); ++frame)
                all.lamps[i].push_back(
                    lamp_kinds(emission_of(scene.lights[i]), shift_of(world, scene, i, frame), per_octave, all.kinds));
        }
        if (int(all.kinds.size()) <= most)
            break;
    }
    return all;
}

std::optional<std::size_t> passing_light(const World& world, const SceneFile& scene)
{
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        for (std::size_t frame = 0; frame < world.frames.size(); ++frame)
            if (shift_of(world, scene, i, frame))
                return i;
    return {};
}

} // namespace starbow
