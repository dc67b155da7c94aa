#pragma once
#include <cstddef>

namespace starbow {

/// The size of this process, as the kernel and the C library report it.
struct Vitals {
    std::size_t resident_bytes = 0; ///< memory in the machine
    std::size_t heap_bytes = 0; ///< in use of malloc's memory
    std::size_t files = 0; ///< open file descriptors
    std::size_t threads = 0;
};

/// A value that can't be read is 0.
Vitals vitals();

/// Gives the heap's free pages back to the system. Worlds, pipelines and the driver's compiler leave holes of all sizes.
/// Without this call, a process that shows one world after another grows, although it uses no more memory.
void return_free_memory();

} // namespace starbow
