#include "remote_reader.h"
#include "config/json/reader.h"
#include <algorithm>
#include <arpa/inet.h>

namespace starbow {
namespace {

constexpr std::size_t most_names = 64;

std::string ip_address(const Place& place)
{
    const std::string address = text(place);
    in6_addr parsed{};
    if (inet_pton(AF_INET, address.c_str(), &parsed) != 1 && inet_pton(AF_INET6, address.c_str(), &parsed) != 1)
        complain(place, "is not an IP address; one such as \"127.0.0.1\" is right");
    return address;
}

/// A name or an IP address, as a browser's address line shows it: without scheme and port, IPv6 in brackets.
std::string host_name(const Place& place)
{
    std::string name = text(place);
    for (char& c : name)
        if (c >= 'A' && c <= 'Z')
            c = char(c - 'A' + 'a');
    in6_addr parsed{};
    const bool v6 = name.size() > 2 && name.front() == '[' && name.back() == ']'
        && inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), &parsed) == 1;
    const bool plain = name.size() <= 253 && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    });
    if (!v6 && !plain)
        complain(place, "is not a host's name; one such as \"starbow.local\", without scheme and port, is right");
    return name;
}

OscSettings read_osc(const Place& place)
{
    reject_unknown_members(place, {"port", "from", "role"});
    OscSettings osc;
    osc.port = integer(member(place, "port"), 1, 65535);
    for (const Place& address : items(member(place, "from"), 1, most_names, "IP addresses that may send commands"))
        osc.from.push_back(ip_address(address));
    if (auto p = find_member(place, "role"))
        osc.engineer = one_of(*p, {"docent", "engineer"}) == "engineer";
    return osc;
}

} // namespace

RemoteSettings read_remote(const Place& place, const std::filesystem::path& folder)
{
    reject_unknown_members(place, {"port", "address", "hosts", "certificate", "key", "pins", "osc"});
    RemoteSettings remote;
    remote.port = integer(member(place, "port"), 1, 65535);
    if (auto p = find_member(place, "address"))
        remote.address = ip_address(*p);
    if (auto p = find_member(place, "hosts"))
        for (const Place& name : items(*p, 0, most_names, "names"))
            remote.hosts.push_back(host_name(name));
    for (const auto& [name, file] :
        {std::pair{"certificate", &remote.certificate}, {"key", &remote.key}, {"pins", &remote.pins}})
        if (auto p = find_member(place, name))
            *file = (folder / text(*p)).lexically_normal();
    if (remote.certificate.empty() != remote.key.empty())
        complain(place, "has only one of certificate and key; both or none is right");
    if (auto p = find_member(place, "osc"))
        remote.osc = read_osc(*p);
    return remote;
}

} // namespace starbow
