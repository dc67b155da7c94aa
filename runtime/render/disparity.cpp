#include "disparity.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// One pixel of an EXR's channels.
struct RetardedPosition {
    glm::dvec3 camera, world;
    double D, depth;

    RetardedPosition(const Channels& c, std::size_t i)
        : camera(c[3].second[i], c[4].second[i], c[5].second[i])
        , world(c[6].second[i], c[7].second[i], c[8].second[i])
        , D(c[9].second[i])
        , depth(c[10].second[i])
    {
    }
};

double part(std::vector<double>& values, double share)
{
    if (values.empty())
        return 0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace

glm::dvec3 eye_beside(const Stereo& stereo, Eye eye, const glm::dvec3& n)
{
    const double half = 0.5 * stereo.separation_m * (eye == Eye::left ? -1 : eye == Eye::right ? 1 : 0);
    if (!stereo.turning)
        return {half, 0, 0};
    const glm::dvec3 right = glm::cross(n, glm::dvec3(0, 1, 0)); // as long as the sine of the angle from the zenith
    return right * (half / std::max(glm::length(right), std::sin(glm::radians(stereo.full_from_zenith_deg))));
}

Disparity disparity(
    OffscreenRenderer& tested, OffscreenRenderer* exact, const Shot& shot, std::size_t output, const SceneFile& scene)
{
    const Layout& layout = tested.layout();
    const glm::ivec2 size = layout.outputs[output].size;
    const Channels numbers = tested.numbers(shot, output), truth = exact ? exact->numbers(shot, output) : Channels();
    const double scale = layout.stereo.units_per_m(scene.unit_m, scene.light_speed_m_s),
                 E = physics::exp_rapidity(glm::length(shot.u));
    const glm::dmat3 to_motion = motion_from_world(shot.u, shot.ship_from_cockpit);
    std::vector<double> errors;
    long hidden = 0;
    MapStore store;
    for (const CompiledView& compiled : compile_output(store, layout, output, size)) {
        const View& view = compiled.view;
        if (view.canvas > 0)
            continue;
        const glm::dvec3 drawn_from = layout.stereo.method == StereoMethod::exact ? view.picture.eye_m : view.head_m;
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x) {
                const std::size_t i = std::size_t(y + view.corner.y) * size.x + x + view.corner.x;
                const RetardedPosition seen(numbers, i);
                if (!std::isfinite(seen.depth) || std::isnan(seen.D))
                    continue;
                // The shown point relative to the eye. Both places are in the world at rest and simultaneous in the ship.
                const glm::dvec3 n = glm::inverse(shot.ship_from_cockpit) * seen.camera;
                const glm::dvec3 eye = view.head_m + eye_beside(layout.stereo, view.eye, n);
                const glm::dvec3 apart = physics::eye_place(shot.u, shot.ship_from_cockpit * ((eye - drawn_from) * scale));
                const glm::dvec3 point = seen.depth * seen.world - apart;
                glm::dvec3 wanted = seen.camera;
                if (shot.effects[Effect::aberration])
                    wanted = glm::transpose(to_motion) * physics::world_from_camera(to_motion * seen.camera, E, 1 / E).n;
                const double off = std::atan2(glm::length(glm::cross(point, wanted)), glm::dot(point, wanted));
                const double pixel
                    = compiled.map ? compiled.map->at(x, y).w : pixel_angle(view.picture, glm::dvec2(x, y) + 0.5);
                errors.push_back(off / (pixel * (shot.effects[Effect::aberration] ? seen.D : 1)));
                if (exact)
                    hidden += std::abs(glm::length(point) / RetardedPosition(truth, i).depth - 1) > 0.02;
            }
    }
    Disparity result;
    result.hidden = errors.empty() ? 0 : double(hidden) / double(errors.size());
    result.median = part(errors, 0.5);
    result.high = part(errors, 0.99);
    result.most = part(errors, 1);
    return result;
}

} // namespace starbow
