#include "qualities.h"
#include "config/json/reader.h"
#include "runtime/operation/log.h"

namespace starbow {

Qualities::Qualities(const ExhibitOptions& options)
    : options_(options)
{
    forget();
}

void Qualities::forget()
{
    fixed_ = options_.quality, name_ = options_.quality_name;
    if (!governor_ && options_.frame_budget_ms > 0)
        governor_.emplace(options_.ladder, options_.frame_budget_ms);
}

void Qualities::fix(const Quality& quality, const std::string& name)
{
    fixed_ = quality, name_ = name;
    governor_.reset();
}

Quality Qualities::next(const Device& device) const
{
    if (governor_)
        return of_level(governor_->level(), device);
    return fixed_ ? within(device, *fixed_) : default_quality(device, false);
}

Quality Qualities::of_level(std::size_t level, const Device& device) const
{
    return governor_ ? within(device, governor_->ladder()[level].quality) : next(device);
}

std::optional<SpectralLevel> Qualities::spectra() const
{
    if (governor_)
        return governor_->ladder()[0].quality.spectra;
    return fixed_ ? fixed_->spectra : std::nullopt;
}

bool Qualities::leave(std::size_t level, const std::string& reason)
{
    if (!governor_ || !governor_->refuse(level))
        return false;
    write_log(LogKind::level_no_room,
        "level " + std::to_string(level + 1) + " of " + std::to_string(levels()) + " has no room on the GPU ("
            + one_line(reason) + "); level " + std::to_string(governor_->level() + 1)
            + " is drawn, and that one is not tried again before the layout or a window's size changes");
    return true;
}

void Qualities::follow_sizes(const std::vector<glm::ivec2>& sizes)
{
    sizes_.resize(sizes.size(), glm::ivec2(0));
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] == glm::ivec2(0))
            continue;
        if (sizes_[i] != glm::ivec2(0) && sizes_[i] != sizes[i])
            forget_refusals();
        sizes_[i] = sizes[i];
    }
}

void Qualities::forget_refusals()
{
    if (governor_)
        governor_->forget_refusals();
}

} // namespace starbow
