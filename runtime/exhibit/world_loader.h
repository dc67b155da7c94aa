#pragma once
#include "runtime/render/render_context.h"
#include <future>

namespace starbow {

/// Reads a world's files on a thread of its own, while another world is shown.
class WorldLoader {
public:
    /// Begins to read a scene. A newer wish takes the place of the one before.
    void open(const std::filesystem::path& scene);
    /// True once the last wish is read, or has failed. Call it each frame.
    bool ready();
    /// The scene that is being read, or is read and not taken; empty: none.
    std::filesystem::path coming() const { return work_.valid() ? wanted_ : std::filesystem::path(); }
    /// The scene's files: those that were read, or are being read, or else it reads them now. Throws InputError as
    /// load_scene does.
    LoadedScene take(const std::filesystem::path& scene);

private:
    std::filesystem::path wanted_, reading_;
    std::future<LoadedScene> work_;
};

} // namespace starbow
