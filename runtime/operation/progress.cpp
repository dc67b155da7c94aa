#include "progress.h"
#include <cstdio>
#include <unistd.h>

namespace starbow {

Progress::Progress()
    : terminal_(isatty(STDERR_FILENO))
{
}

Progress::~Progress()
{
    if (shown_)
        std::fprintf(stderr, "\r\033[K");
}

void Progress::show(const std::string& text, double part)
{
    const Clock::time_point now = Clock::now();
    if (first_part_ < 0)
        first_part_ = part, began_ = now;
    if (!terminal_ || (shown_ && now - last_ < std::chrono::milliseconds(200) && part - last_part_ < 0.01))
        return;
    last_ = now, last_part_ = part, shown_ = true;
    std::string line = "\r" + text;
    if (part > first_part_)
        line += ", " + time_left(std::chrono::duration<double>(now - began_).count() / (part - first_part_) * (1 - part));
    std::fprintf(stderr, "%s\033[K", line.c_str());
    std::fflush(stderr);
}

std::string time_left(double seconds)
{
    char text[64];
    if (seconds < 90)
        std::snprintf(text, sizeof text, "about %.0f s left", seconds);
    else
        std::snprintf(text, sizeof text, "about %.0f min left", seconds / 60);
    return text;
}

} // namespace starbow
