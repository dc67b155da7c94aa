#pragma once
#include "config/model/shot.h"
#include "config/model/words.h"
#include "runtime/hud/small_picture.h"
#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <vector>

namespace starbow {

/// A small picture of a world, a tour or a view, beside its name in lists to choose from.
struct Thumbnail {
    std::string kind, name; ///< as Words::title takes them
    std::filesystem::path scene;
    Shot shot; ///< the world's start, the tour's first picture, or the view
    std::filesystem::path file; ///< a PNG in the cache, named by its content's key; it may not be there yet
};
constexpr glm::ivec2 thumbnail_px{192, 108};

/// Those of all shipped files and the site's, the ones of a scene one after the other. folder: the cache; empty: none, and
/// so are they. say: receives the reason why one is left out.
std::vector<Thumbnail> thumbnails(
    const std::filesystem::path& folder, const Words& words, const std::function<void(const std::string&)>& say);

/// The pictures that are there and can be read. Fewer where memory lacks: the guide's window goes on.
Thumbnails drawn_thumbnails(const std::filesystem::path& folder, const Words& words);

/// Reads small pictures on a thread of its own, from when the first one is wanted.
class ThumbnailReader {
public:
    /// read: makes them, on the thread; empty: there are none.
    explicit ThumbnailReader(std::function<Thumbnails()> read)
        : read_(std::move(read))
    {
    }
    /// name: as thumbnail_of()'s. Null where there is none, or not yet.
    const SmallPicture* find(const std::string& name);

private:
    std::function<Thumbnails()> read_;
    std::future<Thumbnails> coming_;
    Thumbnails here_;
};

/// Draws those that are not there, without a window. show: receives each one before it is drawn, and the number of those
/// before it. Returns the number of drawn ones. Throws InputError.
std::size_t draw_thumbnails(
    const std::vector<Thumbnail>& all, const std::function<void(const Thumbnail&, std::size_t)>& show);

} // namespace starbow
