// The shipped panorama of the Milky Way against published figures, and refused ones.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "runtime/world/stars.h"
#include "runtime/world/world.h"
#include "tests/support/files.h"
#include "tests/support/warp_fixture.h"

namespace starbow::milky_way_test {
namespace {

using namespace starbow::testing;

/// The shipped panorama as surface brightness, S10(V): stars of tenth magnitude in each square degree. in_depth: number of
/// the catalogue's stars that are not painted onto it.
struct Sky {
    glm::ivec2 size;
    std::vector<double> s10;

    explicit Sky(std::size_t in_depth)
    {
        SceneFile scene = load_scene_file(source_dir() / "config/scenes/avenue.json");
        scene.stars->in_depth = in_depth;
        const World world = load_world(scene);
        const Texture& picture = world.textures.at(std::size_t(world.milky_way));
        size = picture.size;
        const double white = scene.stars->milky_way->peak_arcmin2 * 3600 * 1e4;
        const auto linear = [](std::uint8_t byte) { // IEC 61966-2-1
            const double x = byte / 255.0;
            return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
        };
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            s10.push_back(white
                * (0.2126 * linear(picture.rgba[i]) + 0.7152 * linear(picture.rgba[i + 1])
                    + 0.0722 * linear(picture.rgba[i + 2])));
    }
    glm::dvec3 direction(int x, int y) const { return equatorial((x + 0.5) / size.x * 360, 90 - (y + 0.5) / size.y * 180); }
    /// Calls each(direction, brightness, solid angle) for all pixels.
    template <class Each> void each(Each&& each) const
    {
        for (int y = 0; y < size.y; ++y) {
            const double solid = 2 * pi / size.x * pi / size.y * std::sin((y + 0.5) / size.y * pi);
            for (int x = 0; x < size.x; ++x)
                each(direction(x, y), s10[std::size_t(y) * std::size_t(size.x) + std::size_t(x)], solid);
        }
    }
    /// The mean within so many degrees of a place.
    double around(const glm::dvec3& place, double degrees) const
    {
        double sum = 0, solid = 0;
        each([&](const glm::dvec3& n, double light, double part) {
            if (glm::dot(n, place) > std::cos(degrees * degree))
                sum += light * part, solid += part;
        });
        return sum / solid;
    }
};

/// The Milky Way alone.
const Sky& sky()
{
    static const Sky alone(4'000'000);
    return alone;
}

/// A place of galactic longitude and latitude: the pole is at 192.85948, +27.12825, and the pole's position angle of the
/// celestial one at 122.93192 degrees of longitude (Hipparcos catalogue, ESA SP-1200, section 1.5.3).
glm::dvec3 galactic(double l_deg, double b_deg)
{
    const double b = b_deg * degree, pole = 27.12825 * degree, turn = (122.93192 - l_deg) * degree;
    const double sine = std::sin(b) * std::sin(pole) + std::cos(b) * std::cos(pole) * std::cos(turn);
    const double ra = 192.85948 * degree
        + std::atan2(
            std::cos(b) * std::sin(turn), std::sin(b) * std::cos(pole) - std::cos(b) * std::sin(pole) * std::cos(turn));
    return equatorial(ra / degree, std::asin(sine) / degree);
}

// Leinert et al. 1998, A&AS 127, 1, table 35 (Pioneer 10, 440 nm), brought to V by B-V 0.80, and 2.9 for the stars between
// the 5,000th's magnitude, 6, and Pioneer's 6.5. The bound is 10 %, Pioneer's own accuracy.
TEST(MilkyWay, ItsBrightnessWithTheFaintStarsIsThatOfPioneer10)
{
    const Sky sky(5000);
    const double to_v = std::pow(10, 0.4 * (0.80 - 0.65));
    double sum = 0, solid = 0, high = 0, high_solid = 0;
    const glm::dvec3 pole = galactic(0, 90);
    sky.each([&](const glm::dvec3& n, double light, double part) {
        sum += light * part, solid += part;
        if (std::abs(glm::dot(n, pole)) > std::sin(75 * degree))
            high += light * part, high_solid += part;
    });
    EXPECT_NEAR(solid, 4 * pi, 1e-5);
    EXPECT_NEAR(sum / solid, 97.6 * to_v + 2.9, 0.1 * 115);
    EXPECT_NEAR(high / high_solid, 29.3 * to_v + 2.9, 0.1 * 37); // the darkest
    // The brightest, in Pioneer's beam of 2.3 degrees. Bulge and Carina have B-V of 1.0 and 0.7.
    EXPECT_NEAR(sky.around(galactic(0, -4), 1.15), 569 * std::pow(10, 0.4 * (1.0 - 0.65)), 0.1 * 785);
    EXPECT_NEAR(sky.around(galactic(290, 0), 1.15), 634 * std::pow(10, 0.4 * (0.7 - 0.65)), 0.1 * 664);
}

// Places of the catalogues (J2000).
TEST(MilkyWay, ItsGalaxiesAndNebulaeAreInTheirPlaces)
{
    struct Landmark {
        const char* name;
        glm::dvec3 place;
        double reach_deg, off_deg; ///< of its light; of its centroid at most
        bool stars = false; ///< it consists of the catalogue's stars
    };
    const Sky with_stars(5000);
    // The Magellanic Clouds are lopsided: the Large one's bar lies half a degree beside the middle of its light.
    for (const Landmark& one : {Landmark{"M31", equatorial(10.6847, 41.2688), 1.5, 0.1},
             {"M42", equatorial(83.822, -5.391), 0.7, 0.1}, {"eta Carinae", equatorial(161.265, -59.684), 0.4, 0.15},
             {"omega Centauri", equatorial(201.697, -47.480), 0.7, 0.1},
             {"47 Tucanae", equatorial(6.024, -72.081), 0.7, 0.1}, {"M6", equatorial(265.083, -32.253), 0.5, 0.15, true},
             {"Large Magellanic Cloud", equatorial(80.894, -69.756), 5, 0.6},
             {"Small Magellanic Cloud", equatorial(13.187, -72.829), 3, 0.3}}) {
        // Only what stands out of the surroundings counts.
        const Sky& where = one.stars ? with_stars : sky();
        std::vector<double> ring;
        where.each([&](const glm::dvec3& n, double light, double) {
            const double off = std::acos(std::clamp(glm::dot(n, one.place), -1.0, 1.0)) / degree;
            if (off > one.reach_deg && off < 1.4 * one.reach_deg)
                ring.push_back(light);
        });
        std::sort(ring.begin(), ring.end());
        const double beside = ring[ring.size() / 2];
        glm::dvec3 centroid(0);
        where.each([&](const glm::dvec3& n, double light, double part) {
            if (glm::dot(n, one.place) > std::cos(one.reach_deg * degree))
                centroid += std::max(light - 1.15 * beside, 0.0) * part * n;
        });
        ASSERT_GT(glm::length(centroid), 0) << one.name;
        const double off = std::acos(std::min(1.0, glm::dot(glm::normalize(centroid), one.place))) / degree;
        std::printf("%s: %.3f degrees\n", one.name, off);
        EXPECT_LT(off, one.off_deg) << one.name;
    }
}

TEST(MilkyWay, ItsEdgesMeetAndItsPolesAreSmooth)
{
    const Sky& all = sky();
    const auto at = [&](int x, int y) { return all.s10[std::size_t(y) * std::size_t(all.size.x) + std::size_t(x)]; };
    double seam = 0, within = 0;
    for (int y = 0; y < all.size.y; ++y) {
        seam += std::abs(at(0, y) - at(all.size.x - 1, y));
        within += std::abs(at(1000, y) - at(999, y)) + std::abs(at(300, y) - at(299, y));
    }
    EXPECT_LT(seam, 1.5 * within);
    for (const int y : {0, all.size.y - 1}) {
        const auto row = all.s10.begin() + std::ptrdiff_t(y) * all.size.x;
        const auto [low, high] = std::minmax_element(row, row + all.size.x);
        EXPECT_LT(*high, 1.1 * *low);
    }
}

TEST(MilkyWay, AWrongPanoramaIsRefused)
{
    const auto scene = [](const std::string& picture) {
        return load_scene_file(write_text("sky.json",
            "{ \"gltf\": \"" + (source_dir() / "scenes/clocks/clocks.glb").string()
                + "\", \"stars\": { \"catalogue\": \"a.txt\", \"milky_way\": { \"panorama\": \"" + picture
                + "\", \"peak_arcmin2\": 1 } } }"));
    };
    const auto wrong = [&](const std::string& picture) { return complaint([&] { load_world(scene(picture)); }); };
    EXPECT_NE(wrong("missing.png").find("missing.png: does not exist; a PNG or JPEG of the whole sky"), std::string::npos)
        << wrong("missing.png");
    write_text("text.png", "no picture");
    EXPECT_NE(wrong("text.png").find("text.png: is neither PNG, JPEG nor WebP; one of those is right"), std::string::npos)
        << wrong("text.png");
    write_text("square.png", warp_test::png(4, 4, 3, std::vector<unsigned char>(48, 9)));
    EXPECT_NE(wrong("square.png")
                  .find("square.png: has 4 x 4 pixels; a PNG or JPEG of the whole sky, twice as wide as high, is right"),
        std::string::npos)
        << wrong("square.png");
    write_text("right.png", warp_test::png(4, 2, 3, std::vector<unsigned char>(24, 9)));
    EXPECT_EQ(load_world(scene("right.png")).textures.back().size, glm::ivec2(4, 2));
}

} // namespace
} // namespace starbow::milky_way_test
