#pragma once
#include "pipelines.h"

namespace starbow {

/// Formats of a compressed texture, of colours by sRGB's curve and of numbers: BC7, a byte for each texel.
constexpr vk::Format compressed_colours = vk::Format::eBc7SrgbBlock, compressed_numbers = vk::Format::eBc7UnormBlock;

/// A picture's copy in a quarter of its memory. picture: of 8 bits a channel, eR8G8B8A8Srgb or eR8G8B8A8Unorm, all of its
/// levels in eShaderReadOnlyOptimal. The device itself compresses it (shaders/compress.frag).
Image compressed(Device& device, Pipelines& pipelines, const Image& picture, MemoryArena& arena);

} // namespace starbow
