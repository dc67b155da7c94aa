// A library for LD_PRELOAD that lets the program's memory and threads run out for one moment, for tests.
//
// STARBOW_FAULTS as in faults.cpp, with two more calls, whose result is OUT_OF_MEMORY:
//   new     an allocation (operator new) by the program's own code. Those of libraries, the C++ library's strings among
//   them,
//           are neither counted nor fail: drivers bear no exceptions
//   thread  the start of a thread by the program (std::thread)
// WHEN is a number of pictures; the layer of faults.cpp counts them here.
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <new>
#include <pthread.h>

extern "C" {
std::atomic<int> starbow_pictures = 0; // the layer's
}

namespace {

/// True in a driver, which may call templates that the program has, too.
bool in_driver()
{
    static thread_local bool inside = false; // the first backtrace() allocates
    if (inside)
        return true;
    inside = true;
    void* stack[64];
    Dl_info of;
    bool found = false;
    for (int i = 0, size = backtrace(stack, 64); i < size; ++i)
        if (dladdr(stack[i], &of) && of.dli_fname)
            found |= std::strstr(of.dli_fname, "LLVM") || std::strstr(of.dli_fname, "libvulkan_");
    inside = false;
    return found;
}

struct Fault {
    const char* call;
    char text[64] = {};
    int pictures = 0, nth = 0;
    std::atomic<int> before = 0, after = 0, counted = 0;

    explicit Fault(const char* name)
        : call(name)
    {
        // Without an allocation: this is called by the first of them.
        const char* all = std::getenv("STARBOW_FAULTS");
        const std::size_t length = std::strlen(name);
        for (const char* at = all; at && *at; at = std::strchr(at, ',') ? std::strchr(at, ',') + 1 : nullptr)
            if (std::strncmp(at, name, length) == 0 && (at[length] == ':' || at[length] == '@')) {
                std::snprintf(text, sizeof text, "%.*s", int(std::strcspn(at, ",")), at);
                if (std::sscanf(at + length, "@%d:%d", &pictures, &nth) != 2)
                    std::sscanf(at + length, ":%d", &nth);
            }
    }
    ~Fault()
    {
        if (std::getenv("STARBOW_COUNT_CALLS"))
            std::fprintf(stderr, "call: %s %d %d\n", call, before.load(), after.load());
    }
    bool happens()
    {
        ++(starbow_pictures > 0 ? after : before);
        if (nth == 0 || starbow_pictures < pictures || counted >= nth || ++counted < nth)
            return false;
        if (in_driver()) {
            --counted; // the next one, then
            return false;
        }
        std::fprintf(stderr, "fault: %s\n", text);
        return true;
    }
};
Fault allocations("new"), threads("thread");

/// The first object is the program itself.
int find_program(dl_phdr_info* object, size_t, void* found)
{
    auto* range = static_cast<std::size_t*>(found);
    for (int i = 0; i < object->dlpi_phnum; ++i)
        if (object->dlpi_phdr[i].p_type == PT_LOAD && (object->dlpi_phdr[i].p_flags & PF_X)) {
            range[0] = object->dlpi_addr + object->dlpi_phdr[i].p_vaddr;
            range[1] = range[0] + object->dlpi_phdr[i].p_memsz;
        }
    return 1;
}

bool in_program(const void* address)
{
    static std::size_t range[2] = {};
    if (range[1] == 0)
        dl_iterate_phdr(find_program, range);
    const auto at = reinterpret_cast<std::size_t>(address);
    return at >= range[0] && at < range[1];
}

void* allocate(std::size_t size, const void* caller)
{
    if (in_program(caller) && allocations.happens()) {
        if (const std::new_handler handler = std::get_new_handler())
            handler(); // as the standard wants it
        throw std::bad_alloc();
    }
    if (void* memory = std::malloc(size > 0 ? size : 1))
        return memory;
    throw std::bad_alloc();
}

} // namespace

void* operator new(std::size_t size) { return allocate(size, __builtin_return_address(0)); }
void* operator new[](std::size_t size) { return allocate(size, __builtin_return_address(0)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument)
{
    static const auto next = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
    Dl_info caller;
    if (dladdr(__builtin_return_address(0), &caller) && std::strstr(caller.dli_fname, "libstdc++") && threads.happens())
        return EAGAIN;
    return next(thread, attributes, work, argument);
}
