// Preloaded into the program: every other second the wall clock is set back by a day, and then right again.
#include <dlfcn.h>
#include <time.h>

namespace {

using Function = int (*)(clockid_t, timespec*);
const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clock_gettime"));

bool is_back()
{
    timespec now{};
    next(CLOCK_MONOTONIC, &now);
    return now.tv_sec % 2 == 0;
}

} // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* to)
{
    const int status = next(clock, to);
    if (status == 0 && clock == CLOCK_REALTIME && is_back())
        to->tv_sec -= 86400;
    return status;
}

extern "C" time_t time(time_t* to)
{
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return to ? *to = now.tv_sec : now.tv_sec;
}
