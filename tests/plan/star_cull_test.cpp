// Star culling: every star that an image of the plan holds is drawn, and most others are not.
#include "runtime/plan/star_cull.h"
#include "runtime/world/stars.h"
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <random>

namespace star_cull_test {

using namespace starbow;

namespace {

std::vector<shared::StarEntry> even_sky(int count)
{
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    std::vector<Star> stars;
    for (int i = 0; i < count; ++i)
        stars.push_back({glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))), 5, 5772});
    std::vector<shared::StarEntry> entries(stars.size());
    stars_from(star_field(stars, {"", 500, {0, 0}}, 1), {0, 0, 0}, entries);
    return entries;
}

glm::dmat3 view_matrix(double fov_deg, glm::ivec2 size)
{
    const double unit = 2 * std::tan(glm::radians(fov_deg) / 2) / size.x;
    return glm::dmat3(unit, 0, 0, 0, -unit, 0, -0.5 * unit * size.x, 0.5 * unit * size.y, -1);
}

} // namespace

TEST(StarCull, PatchesHoldAllStarsInOrder)
{
    for (int count : {1, 15, 5044, 100000}) {
        const auto stars = even_sky(count);
        std::uint32_t next = 0;
        for (const StarPatch& patch : star_patches(stars)) {
            ASSERT_EQ(patch.first, next);
            next += patch.count;
            for (std::uint32_t i = patch.first; i < next; ++i)
                ASSERT_LE(
                    glm::distance(glm::dvec3(stars[i].direction), patch.axis), 2 * std::sin(patch.radius_rad / 2) + 1e-6);
        }
        EXPECT_EQ(next, std::uint32_t(count));
    }
}

TEST(StarCull, KeepsTheStarsInViewAndFewOthers)
{
    const auto stars = even_sky(100000);
    const auto patches = star_patches(stars);
    const ConeHierarchy cones(view_matrix(70, {800, 600}), {800, 600});
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (double E : {1.0, 2.0, 8.0, 200.0})
        for (int i = 0; i < 10; ++i) {
            const glm::dmat3 turn
                = glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
            const glm::dmat3 motion_from_cockpit
                = glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
            const CubeMapPlan plan = plan_cube_map({{&cones, motion_from_cockpit}}, E, {});
            const auto runs = stars_in(plan.images, patches, turn);
            std::vector<bool> kept(stars.size());
            std::size_t sum = 0, in_view = 0;
            for (const StarRun& run : runs) {
                ASSERT_LE(run.first + run.count, stars.size());
                for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
                    ASSERT_FALSE(kept[k]) << "drawn twice";
                    kept[k] = true, ++sum;
                }
            }
            const double gamma = 0.5 * (E + 1 / E), u = 0.5 * (E - 1 / E);
            for (std::size_t k = 0; k < stars.size(); ++k) {
                // The ray's 4-vector, boosted along z and transformed into the view, a pinhole with this field.
                const glm::dvec3 n = turn * glm::dvec3(stars[k].direction);
                const glm::dvec3 seen
                    = glm::transpose(motion_from_cockpit) * glm::dvec3(n.x, n.y, gamma * n.z + u * glm::length(n));
                const double half = std::tan(glm::radians(35.0));
                if (seen.z < 0 && std::abs(seen.x / seen.z) < half && std::abs(seen.y / seen.z) < 0.75 * half) {
                    ASSERT_TRUE(kept[k]) << "E " << E << " star " << k;
                    ++in_view;
                }
            }
            // The images are rectangles on a cube's faces, the patches have a width, and glare reaches in over a margin of 128
            // texels, 11 degrees here. At greater speeds a pixel is many degrees wide.
            if (E <= 2) {
                EXPECT_LE(double(sum), 3 * double(in_view) + 0.18 * double(stars.size())) << "E " << E;
            }
            EXPECT_LT(runs.size(), 300u);
        }
}

} // namespace star_cull_test
