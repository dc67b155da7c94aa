#pragma once
#include "config/model/shipped.h"
#include "runtime/render/render_context.h"

namespace starbow {

constexpr const char* quality_help
    = "Speed for accuracy: draft, balanced or fine, or a quality file, such as starbow measure --budget-ms writes";

/// An empty name: what counts where none is asked for.
inline std::optional<Quality> asked_quality(const std::string& name)
{
    return name.empty() ? std::nullopt : std::optional(load_quality(shipped_file("qualities", name)));
}

} // namespace starbow
