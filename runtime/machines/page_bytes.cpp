#include "page_bytes.h"
#include "config/json/error.h"
#include <new>
#include <zlib.h>

namespace starbow {

PageMessage page_of(const Panel& panel, std::int64_t number)
{
    PageMessage page{number, panel.size.x, panel.size.y, {}};
    uLongf size = compressBound(uLong(panel.texels.size()));
    page.texels.resize(size);
    // Letters on a plate: the fastest level leaves a twentieth of them.
    if (compress2(page.texels.data(), &size, panel.texels.data(), uLong(panel.texels.size()), Z_BEST_SPEED) != Z_OK)
        throw std::bad_alloc(); // the room is enough, so it is zlib's own memory
    page.texels.resize(size);
    return page;
}

Panel panel_of(const PageMessage& page)
{
    const std::int64_t pixels = std::int64_t(page.width) * page.height;
    if (page.width <= 0 || page.height <= 0 || pixels > most_page_pixels)
        throw InputError("a page of the exhibit's machines has " + std::to_string(page.width) + " x "
            + std::to_string(page.height) + " pixels; at most " + std::to_string(most_page_pixels) + " are right");
    constexpr std::size_t bytes_a_pixel = 2;
    Panel panel{{page.width, page.height}, std::vector<std::uint8_t>(bytes_a_pixel * std::size_t(pixels))};
    auto size = uLongf(panel.texels.size());
    if (uncompress(panel.texels.data(), &size, page.texels.data(), uLong(page.texels.size())) != Z_OK
        || size != panel.texels.size())
        throw InputError("a page of the exhibit's machines is damaged; the same program on all machines is right");
    return panel;
}

} // namespace starbow
