#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

struct TellOptions {
    std::string host = "127.0.0.1"; ///< a name on the exhibit's list, or an IP address
    int port = 8080;
    std::string pin;
    std::filesystem::path certificate; ///< the exhibit's, which is then reached by TLS; empty: without TLS
    double wait_s = 60; ///< for the exhibit to apply the command; a world takes some seconds
};

/// Logs in at a running exhibit, gives it one command and waits until it is applied. Throws InputError where it is refused
/// or the exhibit is not reached.
void tell(const TellOptions& options, const std::vector<std::string>& command);
/// The running exhibit's state, one line a value. Throws InputError.
std::string state_of_exhibit(const TellOptions& options);

} // namespace starbow
