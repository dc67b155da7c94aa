#pragma once
#include <string>

namespace starbow {

/// A network interface of this machine.
struct NetworkInterface {
    std::string name, address; ///< "enp3s0", "192.168.7.2"
    bool loopback = false;
    bool multicast = false;
};

/// The interface of a name ("enp3s0", "lo"), or the one with an IPv4 address in a network ("192.168.7.0/24"). Throws
/// InputError, with those that this machine has.
NetworkInterface interface_of(const std::string& wanted);

/// True where a route through a gateway leads out of the interface's network. routes: the file of the system's routes.
bool leads_elsewhere(const NetworkInterface& interface, const std::string& routes = "/proc/net/route");

} // namespace starbow
