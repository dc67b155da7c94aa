#pragma once
#include "machine_files.h"
#include "runtime/operation/file_watch.h"
#include "runtime/render/layout_parts.h"
#include <optional>
#include <string>
#include <variant>

namespace starbow {

/// Watches the files of a layout, and reads and compiles them after a change, on a thread of its own: a large calibration or
/// a file system that hangs holds no frame. Of several changes only the newest is offered.
class LayoutLoader {
public:
    explicit LayoutLoader(const Layout& layout);
    /// Waits two seconds at most for the thread. One that hangs longer is left alone.
    ~LayoutLoader();
    LayoutLoader(const LayoutLoader&) = delete;

    /// The frame's present layout and quality.
    struct Shown {
        Layout kept, layout; ///< the file's, and the same with a builder's changes
        Quality quality;
        std::vector<glm::ivec2> sizes; ///< of its outputs as they are drawn, pixels
        bool has_stars = false;
    };
    struct Loaded {
        Layout fresh, layout; ///< the file's new layout, and the same with the builder's changes
        PreparedLayout prepared;
        FileDigests digests; ///< of its files, where several machines show it
    };
    /// A layout, or the reason why there is none.
    using Result = std::variant<Loaded, std::string>;

    /// The layout of a result. Throws InputError with the reason where there is none.
    static Loaded loaded_of(Result result);

    /// True while a change waits for load().
    bool changed() const;
    void load(Shown shown);
    /// Has the layout of another file loaded, as if the file had changed; once it is there, its files are watched instead.
    void open(std::filesystem::path file);
    /// The result, once.
    std::optional<Result> result();

private:
    struct State;
    std::shared_ptr<State> state_; ///< shared with the thread
};

} // namespace starbow
