#pragma once
#include "input/command.h"
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace starbow {

/// A small picture, such as a copy of what the visitors see: three bytes a pixel, sRGB, from the top. Size 0: there is none.
struct SmallPicture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgb;
};

/// The name of the small picture of what a command leads to, such as "scene/avenue"; empty: it has none.
std::string thumbnail_of(const Command& command);

/// Small pictures of what can be chosen, by thumbnail_of().
using Thumbnails = std::map<std::string, SmallPicture>;

} // namespace starbow
