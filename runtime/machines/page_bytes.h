#pragma once
#include "bus.h"
#include "runtime/hud/hud.h"

namespace starbow {

/// The most pixels of a page.
constexpr std::int64_t most_page_pixels = std::int64_t(1) << 24;

/// A picture of the instruments' readings as a message; its texels are packed by zlib.
PageMessage page_of(const Panel& panel, std::int64_t number);

/// The picture of such a message. Throws InputError for texels that are not as many as its sides say.
Panel panel_of(const PageMessage& page);

} // namespace starbow
