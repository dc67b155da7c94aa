// The boxes around a world's resting things, against the whole world as it is drawn.
#include "config/model/shipped.h"
#include "runtime/world/ephemeris.h"
#include "runtime/world/stars.h"
#include "runtime/world/surroundings.h"
#include "runtime/world/world.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <set>

namespace surroundings_test {

using namespace starbow;

namespace {

/// True for an instance of one of the scene's bodies.
bool moves(const World& world, const SceneFile& scene, int node)
{
    for (; node >= 0; node = world.nodes[std::size_t(node)].parent)
        for (const Body& body : scene.bodies)
            for (const std::string& name : body.nodes)
                if (world.nodes[std::size_t(node)].name == name)
                    return true;
    return false;
}

} // namespace

TEST(SurroundingsTest, EveryRestingVertexIsInABoxAndEveryBoxHasOneOnEachSide)
{
    for (const std::string& name : shipped_names("scenes")) {
        SCOPED_TRACE(name);
        const SceneFile scene = load_scene_file(shipped_file("scenes", name));
        const std::vector<AlignedBox> things = things_at_rest(scene);
        EXPECT_LE(things.size(), most_things);
        EXPECT_FALSE(things.empty());
        const World world = load_world(scene);
        constexpr double rounding = 1e-4;
        std::vector<AlignedBox> touched(things.size(), {glm::dvec3(1e300), glm::dvec3(-1e300)});
        const auto touch = [&](const glm::dvec3& at) {
            bool inside = false;
            for (std::size_t k = 0; k < things.size(); ++k)
                if (glm::all(glm::greaterThan(at, things[k].low - rounding * (1.0 + glm::abs(at))))
                    && glm::all(glm::lessThan(at, things[k].high + rounding * (1.0 + glm::abs(at))))) {
                    inside = true;
                    touched[k].low = glm::min(touched[k].low, at), touched[k].high = glm::max(touched[k].high, at);
                }
            return inside;
        };
        for (const Instance& instance : world.instances) {
            if (instance.motion >= 0 || moves(world, scene, instance.node))
                continue;
            const Primitive& primitive = world.primitives[instance.primitive];
            for (std::uint32_t i = 0; i < primitive.index_count; i += 7) {
                const Vertex& vertex = world.vertices[std::size_t(
                    std::int64_t(world.indices[primitive.first_index + i]) + primitive.vertex_offset)];
                const glm::dvec3 at = instance.frame_from_local * glm::dvec4(glm::dvec3(vertex.position), 1);
                ASSERT_TRUE(touch(at)) << at.x << " " << at.y << " " << at.z;
            }
        }
        if (world.globes) { // whose places at the scene's time 0 are the ephemeris's
            const WorldOrigin origin = world_origin(world.globes->system, scene.globes.value());
            const std::vector<glm::dvec3> places = globe_places_m(world.globes->system, origin.days);
            for (std::size_t i = 0; i < places.size(); ++i)
                for (int axis = 0; axis < 6; ++axis) {
                    glm::dvec3 way(0);
                    way[axis % 3] = axis < 3 ? 1 : -1;
                    EXPECT_TRUE(touch((world_from_equatorial(scene.stars->ahead_deg) * (places[i] - origin.place_m)
                                          + way * world.globes->system.globes[i].radius_m)
                        / scene.unit_m));
                }
        }
        int loose = 0;
        for (std::size_t k = 0; k < things.size(); ++k)
            loose += glm::any(glm::lessThan(things[k].low, touched[k].low - 1.0 - 0.5 * (things[k].high - things[k].low)));
        EXPECT_LE(loose, int(things.size()) / 20) << "of " << things.size();
    }
}

TEST(SurroundingsTest, TheBodiesOfASceneAreLeftOut)
{
    const SceneFile scene = load_scene_file(shipped_file("scenes", "train"));
    SceneFile without = scene;
    without.bodies.clear();
    EXPECT_LT(things_at_rest(scene).size(), things_at_rest(without).size());
}

} // namespace surroundings_test
