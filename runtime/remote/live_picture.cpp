#include "live_picture.h"
#include <stb/stb_image_write.h>

namespace starbow {

std::vector<unsigned char> jpeg_of(const LivePicture& picture)
{
    std::vector<unsigned char> bytes;
    const bool right = picture.width > 0 && picture.height > 0 && picture.width <= most_live_px
        && picture.height <= most_live_px
        && picture.rgb.size() == std::size_t(picture.width) * std::size_t(picture.height) * 3;
    const auto write = [](void* to, void* data, int size) {
        auto& all = *static_cast<std::vector<unsigned char>*>(to);
        const auto* from = static_cast<const unsigned char*>(data);
        all.insert(all.end(), from, from + size);
    };
    constexpr int quality = 75;
    if (right)
        stbi_write_jpg_to_func(write, &bytes, picture.width, picture.height, 3, picture.rgb.data(), quality);
    return bytes;
}

} // namespace starbow
