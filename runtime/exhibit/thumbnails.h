#pragma once
#include "config/model/shot.h"
#include "config/model/words.h"
#include "runtime/hud/presenter_picture.h"
#include <filesystem>
#include <functional>
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

/// Draws those that are not there, without a window. show: receives each one before it is drawn, and the number of those
/// before it. Returns the number of drawn ones. Throws InputError.
std::size_t draw_thumbnails(
    const std::vector<Thumbnail>& all, const std::function<void(const Thumbnail&, std::size_t)>& show);

} // namespace starbow
