// The kind of memory that each use gets, on the tables of memory types that drivers report (vulkan.gpuinfo.org).
#include "runtime/render/memory_type.h"
#include <gtest/gtest.h>
#include <vector>

namespace starbow::memory_type_gpu_test {
namespace {

using Flag = vk::MemoryPropertyFlagBits;
constexpr vk::MemoryPropertyFlags own = Flag::eDeviceLocal, mapped = Flag::eHostVisible | Flag::eHostCoherent,
                                  cached = Flag::eHostVisible | Flag::eHostCoherent | Flag::eHostCached;

struct Type {
    vk::MemoryPropertyFlags flags;
    std::uint32_t heap;
};
vk::PhysicalDeviceMemoryProperties card(const std::vector<double>& heaps_mib, const std::vector<Type>& types)
{
    vk::PhysicalDeviceMemoryProperties memory;
    for (double mib : heaps_mib)
        memory.memoryHeaps[memory.memoryHeapCount++].size = vk::DeviceSize(mib * (1 << 20));
    for (const Type& type : types)
        memory.memoryTypes[memory.memoryTypeCount++] = vk::MemoryType(type.flags, type.heap);
    return memory;
}

std::uint32_t best(const vk::PhysicalDeviceMemoryProperties& memory, MemoryUse use, vk::DeviceSize size = 1 << 20)
{
    return memory_type(memory, ~0u, use, size).value();
}

TEST(MemoryType, NvidiaWithAndWithoutAWindowOnAllMemory)
{
    const std::vector<Type> types = {{{}, 1}, {own, 0}, {mapped, 1}, {cached, 1}, {own | mapped, 2}};
    const auto small = card({8192, 24000, 246}, types);
    EXPECT_EQ(best(small, MemoryUse::device), 1u);
    EXPECT_EQ(best(small, MemoryUse::written), 4u);
    EXPECT_EQ(best(small, MemoryUse::written, 16 << 20), 2u) << "more than a sixteenth of the window";
    EXPECT_EQ(best(small, MemoryUse::staged, 16 << 20), 2u);
    EXPECT_EQ(best(small, MemoryUse::read), 3u);
    auto whole = card({8192, 24000}, types);
    whole.memoryTypes[4].heapIndex = 0;
    EXPECT_EQ(best(whole, MemoryUse::written, 16 << 20), 4u);
}

TEST(MemoryType, AmdIntelAndSoftware)
{
    const auto amd = card({7936, 16000, 256}, {{own, 0}, {mapped, 1}, {own | mapped, 2}, {cached, 1}});
    EXPECT_EQ(best(amd, MemoryUse::device), 0u);
    EXPECT_EQ(best(amd, MemoryUse::written), 2u);
    EXPECT_EQ(best(amd, MemoryUse::staged), 1u);
    EXPECT_EQ(best(amd, MemoryUse::read), 3u);
    const auto intel = card({16000}, {{own, 0}, {own | mapped, 0}, {own | cached, 0}});
    EXPECT_EQ(best(intel, MemoryUse::written), 1u);
    EXPECT_EQ(best(intel, MemoryUse::read), 2u);
    const auto software = card({16000}, {{own | cached, 0}});
    for (const MemoryUse use : {MemoryUse::device, MemoryUse::written, MemoryUse::staged, MemoryUse::read})
        EXPECT_EQ(best(software, use), 0u);
}

TEST(MemoryType, OnlyOfThoseThatAreAllowed)
{
    const auto amd = card({7936, 16000, 256}, {{own, 0}, {mapped, 1}, {own | mapped, 2}, {cached, 1}});
    EXPECT_EQ(memory_type(amd, 0b1010, MemoryUse::written, 1 << 20), 1u);
    EXPECT_EQ(memory_type(amd, 0b0010, MemoryUse::read, 1 << 20), 1u);
    EXPECT_FALSE(memory_type(amd, 0b0010, MemoryUse::device, 1 << 20));
}

} // namespace
} // namespace starbow::memory_type_gpu_test
