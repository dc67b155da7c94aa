#include "vitals.h"
#include "config/json/folder.h"
#include <fstream>
#include <malloc.h>
#include <unistd.h>

namespace starbow {
namespace {

std::size_t entries_of(const char* folder)
{
    std::size_t entries = 0;
    each_entry(folder, [&](const char*) { ++entries; });
    return entries;
}

} // namespace

Vitals vitals()
{
    std::size_t all_pages = 0, resident_pages = 0;
    std::ifstream("/proc/self/statm") >> all_pages >> resident_pages;
    const struct mallinfo2 heap = mallinfo2();
    const std::size_t files = entries_of("/proc/self/fd");
    return {.resident_bytes = resident_pages * std::size_t(sysconf(_SC_PAGESIZE)),
        .heap_bytes = heap.uordblks + heap.hblkhd,
        .files = files > 0 ? files - 1 : 0, // the folder itself was open
        .threads = entries_of("/proc/self/task")};
}

void return_free_memory() { malloc_trim(0); }

} // namespace starbow
