#pragma once
#include "exhibit.h"
#include "runtime/operation/governor.h"

namespace starbow {

/// The quality of an exhibit's pictures: a fixed one, or the one that the governor of the frame time chooses.
class Qualities {
public:
    explicit Qualities(const ExhibitOptions& options);

    /// The quality of the next frame.
    Quality next(const Device& device) const;
    /// The quality of a level of the ladder, or of the next frame where there is no governor.
    Quality of_level(std::size_t level, const Device& device) const;
    /// The number of levels, and whether the device has room for one; without a governor there is one level.
    std::size_t levels() const { return governor_ ? governor_->ladder().size() : 1; }
    bool has_room(std::size_t level) const { return !governor_ || governor_->has_room(level); }
    /// The spectral level that the qualities request; none: the world's own need.
    std::optional<SpectralLevel> spectra() const;
    /// The name of the fixed quality; empty: the governor chooses, or it is the device's default.
    const std::string& name() const { return name_; }
    const std::optional<Governor>& governor() const { return governor_; }

    /// Shows a fixed quality, in the governor's place.
    void fix(const Quality& quality, const std::string& name);
    /// The exhibit's own rules hold again.
    void forget();
    /// The time of a frame drawn in this quality; now_s: any clock that runs on. Returns true where the next quality is
    /// another one.
    bool drawn(double now_s, double ms) { return governor_ && governor_->drawn(now_s, ms); }
    /// Leaves a level for which the device has no memory, and logs that with the reason. Returns false without a governor,
    /// and where no level is left.
    bool leave(std::size_t level, const std::string& reason);
    /// The windows' sizes as drawn now, pixels; 0: nothing is drawn. Another size needs another amount of memory. A new
    /// start of the device alone changes no size.
    void follow_sizes(const std::vector<glm::ivec2>& sizes);
    /// Every level may have room again.
    void forget_refusals();

private:
    const ExhibitOptions& options_;
    std::optional<Quality> fixed_;
    std::string name_;
    std::optional<Governor> governor_;
    std::vector<glm::ivec2> sizes_; ///< of the outputs' windows, as last drawn
};

} // namespace starbow
