#pragma once
#include "config/model/shipped.h"
#include "runtime/render/render_context.h"

namespace starbow {

constexpr const char* quality_help
    = "Speed or accuracy: draft, balanced or fine, or a quality file, such as starbow measure --budget-ms writes";

/// The quality of --quality; none for an empty name. Throws InputError.
inline std::optional<Quality> chosen_quality(const std::string& name)
{
    return name.empty() ? std::nullopt : std::optional(load_quality(shipped_file("qualities", name)));
}

} // namespace starbow
