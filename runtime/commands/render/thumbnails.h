#pragma once

namespace starbow {

/// Draws the small pictures of all worlds, tours and views that the remote's page shows, as far as the cache lacks them.
/// Returns the exit status.
int render_thumbnails();

} // namespace starbow
