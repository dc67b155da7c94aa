#include "driver_memory.h"
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>

namespace starbow {
namespace {

std::atomic<std::size_t> pieces{0}, bytes{0};

/// Stands before each piece, because a piece is freed without its size.
struct BlockHead {
    void* whole;
    std::size_t size;
};

BlockHead& head_of(void* piece) { return static_cast<BlockHead*>(piece)[-1]; }

VKAPI_ATTR void* VKAPI_CALL allocate(void*, std::size_t size, std::size_t alignment, VkSystemAllocationScope)
{
    const std::size_t step = std::max(alignment, alignof(std::max_align_t));
    void* whole = std::malloc(size + sizeof(BlockHead) + step);
    if (!whole)
        return nullptr;
    const auto free_from = reinterpret_cast<std::uintptr_t>(whole) + sizeof(BlockHead);
    void* piece = reinterpret_cast<void*>((free_from + step - 1) / step * step);
    head_of(piece) = {whole, size};
    ++pieces, bytes += size;
    return piece;
}

VKAPI_ATTR void VKAPI_CALL release(void*, void* piece)
{
    if (!piece)
        return;
    --pieces, bytes -= head_of(piece).size;
    std::free(head_of(piece).whole);
}

VKAPI_ATTR void* VKAPI_CALL reallocate(
    void* user, void* piece, std::size_t size, std::size_t alignment, VkSystemAllocationScope scope)
{
    if (size == 0) {
        release(user, piece);
        return nullptr;
    }
    void* moved = allocate(user, size, alignment, scope);
    if (moved && piece) {
        std::memcpy(moved, piece, std::min(size, head_of(piece).size));
        release(user, piece);
    }
    return moved;
}

} // namespace

const vk::AllocationCallbacks& counting_callbacks()
{
    // The C structure, because newer headers give the functions' pointers another type.
    static const vk::AllocationCallbacks callbacks(
        VkAllocationCallbacks{.pfnAllocation = allocate, .pfnReallocation = reallocate, .pfnFree = release});
    return callbacks;
}

DriverMemory driver_memory() { return {pieces, bytes}; }

} // namespace starbow
