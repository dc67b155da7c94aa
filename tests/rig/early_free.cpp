// Preloaded into the program: counts the blocks of memory that are freed while a rasterizer thread of llvmpipe unlocks a
// mutex in them. Each such unlock is delayed, so that a free that would come too early once in a million frames comes at
// once. The last line on standard error says how many there were, and in how many unlocks.
#include <array>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>

extern "C" void __libc_free(void* memory); // glibc's own

namespace {

std::array<std::atomic<char*>, 64> unlocking;
std::atomic<long> early, delayed;

bool is_rasterizer()
{
    std::array<char, 16> name{}; // read each time, because a thread takes its name some time after its start
    pthread_getname_np(pthread_self(), name.data(), name.size());
    return std::strncmp(name.data(), "llvmpipe", 8) == 0;
}

struct Report {
    ~Report()
    {
        if (delayed > 0)
            std::fprintf(stderr, "early frees: %ld in %ld unlocks\n", early.load(), delayed.load());
    }
} report;

} // namespace

extern "C" int pthread_mutex_unlock(pthread_mutex_t* mutex)
{
    static const auto real = reinterpret_cast<int (*)(pthread_mutex_t*)>(dlsym(RTLD_NEXT, "pthread_mutex_unlock"));
    if (!is_rasterizer())
        return real(mutex);
    auto slot = unlocking.begin();
    for (char* nothing = nullptr; slot != unlocking.end(); ++slot, nothing = nullptr)
        if (slot->compare_exchange_strong(nothing, reinterpret_cast<char*>(mutex)))
            break;
    const timespec pause{0, 200'000};
    nanosleep(&pause, nullptr);
    ++delayed;
    const int result = real(mutex);
    if (slot != unlocking.end())
        *slot = nullptr;
    return result;
}

extern "C" void free(void* memory)
{
    if (const char* begin = static_cast<char*>(memory))
        for (const auto& slot : unlocking)
            if (const char* mutex = slot.load(std::memory_order_relaxed))
                early += mutex >= begin && mutex < begin + malloc_usable_size(memory);
    __libc_free(memory);
}
