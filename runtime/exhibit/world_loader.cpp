#include "world_loader.h"
#include <chrono>
#include <sys/resource.h>

namespace starbow {

void WorldLoader::open(const std::filesystem::path& scene)
{
    wanted_ = scene;
    if (work_.valid() && (reading_ == wanted_ || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready))
        return; // a future waits for its thread, so a reading in vain ends by itself first
    reading_ = wanted_;
    work_ = std::async(std::launch::async, [scene] {
        // Frames come before this thread and those that it starts, which may compute a world's shadows.
        setpriority(PRIO_PROCESS, 0, 3);
        return load_scene(scene);
    });
}

bool WorldLoader::ready()
{
    if (!work_.valid() || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return false;
    if (reading_ == wanted_)
        return true;
    open(std::filesystem::path(wanted_));
    return false;
}

LoadedScene WorldLoader::take(const std::filesystem::path& scene)
{
    if (work_.valid() && reading_ == scene)
        return work_.get();
    return load_scene(scene);
}

} // namespace starbow
