#include "layout_loader.h"
#include "config/json/error.h"
#include "config/model/adjust.h"
#include "runtime/operation/record_files.h"
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <utility>

namespace starbow {
namespace {

/// The sizes of a new layout's outputs: those of the windows where an output keeps its name and its size, else the file's.
std::vector<glm::ivec2> sizes_of(const Layout& layout, const LayoutLoader::Shown& shown)
{
    std::vector<glm::ivec2> sizes;
    for (const Output& output : layout.outputs) {
        sizes.push_back(output.size);
        for (std::size_t i = 0; i < shown.layout.outputs.size() && i < shown.sizes.size(); ++i)
            if (shown.layout.outputs[i].name == output.name && shown.layout.outputs[i].size == output.size
                && shown.sizes[i] != glm::ivec2(0))
                sizes.back() = shown.sizes[i];
    }
    return sizes;
}

} // namespace

struct LayoutLoader::State {
    std::mutex mutex;
    std::condition_variable woken;
    bool ends = false, ended = false, changed = false;
    std::optional<Shown> shown;
    std::optional<Result> result;
    std::optional<std::filesystem::path> other; ///< the next file
    std::filesystem::path file;
    FileWatch watch; ///< the thread's own, as `file`

    explicit State(const Layout& layout)
        : file(layout.file)
        , watch(files_of(layout))
    {
    }

    void run()
    {
        setpriority(PRIO_PROCESS, 0, 3); // of this thread and those that it starts: frames come first, and half as much time
        for (std::unique_lock lock(mutex); !ends;) {
            woken.wait_for(lock, std::chrono::milliseconds(100), [this] { return ends || other; });
            lock.unlock();
            bool settled = false;
            try {
                settled = watch.changed(FileWatch::Clock::now());
            } catch (const std::bad_alloc&) { // the next look is the next attempt
            }
            lock.lock();
            if (ends || (!settled && !other))
                continue;
            changed = true;
            woken.wait(lock, [this] { return ends || shown; });
            if (ends)
                break;
            file = std::exchange(other, {}).value_or(file);
            const Shown now = std::move(*shown);
            shown.reset();
            lock.unlock();
            std::optional<Result> made = load(now);
            lock.lock();
            if (made)
                result = std::move(made);
        }
        ended = true;
        woken.notify_all();
    }

    /// nullopt if the files have changed again meanwhile.
    std::optional<Result> load(const Shown& now)
    {
        try {
            const FileWatch before({file});
            Loaded loaded{.fresh = load_layout(file), .layout = {}, .prepared = {}, .digests = {}};
            loaded.layout = file == now.layout.file ? turned_again(loaded.fresh, now.kept, now.layout) : loaded.fresh;
            watch = FileWatch(files_of(loaded.layout));
            loaded.prepared = prepare_layout(loaded.layout, now.quality, sizes_of(loaded.layout, now), now.has_stars);
            if (!nodes_of(loaded.fresh).empty())
                loaded.digests = digests_of(loaded.fresh);
            if (!before.same() || !watch.same())
                return {};
            return loaded;
        } catch (const InputError& error) {
            return refused(now, error.what());
        } catch (const std::bad_alloc&) {
            return refused(now, file.string() + ": needs more memory than there is; a smaller calibration is right");
        } catch (const std::system_error& error) { // no thread for its maps
            return refused(now, file.string() + ": can't be prepared (" + error.what() + ")");
        }
    }

    /// After another file was wrong, the shown one's are watched again.
    Result refused(const Shown& now, const std::string& why)
    {
        if (std::exchange(file, now.layout.file) != now.layout.file)
            watch = FileWatch(files_of(now.layout));
        return why;
    }
};

LayoutLoader::LayoutLoader(const Layout& layout)
    : state_(std::make_shared<State>(layout))
{
    std::thread([state = state_] { state->run(); }).detach();
}

LayoutLoader::~LayoutLoader()
{
    std::unique_lock lock(state_->mutex);
    state_->ends = true;
    state_->woken.notify_all();
    state_->woken.wait_for(lock, std::chrono::seconds(2), [this] { return state_->ended; });
}

LayoutLoader::Loaded LayoutLoader::loaded_of(Result result)
{
    if (const std::string* why = std::get_if<std::string>(&result))
        throw InputError(*why);
    return std::get<Loaded>(std::move(result));
}

bool LayoutLoader::changed() const
{
    const std::lock_guard lock(state_->mutex);
    return state_->changed;
}

void LayoutLoader::load(Shown shown)
{
    const std::lock_guard lock(state_->mutex);
    state_->changed = false;
    state_->result.reset();
    state_->shown = std::move(shown);
    state_->woken.notify_all();
}

void LayoutLoader::open(std::filesystem::path file)
{
    const std::lock_guard lock(state_->mutex);
    state_->other = std::move(file);
    state_->woken.notify_all();
}

std::optional<LayoutLoader::Result> LayoutLoader::result()
{
    const std::lock_guard lock(state_->mutex);
    return std::exchange(state_->result, {});
}

} // namespace starbow
