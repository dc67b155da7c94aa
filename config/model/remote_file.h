#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// Commands by OSC, which knows no login: by the sender's address alone.
struct OscSettings {
    int port = 0; ///< UDP; 0: OSC is not served
    std::vector<std::string> from; ///< IP addresses that may send commands
    bool engineer = false; ///< the senders may do what an engineer may, not only what a docent may
};

/// The remote of an exhibit: who may reach it, and where.
struct RemoteSettings {
    int port = 0; ///< TCP; 0: there is no remote
    std::string address = "127.0.0.1"; ///< an IP address of this machine; 0.0.0.0 or ::, all of them
    std::vector<std::string> hosts; ///< names by which browsers reach it, beside the address and localhost
    std::filesystem::path certificate, key; ///< PEM files; empty: no TLS
    std::filesystem::path pins; ///< empty: /etc/starbow/pins if it exists, else drawn at random
    OscSettings osc;
};

} // namespace starbow
