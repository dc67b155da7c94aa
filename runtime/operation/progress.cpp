#include "progress.h"
#include "messages.h"
#include <cstdio>
#include <unistd.h>

namespace starbow {

Progress::Progress()
    : terminal_(isatty(STDERR_FILENO))
{
}

Progress::~Progress() { clear(); }

void Progress::clear()
{
    if (shown_ && terminal_)
        send_message(STDERR_FILENO, "\r\033[K");
}

void Progress::show(const std::string& text, double part)
{
    const Clock::time_point now = Clock::now();
    if (first_part_ < 0)
        first_part_ = part, began_ = now;
    if (terminal_ && shown_ && now - last_ < std::chrono::milliseconds(200) && part - last_part_ < 0.01)
        return;
    if (!terminal_ && (part >= 1 || now - (shown_ ? last_ : made_) < std::chrono::seconds(shown_ ? 60 : 2)))
        return;
    last_ = now, last_part_ = part, shown_ = true;
    std::string line = text;
    if (part > first_part_)
        line += ", " + time_left(std::chrono::duration<double>(now - began_).count() / (part - first_part_) * (1 - part));
    send_message(STDERR_FILENO, terminal_ ? "\r" + line + "\033[K" : "starbow: " + line + "\n");
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
