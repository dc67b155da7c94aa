#pragma once
#include <string>

namespace starbow {

struct ReferenceCommand {
    std::string layout, shot, out, size; ///< layout, size: "" for the desk, and as the layout's
    long samples = 16;
    bool exr = false;
};

/// Draws a shot's pictures by rays, without a device, and writes OUT/<output>.png (and .exr). Finished rows are stored in
/// OUT/<output>.rows until the picture is written. Returns the exit status.
int render_reference(const ReferenceCommand& command);

} // namespace starbow
