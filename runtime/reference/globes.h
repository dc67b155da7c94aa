#pragma once
#include "colours.h"
#include "runtime/world/ephemeris.h"
#include <span>

namespace starbow {

/// The spectra of globes as an observer sees them, with light that air dims by wavelength (docs/physics/numerics.md).
class GlobeColours {
public:
    /// Both must outlive the object.
    GlobeColours(const Globes& globes, const StandardObserver& observer);

    /// A part of a ray's light: weight * spectrum * exp(-air * optical depth of a vertical column of air).
    struct Term {
        int spectrum; ///< white, scattered, sun + a power, or one of kind() or light()
        double weight, air;
    };
    static constexpr int white = 0; ///< sunlight on a white matt surface
    static constexpr int scattered = 1; ///< the same times the optical depth
    static constexpr int sun = 2; ///< and the next five: the Sun's mean surface, by powers of the cosine
    /// The number of a kind of ground: sunlight times its reflectance. -1 for an empty name.
    int kind(const std::string& name) const;
    /// The number of a light of the system's file, with the luminance 1. -1 for an empty name.
    int light(const std::string& name) const;

    /// The colour of the light seen at D, Rec. 709 linear, without the headlight effect. Several threads may call it.
    glm::dvec3 seen(std::span<const Term> terms, double D) const;

    /// Optical depth of the vertical column of air (Bodhaine and others 1999, equation 30). That fit ends at 250 nm; below,
    /// it goes on with the inverse fourth power of the wavelength.
    static double optical_depth(double nm);

private:
    static constexpr int first_kind = 8;
    double spectrum(int index, double nm) const;

    const Globes& globes_;
    const StandardObserver& observer_;
    double sun_; ///< factor of the Sun's surface
    int first_light_; ///< light() of the first one
    std::vector<double> lights_; ///< factors of the lights' tables
    StandardObserver coarse_; ///< every 5 nm, for light through air
    std::vector<std::unique_ptr<ByShift>> seen_; ///< without air
};

/// The globes before one eye. It shares no code with the live picture but the ephemeris and the files' loading.
class GlobeSight {
public:
    /// All arguments must outlive the object. eye: its event in the world.
    GlobeSight(const Globes& globes, const WorldOrigin& origin, const GlobeColours& colours, const EyeAmongGlobes& eye);

    struct Ray {
        std::vector<GlobeColours::Term> terms; ///< the light
        std::vector<GlobeColours::Term> sun; ///< the part of `terms` that is the Sun's disc
        double through = 1; ///< the part of the light behind that comes through, for the eye's most sensitive wavelength
        double distance_m = INFINITY; ///< to the nearest ground; rings and air have none
    };
    /// Follows a ray. from_m: the eye's offset from the event; direction: unit, world axes. pixel_rad: the angle of a pixel
    /// in the world, down to which the ground has detail. parts: for each globe of the system the part of it that is drawn
    /// as a disc; empty: all. only: an index into bodies() to leave out all others'
    /// light, which still hide it; -1: all.
    Ray ray(const glm::dvec3& from_m, const glm::dvec3& direction, double pixel_rad, std::span<const double> parts,
        int only = -1) const;

    /// A globe that the eye may see.
    struct Body {
        std::size_t index; ///< of the system
        const Globe* globe;
        glm::dvec3 middle_m; ///< from the eye, world axes
        glm::dmat3 own_from_world;
        glm::dvec3 to_sun; ///< unit, its own axes: the Sun as the globe sees it
        double sun_m = 0, phase_deg = 0, dimming = 1;
        std::array<int, 4> kinds{-1, -1, -1, -1};
        int rings = -1, clouds = -1, lamps = -1;
        glm::dvec3 oval{0}; ///< the middle of the northern aurora, own axes
        std::vector<int> glows; ///< light() of each of the air's
        /// The globe that may hide the Sun from it: its place from the middle, own axes.
        struct Other {
            glm::dvec3 place_m;
            double radius_m;
        };
        std::optional<Other> other;
        /// The greatest radius of what belongs to it.
        double outer_m() const;
    };
    const std::vector<Body>& bodies() const { return bodies_; } ///< the nearest first

private:
    struct Sight; ///< a ray in a globe's axes
    struct Through; ///< the light that comes through so far
    struct Pixel {
        double part, rad; ///< the part of a globe that is drawn as a disc; the angle of the pixel in the world
    };
    void add_ground(
        const Body& body, const Sight& sight, double way, double air, const Pixel& pixel, Ray& out, Through& through) const;
    void add_glows(const Body& body, const Sight& sight, bool behind, double last, double air, const Pixel& pixel, Ray& out,
        const Through& through) const;
    double add_air(const Body& body, const Sight& sight, double end, double part, Ray& out, const Through& through) const;
    void add_ring(const Body& body, const Sight& sight, double way, double part, Ray& out, Through& through) const;
    double sun_left(const Body& body, const glm::dvec3& place) const;

    const Globes& globes_;
    double sun_radius_m_;
    std::array<double, 6> green_limb_; ///< LimbDarkening::powers at 550 nm, by which eclipses are computed
    std::vector<Body> bodies_;
};

} // namespace starbow
