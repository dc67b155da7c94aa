#pragma once
#include "config/model/programme_file.h"
#include "config/model/remote_file.h"
#include "input/command.h"
#include "snapshot.h"
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

// All bytes from the network are read here, and by command_of: pure functions that refuse all damage with an
// InputError, and never with another exception.

constexpr std::size_t most_message_bytes = 4096;

/// A page's message: {"id": 7, "command": ["scene", "avenue"]}, or {"id": 8, "picture": true} to get live pictures.
struct Request {
    int id = 0; ///< the page's own number, which the answer repeats
    std::optional<Command> command;
    std::optional<bool> picture;
};
Request request_of(std::string_view text);
/// The id of a message that request_of has refused; 0 where it has none.
int id_of(std::string_view text);

/// The PIN of a login's body, {"pin": "123456"}.
std::string pin_of(std::string_view text);

/// The token in a Cookie header; empty: none.
std::string_view token_of(std::string_view cookies);

/// True if the text of a Host header is a name on the list, with the remote's port.
bool host_is_listed(std::string_view host, const RemoteSettings& settings);
/// True if an Origin header is the page of that host.
bool origin_is_of(std::string_view origin, std::string_view host, bool tls);

/// An IP address as it is compared: IPv4 also where a socket of IPv6 shows it.
std::string plain_address(std::string_view address);
/// The same, where an IPv6 address stands for the 2^64 that one household or one machine has.
std::string counted_address(std::string_view address);

/// Commands of one datagram: OSC messages such as /starbow/scene avenue, alone or in a bundle.
std::vector<Command> commands_of_osc(std::span<const unsigned char> bytes);

// Messages to a page, as JSON.
std::string status_text(const Snapshot& snapshot, bool engineer);
std::string condition_text(const Condition& condition); ///< without the metrics
std::string answer_text(int id, const std::string& refusal);
std::string hello_text(Role role, const std::string& version);
/// The kinds of command with their role and value, the names that may be chosen, and the programme, if there is one.
std::string lists_text(const std::vector<std::string>& patterns, const std::optional<Programme>& programme);
/// The page's own words in every language: {"en": {"remote.stop": ...}}.
std::string words_text();

} // namespace starbow
