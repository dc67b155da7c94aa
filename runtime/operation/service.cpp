#include "service.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace starbow {
namespace {

/// A datagram socket that is connected to the manager's, or -1. name: a path, or "@" and an abstract name.
int connected(const char* name)
{
    sockaddr_un address{};
    const std::size_t length = name ? std::strlen(name) : 0;
    if (length < 2 || (name[0] != '/' && name[0] != '@') || length >= sizeof address.sun_path)
        return -1;
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name, length);
    if (name[0] == '@')
        address.sun_path[0] = '\0';
    // A path ends with a zero. An abstract name has exactly its length, zeros included.
    const std::size_t end = offsetof(sockaddr_un, sun_path) + length + (name[0] == '/');
    const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket < 0 || connect(socket, reinterpret_cast<const sockaddr*>(&address), socklen_t(end)) == 0)
        return socket;
    close(socket);
    return -1;
}

std::string microseconds(double seconds) { return std::to_string(std::llround(1e6 * seconds)); }

/// One line: a line's end would begin another assignment.
std::string status_line(std::string status)
{
    std::replace(status.begin(), status.end(), '\n', ' ');
    return "STATUS=" + status + "\n";
}

} // namespace

Service::Service()
    : socket_(connected(std::getenv("NOTIFY_SOCKET")))
{
    const char *time = std::getenv("WATCHDOG_USEC"), *process = std::getenv("WATCHDOG_PID");
    const double seconds = time ? std::atof(time) / 1e6 : 0;
    if (seconds > 0 && (!process || std::atol(process) == long(getpid())))
        watchdog_s_ = seconds;
}

Service::~Service()
{
    if (socket_ >= 0)
        close(socket_);
}

bool Service::send(const std::string& message)
{
    // A manager that does not read must not hold up a frame.
    return socket_ >= 0 && ::send(socket_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
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
    if (send(message))
        status_ = status;
}

void Service::shows(const std::string& status)
{
    if (!ready_)
        ready_ = send("READY=1\n");
    lives(status);
}

void Service::waits(const std::string& status)
{
    if (!ready_ && Clock::now() - sent_ > std::chrono::seconds(1))
        send("EXTEND_TIMEOUT_USEC=10000000\n"); // projectors may take longer to start than their computer
    lives(status);
}

void Service::lives(const std::string& status)
{
    const Clock::time_point now = Clock::now();
    const double interval_s = std::min(0.1 * watchdog_s_.value_or(10), 1.0);
    if (status == status_ && !extended_ && now - sent_ < std::chrono::duration<double>(interval_s))
        return;
    std::string message = "WATCHDOG=1\n";
    if (extended_)
        message += "WATCHDOG_USEC=" + microseconds(*watchdog_s_) + "\n";
    if (status != status_)
        message += status_line(status);
    if (!send(message))
        return;
    status_ = status, extended_ = false, sent_ = now;
}

void Service::stops() { send("STOPPING=1\n" + status_line("The exhibit closes.")); }

} // namespace starbow
