#include "service.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <unistd.h>

namespace starbow {
namespace {

std::string microseconds(double seconds) { return std::to_string(std::llround(1e6 * seconds)); }

/// One line: a line's end would begin another assignment.
std::string status_line(std::string status)
{
    std::replace(status.begin(), status.end(), '\n', ' ');
    return "STATUS=" + status + "\n";
}

} // namespace

Service::Service()
    : manager_(std::getenv("NOTIFY_SOCKET"))
{
    const char *time = std::getenv("WATCHDOG_USEC"), *process = std::getenv("WATCHDOG_PID");
    const double seconds = time ? std::atof(time) / 1e6 : 0;
    if (seconds > 0 && (!process || std::atol(process) == long(getpid())))
        watchdog_s_ = seconds;
}

void Service::loads(const std::string& status, double limit_s)
{
    std::string message = "EXTEND_TIMEOUT_USEC=" + microseconds(limit_s) + "\n";
    if (ready_ && watchdog_s_) { // from READY=1 on the manager's other clock runs
        message += "WATCHDOG_USEC=" + microseconds(limit_s) + "\n";
        extended_ = true;
    }
    if (status != status_)
        message += status_line(status);
    if (manager_.send(message))
        status_ = status;
}

void Service::shows(const std::string& status, Clock::time_point now)
{
    if (!ready_)
        ready_ = manager_.send("READY=1\n");
    lives(status, now);
}

void Service::waits(const std::string& status, Clock::time_point now)
{
    if (!ready_ && now - sent_ > std::chrono::seconds(1))
        manager_.send("EXTEND_TIMEOUT_USEC=10000000\n"); // projectors may take longer to start than their computer
    lives(status, now);
}

void Service::lives(const std::string& status, Clock::time_point now)
{
    const double interval_s = std::min(0.1 * watchdog_s_.value_or(10), 1.0);
    if (status == status_ && !extended_ && now - sent_ < std::chrono::duration<double>(interval_s))
        return;
    std::string message = "WATCHDOG=1\n";
    if (extended_)
        message += "WATCHDOG_USEC=" + microseconds(*watchdog_s_) + "\n";
    if (status != status_)
        message += status_line(status);
    if (!manager_.send(message))
        return;
    status_ = status, extended_ = false, sent_ = now;
}

void Service::stops() { manager_.send("STOPPING=1\n" + status_line("The exhibit closes.")); }

} // namespace starbow
