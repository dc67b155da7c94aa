#pragma once
#include "config/json/error.h"
#include <string>

namespace starbow {

/// A network interface of this machine.
struct NetworkInterface {
    std::string name, address; ///< "enp3s0", "192.168.7.2"
    bool loopback = false;
    bool multicast = false;
};

/// This machine has no interface of the wanted name or network.
struct NoInterface : InputError {
    using InputError::InputError;
};

/// The interface of a name ("enp3s0", "lo"), or the one with an IPv4 address in a network ("192.168.7.0/24"). Throws
/// NoInterface, with those that this machine has, and InputError for a text that is no network.
NetworkInterface interface_of(const std::string& wanted);

/// True where this machine has an address, IPv4 or IPv6; of 0.0.0.0 and ::, too, which are all of them.
bool is_here(const std::string& address);

/// True where a route through a gateway leads out of the interface's network. routes: the file of the system's routes.
bool leads_elsewhere(const NetworkInterface& interface, const std::string& routes = "/proc/net/route");

} // namespace starbow
