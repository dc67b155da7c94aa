#include "globes.h"
#include "config/model/angles.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Straight between the points, level beyond them.
double straight(const std::vector<std::pair<double, double>>& points, double nm)
{
    const auto after
        = std::upper_bound(points.begin(), points.end(), nm, [](double at, const auto& p) { return at < p.first; });
    if (after == points.begin())
        return points.front().second;
    if (after == points.end())
        return points.back().second;
    const auto before = after - 1;
    return before->second + (after->second - before->second) * (nm - before->first) / (after->first - before->first);
}

/// A lamp sends nothing beyond its table.
double lamp(const std::vector<std::pair<double, double>>& points, double nm)
{
    return nm < points.front().first || nm > points.back().first ? 0 : straight(points, nm);
}

double smooth_step(double from, double to, double at)
{
    const double x = std::clamp((at - from) / (to - from), 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

/// The nodes and weights of Gauss and Legendre on 0 to 1.
struct Quadrature {
    std::vector<double> at, weight;
    explicit Quadrature(int count)
    {
        for (int i = 0; i < count; ++i) {
            double x = std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1;
            for (int round = 0; round < 50; ++round) {
                double p = 1, before = 0;
                for (int k = 1; k <= count; ++k)
                    before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
                slope = count * (x * p - before) / (x * x - 1);
                x -= p / slope;
            }
            at.push_back(0.5 * (1 + x));
            weight.push_back(1 / ((1 - x * x) * slope * slope));
        }
    }
};

constexpr double top_heights = 10; // of the air, in scale heights
constexpr int air_steps = 256;

/// Air with the density exp(-h / H) around a ball.
struct AirAround {
    double radius, height; ///< of the ground, and the scale height

    double top() const { return radius + top_heights * height; }

    /// The air on a straight way from a distance r from the middle, whose direction has the cosine `up` from the vertical,
    /// out to the top, over the vertical column. The way must not meet the ground.
    double outward(double r, double up) const
    {
        static const Quadrature nodes(32);
        const double lowest_square = r * r * (1 - up * up); // the way's least distance, squared
        const auto stretch = [&](double from, double to) { // along the way from its lowest point
            double sum = 0;
            for (std::size_t i = 0; i < nodes.at.size(); ++i) {
                const double along = from + (to - from) * nodes.at[i];
                sum += nodes.weight[i] * std::exp(-(std::sqrt(lowest_square + along * along) - radius) / height);
            }
            return sum * (to - from) / height;
        };
        const double here = r * up, out = std::sqrt(std::max(top() * top() - lowest_square, 0.0));
        if (here >= out)
            return 0;
        return here >= 0 ? stretch(here, out) : stretch(0, std::min(-here, out)) + stretch(0, out);
    }
};

/// Bilinear texels of an equirectangular map around an own unit direction, as fractions. rooted: a channel that holds roots;
/// its squares are interpolated.
glm::dvec4 texel(const Texture& map, const glm::dvec3& normal, int rooted = -1)
{
    const double longitude = std::atan2(normal.y, normal.x), latitude = std::atan2(normal.z, std::hypot(normal.x, normal.y));
    const double x = (longitude / (2 * pi) + 0.5) * map.size.x - 0.5, y = (0.5 - latitude / pi) * map.size.y - 0.5;
    const double left = std::floor(x), above = std::floor(y);
    glm::dvec4 sum(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int column = ((int(left) + i) % map.size.x + map.size.x) % map.size.x;
            const int row = std::clamp(int(above) + j, 0, map.size.y - 1);
            const std::size_t at = 4 * (std::size_t(row) * std::size_t(map.size.x) + std::size_t(column));
            const double part = (i ? x - left : 1 - (x - left)) * (j ? y - above : 1 - (y - above));
            for (int c = 0; c < 4; ++c) {
                const double value = map.rgba[at + std::size_t(c)] / 255.0;
                sum[c] += part * (c == rooted ? value * value : value);
            }
        }
    return sum;
}

/// The share of light that stays, by a dusty globe's measured phase curve over Lommel and Seeliger's.
double dimming_of(const Globe& globe, double phase_deg)
{
    const double at = std::min(phase_deg, 160.0), half = 0.5 * at * degree;
    const double disc = at > 0 ? 1 + std::sin(half) * std::tan(half) * std::log(std::tan(0.5 * half)) : 1;
    return std::pow(10, -0.4 * (globe.dimming_per_deg * at + globe.dimming_per_deg4 * std::pow(at, 4))) / disc;
}

/// A ring's optical depth along its normal and twice its reflectivity.
glm::dvec2 ring_at(const PlanetRing& ring, double radius)
{
    if (radius < ring.inner_m || radius > ring.outer_m)
        return glm::dvec2(0);
    const double count = double(ring.profile.size());
    const double at = std::clamp((radius - ring.inner_m) / (ring.outer_m - ring.inner_m) * count - 0.5, 0.0, count - 1);
    const std::size_t i = std::min(std::size_t(at), ring.profile.size() - 2);
    return glm::mix(ring.profile[i], ring.profile[i + 1], at - double(i));
}

constexpr double lamps_depth = 0.0973; // of the air in lamplight

/// The ground and the sky above it where a map is coarser than a pixel: docs/physics/solar-system.md, detail.
struct Detailed {
    glm::dvec4 parts; ///< of the kinds of ground
    double clouds, lamps, wind = 7;
    double land_sun, cloud_sun;

    /// sky: clouds and lamps. octaves: of noise that a pixel shows.
    Detailed(const glm::dvec3& normal, const glm::dvec3& to_sun, int rows, const glm::dvec4& map, const glm::dvec2& sky,
        double octaves)
        : parts(map)
        , clouds(sky.x)
        , lamps(sky.y)
    {
        const double cosine = glm::dot(normal, to_sun);
        land_sun = cloud_sun = std::max(cosine, 0.0);
        if (octaves <= 0)
            return;
        const double cells = rows / pi;
        const glm::dvec3 place = normal * cells, sunward = to_sun - normal * cosine;
        const physics::Detail here = physics::detail_at(place, sunward, octaves);
        const double field = here.value.y;
        clouds = physics::detail_cover(sky.x, here.value.x, here.variance.x);
        parts.w = physics::detail_cover(map.w, field, here.variance.y);
        const double land = (1 - parts.w) / std::max(1 - map.w, 1e-3) * std::max(1 + 0.3 * field, 0.2);
        for (int k = 0; k < 3; ++k)
            parts[k] *= land;
        wind *= std::clamp(1 + 0.5 * field, 0.2, 1.8);
        lamps *= physics::detail_spots(field, here.variance.y, 1.2);
        land_sun = std::max(cosine - physics::detail_slope(here.slope.y, 5e-5 * cells), 0.0);
        cloud_sun = std::max(cosine - physics::detail_slope(here.slope.x, 3.2e-5 * cells), 0.0);
    }
};

} // namespace

GlobeColours::GlobeColours(const Globes& globes, const StandardObserver& observer)
    : globes_(globes)
    , observer_(observer)
    , sun_(std::pow(astronomical_unit_m / globes.system.globes.front().radius_m, 2))
    , first_light_(first_kind + int(globes.system.kinds.size()))
    , coarse_(observer)
{
    if (&observer == &eye()) {
        coarse_.samples.clear();
        for (std::size_t i = 0; i < observer.samples.size(); i += 5) {
            coarse_.samples.push_back(observer.samples[i]);
            coarse_.samples.back().width_nm *= 5;
        }
    }
    for (const NamedTable& one : globes.system.lights) {
        const int index = light(one.name);
        lights_.push_back(1);
        const double luminance = starbow::seen(
            eye(), [&](double nm) { return spectrum(index, nm); }, 1)
                                     .y;
        lights_.back() = 1 / luminance;
    }
    for (int i = 0; i < first_light_ + int(lights_.size()); ++i)
        seen_.push_back(std::make_unique<ByShift>(
            1,
            [this, i](double D, glm::dvec3* out) {
                *out = observer_.rec709
                    * starbow::seen(
                        observer_, [this, i](double nm) { return spectrum(i, nm); }, D);
            },
            i < first_light_));
}

/// first plus a table's place in the list; -1 for an empty name.
static int numbered(int first, const std::vector<NamedTable>& tables, const std::string& name)
{
    const auto at = std::find_if(tables.begin(), tables.end(), [&](const NamedTable& one) { return one.name == name; });
    return at == tables.end() ? -1 : first + int(at - tables.begin());
}
int GlobeColours::kind(const std::string& name) const { return numbered(first_kind, globes_.system.kinds, name); }
int GlobeColours::light(const std::string& name) const { return numbered(first_light_, globes_.system.lights, name); }

double GlobeColours::optical_depth(double nm)
{
    constexpr double shortest_um = 0.25;
    const double um = std::max(nm / 1000, shortest_um), square = um * um;
    const double depth = 0.0021520 * (1.0455996 - 341.29061 / square - 0.90230850 * square)
        / (1 + 0.0027059889 / square - 85.968563 * square);
    return depth * std::pow(std::min(nm / 1000 / shortest_um, 1.0), -4);
}

namespace {

/// The powers of the Sun's limb darkening at a wavelength; of an even disc where the file has none.
std::array<double, 6> limb_at(const SolarSystem& system, double nm)
{
    const std::vector<LimbDarkening>& limb = system.limb;
    if (limb.empty())
        return {1};
    auto after
        = std::upper_bound(limb.begin(), limb.end(), nm, [](double at, const LimbDarkening& one) { return at < one.nm; });
    const auto before = after == limb.begin() ? after : after - 1;
    after = after == limb.end() ? after - 1 : after;
    const double part = after->nm > before->nm ? (nm - before->nm) / (after->nm - before->nm) : 0;
    std::array<double, 6> powers;
    for (std::size_t k = 0; k < 6; ++k)
        powers[k] = std::lerp(before->powers[k], after->powers[k], part);
    return powers;
}

} // namespace

double GlobeColours::spectrum(int index, double nm) const
{
    static const Spectrum sunlight = sunlit_white();
    if (index >= first_light_) { // per frequency; tables are per wavelength
        const std::size_t at = std::size_t(index - first_light_);
        return lights_[at] * lamp(globes_.system.lights[at].points, nm) * nm * nm;
    }
    const double light = sunlight(nm);
    if (index == white)
        return light;
    if (index == scattered)
        return light * optical_depth(nm);
    if (index >= first_kind)
        return light * straight(globes_.system.kinds[std::size_t(index - first_kind)].points, nm);
    if (globes_.system.limb.empty())
        return index == sun ? sun_ * light : 0;
    const std::array<double, 6> powers = limb_at(globes_.system, nm);
    double mean = 0;
    for (std::size_t k = 0; k < 6; ++k)
        mean += 2 * powers[k] / double(k + 2);
    return sun_ * light * powers[std::size_t(index - sun)] / mean;
}

glm::dvec3 GlobeColours::seen(std::span<const Term> terms, double D) const
{
    glm::dvec3 colour(0);
    bool air = false;
    for (const Term& term : terms)
        if (term.air == 0 && term.spectrum != scattered)
            colour += term.weight * seen_[std::size_t(term.spectrum)]->at(D);
        else
            air = true;
    if (!air)
        return colour;
    glm::dvec3 sum(0);
    std::vector<double> known(seen_.size());
    for (const StandardObserver::Sample& sample : coarse_.samples) {
        const double nm = D * sample.nm, depth = optical_depth(nm);
        std::fill(known.begin(), known.end(), NAN);
        double light = 0;
        for (const Term& term : terms)
            if (term.air != 0 || term.spectrum == scattered) {
                double& own = known[std::size_t(term.spectrum)];
                if (std::isnan(own))
                    own = spectrum(term.spectrum, nm);
                light += term.weight * own * std::exp(-depth * term.air);
            }
        sum += sample.response * (light * sample.width_nm / (sample.nm * sample.nm));
    }
    return colour + coarse_.rec709 * sum;
}

double GlobeSight::Body::outer_m() const
{
    double top = globe->air ? top_heights * globe->air->scale_height_m : 0;
    for (std::size_t i = 0; i < glows.size(); ++i)
        top = std::max(top, globe->air->glows[i].to_m);
    return std::max(globe->radius_m + top, globe->ring ? globe->ring->outer_m : 0);
}

GlobeSight::GlobeSight(
    const Globes& globes, const WorldOrigin& origin, const GlobeColours& colours, const EyeAmongGlobes& eye)
    : globes_(globes)
    , sun_radius_m_(globes.system.globes.front().radius_m)
    , green_limb_(limb_at(globes.system, 550))
{
    const SolarSystem& system = globes.system;
    /// A globe's place in the world, metres, at a world's time in seconds.
    const auto place = [&](std::size_t globe, double seconds) {
        return eye.world_from_equatorial
            * (globe_places_m(system, origin.days + seconds / 86400)[globe] - origin.at(seconds));
    };
    const double metres_a_second = eye.unit_m / eye.seconds; // of light
    const glm::dvec3 eye_m = eye.place * eye.unit_m;
    for (const SeenGlobe& seen : globes_seen(system, origin, eye)) {
        const Globe& globe = system.globes[seen.globe];
        Body body{.index = seen.globe,
            .globe = &globe,
            .middle_m = seen.from_eye * eye.unit_m,
            .own_from_world = seen.own_from_world,
            .to_sun = glm::dvec3(0),
            .other = {}};
        // The light of an instant that meets the globe left the Sun, and passed another globe, before.
        const double time = eye.time + (eye.now ? glm::dot(eye.way, seen.from_eye) : -seen.distance);
        const glm::dvec3 middle = eye_m + body.middle_m;
        const auto from_middle = [&](std::size_t globe) {
            glm::dvec3 way(0);
            for (int round = 0; round < 6; ++round)
                way = place(globe, time * eye.seconds - glm::length(way) / metres_a_second) - middle;
            return way;
        };
        if (seen.globe != 0) {
            const glm::dvec3 sun = from_middle(0);
            body.sun_m = glm::length(sun);
            body.to_sun = body.own_from_world * (sun / body.sun_m);
            body.phase_deg = angle_between(sun, -body.middle_m) / degree;
            if (globe.scattering == Scattering::dusty)
                body.dimming = dimming_of(globe, body.phase_deg);
            for (std::size_t other = 1; other < system.globes.size(); ++other)
                if (other != seen.globe && (globe.moon || globe.name == "Earth")
                    && (system.globes[other].moon || system.globes[other].name == "Earth"))
                    body.other = Body::Other{body.own_from_world * from_middle(other), system.globes[other].radius_m};
        }
        for (std::size_t k = 0; k < 4; ++k)
            body.kinds[k] = colours.kind(globe.kinds[k]);
        body.clouds = colours.kind("cloud");
        if (globe.air) {
            body.lamps = colours.light(globe.air->lamp);
            for (const Glow& glow : globe.air->glows)
                body.glows.push_back(colours.light(glow.light));
            // On the great circle from the pole to the point opposite to the Sun.
            const double up = geomagnetic_pole_deg.x * degree, east = geomagnetic_pole_deg.y * degree;
            const double off = oval_from_pole_deg * degree;
            const glm::dvec3 pole(std::cos(up) * std::cos(east), std::cos(up) * std::sin(east), std::sin(up));
            const glm::dvec3 axis = glm::normalize(glm::cross(pole, -body.to_sun));
            body.oval = std::cos(off) * pole + std::sin(off) * glm::cross(axis, pole);
        }
        if (globe.ring)
            body.rings = colours.kind(globe.ring->kind);
        bodies_.push_back(body);
    }
    std::reverse(bodies_.begin(), bodies_.end());
}

/// A ray in a globe's own axes, metres from its middle, and in the space where the spheroid is a ball.
struct GlobeSight::Sight {
    glm::dvec3 from, direction;
    glm::dvec3 ball_from, ball_direction; ///< unit
    double ball_scale; ///< length in that space of a metre along the ray
    double nearest, across_square; ///< there: along the ray to the point nearest to the middle, and its squared distance

    Sight(const Body& body, const glm::dvec3& from_m, const glm::dvec3& way)
        : from(body.own_from_world * (from_m - body.middle_m))
        , direction(body.own_from_world * way)
    {
        const glm::dvec3 stretch(1, 1, 1 / (1 - body.globe->flattening));
        ball_from = from * stretch;
        const glm::dvec3 stretched = direction * stretch;
        ball_scale = glm::length(stretched);
        ball_direction = stretched / ball_scale;
        nearest = -glm::dot(ball_from, ball_direction);
        const glm::dvec3 across = glm::cross(ball_from, ball_direction);
        across_square = glm::dot(across, across);
    }
    /// The metres at which the ray enters and leaves a ball of the radius; the first is above the second where it misses.
    std::pair<double, double> within(double radius) const
    {
        if (across_square >= radius * radius)
            return {1, 0};
        const double half = std::sqrt(radius * radius - across_square);
        return {(nearest - half) / ball_scale, (nearest + half) / ball_scale};
    }
};

struct GlobeSight::Through {
    double grey = 1; ///< of rings and of discs that are partly drawn
    double air = 0;
    double all() const { return grey * std::exp(-lamps_depth * air); }
};

/// The part of the Sun's disc that another globe leaves to a place, own axes.
double GlobeSight::sun_left(const Body& body, const glm::dvec3& place) const
{
    if (!body.other)
        return 1;
    const glm::dvec3 sun = body.to_sun * body.sun_m - place, other = body.other->place_m - place;
    const double sun_far = glm::length(sun), far = glm::length(other);
    if (far >= sun_far)
        return 1;
    const double suns = sun_radius_m_ / sun_far, own = body.other->radius_m / far;
    const double apart = std::acos(std::clamp(glm::dot(sun, other) / (sun_far * far), -1.0, 1.0));
    if (apart >= suns + own)
        return 1;
    // Rings of the Sun's disc, as wide as even steps of mu make them.
    constexpr int rings = 100;
    const std::array<double, 6>& limb = green_limb_;
    double whole = 0, left = 0;
    for (int i = 0; i < rings; ++i) {
        const double mu = (i + 0.5) / rings, r = suns * std::sqrt(1 - mu * mu);
        double light = 0;
        for (std::size_t k = 6; k-- > 0;)
            light = light * mu + limb[k];
        const double cosine = (r * r + apart * apart - own * own) / (2 * r * std::max(apart, 1e-12));
        whole += light * mu;
        left += light * mu * (1 - std::acos(std::clamp(cosine, -1.0, 1.0)) / pi);
    }
    return left / whole;
}

/// The glowing layers on one side of the ray's place nearest to the middle. last: its end; air: before them.
void GlobeSight::add_glows(const Body& body, const Sight& sight, bool behind, double last, double air, const Pixel& pixel,
    Ray& out, const Through& through) const
{
    const double nearest = std::max(sight.nearest / sight.ball_scale, 0.0), first = behind ? nearest : 0;
    if (!behind)
        last = std::min(last, nearest);
    const Globe& globe = *body.globe;
    for (std::size_t i = 0; i < body.glows.size(); ++i) {
        const Glow& glow = globe.air->glows[i];
        // The layer is the part of the outer ball that lies outside of the inner one.
        const auto [enters, leaves] = sight.within(globe.radius_m + glow.to_m);
        const auto [hole_begins, hole_ends] = sight.within(globe.radius_m + glow.from_m);
        double begin = std::max(enters, first), end = std::min(leaves, last);
        if (hole_begins < hole_ends) {
            if (behind)
                begin = std::max(begin, hole_ends);
            else
                end = std::min(end, hole_begins);
        }
        if (begin >= end)
            continue;
        double light = glow.zenith / (glow.to_m - glow.from_m) * (end - begin);
        if (glow.aurora) {
            // Place by place; the live picture takes an arc between a layer's two ends at once.
            constexpr int places = 32;
            double sum = 0;
            for (int k = 0; k < places; ++k) {
                const double way = begin + (end - begin) * (k + 0.5) / places,
                             width = physics::aurora_pixel(pixel.rad * way / globe.radius_m, glow.from_m / globe.radius_m);
                const glm::dvec3 up = glm::normalize(sight.from + sight.direction * way);
                const auto here = physics::aurora_place(up, (glm::dot(up, body.oval) < 0 ? -1.0 : 1.0) * body.oval);
                if (here.strength > 0)
                    sum += physics::aurora(here, here, physics::aurora_rays(up, width), width);
            }
            light *= sum / places;
        }
        if (light > 0)
            out.terms.push_back({body.glows[i], light * pixel.part * through.grey * std::exp(-lamps_depth * air), 0});
    }
}

/// Returns the air between the start and the end of the ray.
double GlobeSight::add_air(
    const Body& body, const Sight& sight, double end, double part, Ray& out, const Through& through) const
{
    const AirAround air{body.globe->radius_m, body.globe->air->scale_height_m};
    auto [first, last] = sight.within(air.top());
    first = std::max(first, 0.0), last = std::min(last, end);
    if (first >= last)
        return 0;
    const double step = (last - first) / air_steps;
    const glm::dvec3 stretch(1, 1, 1 / (1 - body.globe->flattening));
    const glm::dvec3 to_sun = glm::normalize(body.to_sun * stretch);
    const double cosine = glm::dot(sight.direction, body.to_sun), sun_size = sun_radius_m_ / body.sun_m;
    const double strength = std::pow(astronomical_unit_m / body.sun_m, 2) * 3 / 16 * (1 + cosine * cosine) * step
        / air.height * part * through.grey;
    double before = 0;
    for (int i = 0; i < air_steps; ++i) {
        const double way = first + (i + 0.5) * step;
        const glm::dvec3 place = sight.ball_from + sight.ball_direction * (way * sight.ball_scale);
        const double r = glm::length(place), density = std::exp(-(r - air.radius) / air.height);
        const double here = before + 0.5 * density * step / air.height;
        before += density * step / air.height;
        const double up = glm::dot(place, to_sun) / r, horizon = -std::sqrt(std::max(1 - std::pow(air.radius / r, 2), 0.0));
        const double above = std::acos(std::clamp(horizon, -1.0, 1.0)) - std::acos(std::clamp(up, -1.0, 1.0));
        const double risen = smooth_step(-sun_size, sun_size, above);
        if (risen <= 0)
            continue;
        const double sunny = risen * sun_left(body, place / stretch);
        const double sunward = air.outward(r, std::max(up, horizon));
        out.terms.push_back({GlobeColours::scattered, strength * density * sunny, through.air + here + sunward});
    }
    return before;
}

void GlobeSight::add_ring(const Body& body, const Sight& sight, double way, double part, Ray& out, Through& through) const
{
    const PlanetRing& ring = *body.globe->ring;
    const glm::dvec3 place = sight.from + sight.direction * way;
    const auto [depth, bright] = [&] {
        const glm::dvec2 at = ring_at(ring, std::hypot(place.x, place.y));
        return std::pair(at.x, at.y);
    }();
    const double mu = std::abs(sight.direction.z), mu_sun = std::abs(body.to_sun.z);
    if (depth <= 0 || mu <= 0)
        return;
    const Sight sunward = [&] {
        Body here = body;
        here.own_from_world = glm::dmat3(1), here.middle_m = glm::dvec3(0);
        return Sight(here, place, body.to_sun);
    }();
    const auto [in, behind] = sunward.within(body.globe->radius_m);
    const bool dark = in < behind && in > 0;
    if (!dark && mu_sun > 0) {
        const bool sunlit = (sight.direction.z < 0) == (body.to_sun.z > 0);
        double light = 0;
        if (sunlit)
            light = mu_sun / (mu_sun + mu) * -std::expm1(-depth * (1 / mu + 1 / mu_sun));
        else if (std::abs(mu - mu_sun) < 1e-7)
            light = depth / mu * std::exp(-depth / mu);
        else
            light = mu_sun / (mu - mu_sun) * (std::exp(-depth / mu) - std::exp(-depth / mu_sun));
        out.terms.push_back(
            {body.rings, bright * light * std::pow(astronomical_unit_m / body.sun_m, 2) * part * through.grey, through.air});
    }
    const double left = std::exp(-depth / mu);
    through.grey *= 1 - part * (1 - left);
}

void GlobeSight::add_ground(
    const Body& body, const Sight& sight, double way, double air, const Pixel& pixel, Ray& out, Through& through) const
{
    const Globe& globe = *body.globe;
    const glm::dvec3 place = sight.from + sight.direction * way;
    const double polar = 1 / (1 - globe.flattening);
    const glm::dvec3 normal = glm::normalize(place * glm::dvec3(1, 1, polar * polar));
    const double mu = std::max(-glm::dot(normal, sight.direction), 0.0);
    const double weight = pixel.part * through.grey;
    /// The pixel's width on the ground, radii.
    const double width = pixel.rad * way * sight.ball_scale / globe.radius_m / std::max(std::sqrt(mu), 0.3);
    if (globe.scattering == Scattering::sun) {
        double power = weight * physics::sun_surface(normal, width, mu);
        for (int k = 0; k < 6; ++k, power *= mu) {
            out.terms.push_back({GlobeColours::sun + k, power, through.air});
            out.sun.push_back(out.terms.back());
        }
        return;
    }
    const Texture& map = globes_.maps[body.index];
    const bool mapped = map.size.x > 0;
    const glm::dvec4 parts
        = mapped ? texel(map, normal) * glm::dvec4(glm::dvec3(globe.map_scale), 1) : glm::dvec4(0, 0, 0, 1);
    const double mu_sun = glm::dot(normal, body.to_sun);
    const double sunlight = std::pow(astronomical_unit_m / body.sun_m, 2) * sun_left(body, place);
    const auto add = [&](int kind, double light, double through_air) {
        if (kind >= 0 && light != 0)
            out.terms.push_back({kind, light * weight, through.air + through_air});
    };
    if (!globe.air) {
        double light = std::max(mu_sun, 0.0) * sunlight;
        if (light <= 0)
            return;
        if (globe.ring && body.to_sun.z != 0) {
            const double to_plane = -place.z / body.to_sun.z;
            const glm::dvec3 crossing = place + body.to_sun * to_plane;
            if (to_plane > 0)
                light *= std::exp(-ring_at(*globe.ring, std::hypot(crossing.x, crossing.y)).x / std::abs(body.to_sun.z));
        }
        light *= globe.scattering == Scattering::dusty ? 2 / (mu_sun + mu) * body.dimming : 1.5;
        for (std::size_t k = 0; k < 4; ++k)
            add(body.kinds[k], light * parts[int(k)], 0);
        return;
    }
    const AirAround around{globe.radius_m, globe.air->scale_height_m};
    const glm::dvec4 above = texel(globes_.sky, normal, 1);
    const Detailed here(normal, body.to_sun, map.size.y, parts, glm::dvec2(above), -std::log2(map.size.y / pi * width));
    const double clouds = here.clouds;
    const double sun_size = sun_radius_m_ / body.sun_m;
    const double risen = smooth_step(-sun_size, sun_size, std::asin(std::clamp(mu_sun, -1.0, 1.0)));
    if (mu_sun > 0) {
        const glm::dvec3 stretch(1, 1, polar);
        const glm::dvec3 up = glm::normalize(place * stretch), to_sun = glm::normalize(body.to_sun * stretch);
        const double all = air + around.outward(globe.radius_m, std::max(glm::dot(up, to_sun), 0.0));
        const double light = sunlight * risen;
        for (std::size_t k = 0; k < 4; ++k)
            add(body.kinds[k], light * (k < 3 ? here.land_sun : mu_sun) * (1 - clouds) * here.parts[int(k)], 0.5 * all);
        add(body.clouds, light * here.cloud_sun * clouds, 0.25 * all);
        // The Sun's mirror image in waves.
        const glm::dvec3 wave = glm::normalize(body.to_sun - sight.direction);
        const double cosine = glm::dot(wave, normal), variance = 0.003 + 0.00512 * here.wind;
        if (cosine > 0) {
            const double tangent_square = (1 - cosine * cosine) / (cosine * cosine);
            const double fresnel = 0.0204 + 0.9796 * std::pow(1 - std::clamp(glm::dot(wave, body.to_sun), 0.0, 1.0), 5);
            const auto q = [&](double c) { return std::sqrt(c * c + variance * (1 - c * c)); };
            const double glint = pi / 4 * std::exp(-tangent_square / variance) / (pi * variance * std::pow(cosine, 4))
                * fresnel * 2 / (mu + q(mu)) * 2 * mu_sun / (mu_sun + q(mu_sun));
            add(GlobeColours::white, sunlight * risen * glint * here.parts.w * (1 - clouds), all);
        }
    }
    add(body.lamps, globe.air->brightest_lamps * here.lamps * (1 - clouds) * std::exp(-lamps_depth * air), 0);
}

GlobeSight::Ray GlobeSight::ray(
    const glm::dvec3& from_m, const glm::dvec3& direction, double pixel_rad, std::span<const double> parts, int only) const
{
    Ray out;
    Through through;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& body = bodies_[i];
        const double part = parts.empty() || int(i) == only ? 1 : parts[body.index];
        const bool silent = only >= 0 && int(i) != only;
        if (part <= 0)
            continue;
        const Sight sight(body, from_m, direction);
        const std::size_t terms = out.terms.size();
        const auto silence = [&] {
            if (silent)
                out.terms.resize(terms), out.sun.clear();
        };
        auto [ground, beyond] = sight.within(body.globe->radius_m);
        const bool hit = ground < beyond && ground > 0;
        if (!hit)
            ground = INFINITY;
        double ring = INFINITY;
        if (body.globe->ring && sight.direction.z != 0)
            if (const double way = -sight.from.z / sight.direction.z; way > 0)
                ring = way;
        if (ring < ground)
            add_ring(body, sight, ring, part, out, through);
        double air = 0;
        if (body.globe->air) {
            add_glows(body, sight, false, ground, through.air, {part, pixel_rad}, out, through);
            air = add_air(body, sight, ground, part, out, through);
            if (!hit)
                add_glows(body, sight, true, INFINITY, through.air + air, {part, pixel_rad}, out, through);
        }
        if (hit) {
            add_ground(body, sight, ground, air, {part, pixel_rad}, out, through);
            if (part >= 0.5)
                out.distance_m = std::min(out.distance_m, ground);
            through.grey *= 1 - part;
        } else if (part >= 1) {
            through.air += air;
        }
        silence();
        if (through.grey <= 0 || int(i) == only)
            break;
    }
    out.through = through.all();
    return out;
}

} // namespace starbow
