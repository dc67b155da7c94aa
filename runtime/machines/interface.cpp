#include "interface.h"
#include "config/json/whole_file.h"
#include <arpa/inet.h>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <ifaddrs.h>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <optional>
#include <sstream>
#include <vector>

namespace starbow {
namespace {

struct Network {
    std::uint32_t address = 0, mask = 0; ///< host byte order
};

/// "192.168.7.0/24".
std::optional<Network> network_of(const std::string& text)
{
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos)
        return {};
    int bits = -1;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + slash + 1, end, bits);
    in_addr address{};
    if (error != std::errc() || stop != end || bits < 1 || bits > 32
        || inet_pton(AF_INET, text.substr(0, slash).c_str(), &address) != 1)
        throw InputError("interface \"" + text + "\" is not a network; one such as \"192.168.7.0/24\" is right");
    return Network{ntohl(address.s_addr), std::uint32_t(~std::uint64_t(0) << (32 - bits))};
}

} // namespace

NetworkInterface interface_of(const std::string& wanted)
{
    const std::optional<Network> network = network_of(wanted);
    ifaddrs* first = nullptr;
    if (getifaddrs(&first) != 0)
        throw InputError("The network interfaces of this machine can't be listed");
    const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> list(first, freeifaddrs);
    std::string known;
    for (const ifaddrs* at = first; at; at = at->ifa_next) {
        if (!at->ifa_addr || at->ifa_addr->sa_family != AF_INET || !(at->ifa_flags & IFF_UP))
            continue;
        const std::uint32_t address = ntohl(reinterpret_cast<const sockaddr_in*>(at->ifa_addr)->sin_addr.s_addr);
        char text[INET_ADDRSTRLEN];
        inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(at->ifa_addr)->sin_addr, text, sizeof text);
        if (network ? (address & network->mask) == (network->address & network->mask) : wanted == at->ifa_name)
            return {at->ifa_name, text, (at->ifa_flags & IFF_LOOPBACK) != 0, (at->ifa_flags & IFF_MULTICAST) != 0};
        known += (known.empty() ? "" : ", ") + std::string(at->ifa_name) + " (" + text + ")";
    }
    throw NoInterface("interface \"" + wanted + "\" is none of this machine; one of these is right: " + known);
}

bool is_here(const std::string& address)
{
    in6_addr six{};
    in_addr four{};
    const bool v6 = inet_pton(AF_INET6, address.c_str(), &six) == 1;
    if (!v6 && inet_pton(AF_INET, address.c_str(), &four) != 1)
        return false;
    if (v6 ? IN6_IS_ADDR_UNSPECIFIED(&six) : four.s_addr == INADDR_ANY)
        return true;
    if (!v6 && ntohl(four.s_addr) >> 24 == IN_LOOPBACKNET)
        return true; // each of 127.0.0.0/8, of which one alone is listed
    ifaddrs* first = nullptr;
    if (getifaddrs(&first) != 0)
        return false;
    const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> list(first, freeifaddrs);
    for (const ifaddrs* at = first; at; at = at->ifa_next) {
        if (!at->ifa_addr || at->ifa_addr->sa_family != (v6 ? AF_INET6 : AF_INET))
            continue;
        const in6_addr& one = reinterpret_cast<const sockaddr_in6*>(at->ifa_addr)->sin6_addr;
        if (v6 ? std::memcmp(&one, &six, sizeof six) == 0
               : reinterpret_cast<const sockaddr_in*>(at->ifa_addr)->sin_addr.s_addr == four.s_addr)
            return true;
    }
    return false;
}

bool leads_elsewhere(const NetworkInterface& interface, const std::string& routes)
{
    std::istringstream file(RegularFile(routes).read_all(1 << 20));
    std::string line;
    std::getline(file, line); // the columns' names
    while (std::getline(file, line)) {
        std::istringstream columns(line);
        std::string name, destination, gateway;
        unsigned flags = 0;
        constexpr unsigned through_gateway = 2; // RTF_GATEWAY
        if (columns >> name >> destination >> gateway >> std::hex >> flags && name == interface.name
            && (flags & through_gateway))
            return true;
    }
    return false;
}

} // namespace starbow
