#include "local_datagrams.h"
#include <cstddef>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace starbow {
namespace {

int connected_to(const char* name)
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

} // namespace

LocalDatagrams::LocalDatagrams(const char* name)
    : socket_(connected_to(name))
{
}

LocalDatagrams::~LocalDatagrams()
{
    if (socket_ >= 0)
        close(socket_);
}

bool LocalDatagrams::send(const std::string& message) const
{
    return connected() && ::send(socket_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

} // namespace starbow
