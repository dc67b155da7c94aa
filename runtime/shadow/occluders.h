#pragma once
#include "runtime/world/world.h"
#include <array>
#include <memory>
#include <span>

namespace starbow {

/// True for an instance that hides light for ever: it rests in the world's frame, exists always, is not animated, and
/// neither shines itself, as the glass around a lamp does, nor is blended.
bool hides_light(const World& world, const Instance& instance);

/// The still triangles of a world, for rays. Any side of a triangle hides light; where a mask cuts it out, it does not.
/// Several threads may use it.
class Occluders {
public:
    /// world: must outlive the object, with vertices, indices and texels. instances: the world's, after place_bodies.
    Occluders(const World& world, std::span<const Instance> instances);
    ~Occluders();
    Occluders(Occluders&&) noexcept;

    struct Hit {
        double distance;
        bool back; ///< of a triangle with one visible side: the other
    };
    /// The first triangle along a ray; nullopt within `far`: none. Places are the world frame's, `way` is a unit vector.
    std::optional<Hit> first(const glm::dvec3& from, const glm::dvec3& way, double far) const;
    static constexpr int bundle = 8;
    /// The places or the unit vectors of a bundle's rays, by coordinates.
    struct Vectors {
        std::array<float, bundle> x, y, z;
        void set(std::size_t ray, const glm::dvec3& value)
        {
            x[ray] = float(value.x), y[ray] = float(value.y), z[ray] = float(value.z);
        }
    };
    struct Hits {
        std::array<float, bundle> distance; ///< infinite: no triangle is there
        std::array<bool, bundle> back; ///< as Hit::back
    };
    /// The first triangle along each of some rays without an end: quicker than one by one, the more so the closer the rays
    /// are to each other.
    Hits first(const Vectors& from, const Vectors& ways) const;
    /// True if any triangle is there.
    bool hidden(const glm::dvec3& from, const glm::dvec3& way, double far) const;

    std::size_t triangles() const;
    double extent() const; ///< greatest coordinate, scene units: rays begin at least 1e-6 of it above a surface

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace starbow
