#include "describe_exhibit.h"
#include "describe_layout.h"
#include <algorithm>
#include <arpa/inet.h>

namespace starbow {

std::string NameOrPath::read(const Place& place, const Folder& folder) const
{
    const std::string name = text(place);
    const bool path = name.find('/') != name.npos || name.ends_with(".json") || name.ends_with(".jsonl");
    return path ? (folder.path / name).lexically_normal().string() : name;
}

std::string read_unlock(const Place& place, const Folder&)
{
    const std::string word = text(place);
    const bool typeable = word.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz") == std::string::npos;
    if (!typeable || word.size() < 4 || word.size() > 32)
        fail_at(place, "can't be typed blind; 4 to 32 small letters and digits are right");
    return word;
}

std::string read_identity(const Place& place, const Folder&)
{
    const std::string identity = text(place);
    if (identity.size() > 64)
        fail_at(place, "can't name an exhibit; 1 to 64 letters, the same on each of its machines, are right");
    return identity;
}

std::string IpAddress::read(const Place& place, const Folder&) const
{
    const std::string address = text(place);
    in6_addr parsed{};
    if (inet_pton(AF_INET, address.c_str(), &parsed) != 1 && inet_pton(AF_INET6, address.c_str(), &parsed) != 1)
        fail_at(place, "is not an IP address; one such as \"127.0.0.1\" is right");
    return address;
}

std::string read_host_name(const Place& place, const Folder&)
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
        fail_at(place, "is not a host's name; one such as \"starbow.local\", without scheme and port, is right");
    return name;
}

void check(const Place& place, const Comfort& comfort, const Folder&)
{
    if (comfort.vignette && comfort.turn_steps_deg > 0)
        fail_at(
            member(place, "vignette"), "conflicts with turn_steps_deg, which leaves no smooth turn; one of them is right");
}

void check(const Place& place, const Exposing& exposing, const Folder&)
{
    if (exposing.max_ev < exposing.min_ev) {
        const auto least = find_member(place, "min_ev");
        fail_at(least ? *least : member(place, "max_ev"),
            "leaves nothing between min_ev, " + shown(exposing.min_ev) + ", and max_ev, " + shown(exposing.max_ev)
                + "; a min_ev that is no greater is right");
    }
}

void check(const Place& place, const RemoteSettings& remote, const Folder&)
{
    if (remote.certificate.empty() != remote.key.empty())
        fail_at(place, "has only one of certificate and key; both or none is right");
}

void check(const Place& place, const Exhibit& exhibit, const Folder&)
{
    if (auto scene = find_member(place, "scene"); scene && !exhibit.shot.empty())
        fail_at(*scene, "conflicts with the shot, which has a scene of its own; one of them is right");
    for (const char* other : {"scene", "shot"})
        if (auto at = find_member(place, other); at && !exhibit.tour.empty())
            fail_at(*at, "conflicts with the tour, which has a scene of its own; one of them is right");
    if (auto quality = find_member(place, "quality"); quality && exhibit.frame_budget_ms > 0)
        fail_at(*quality, "conflicts with frame_budget_ms, which chooses the quality; one of them is right");
}

Exhibit load_exhibit(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read<Exhibit>(root(document), std::filesystem::absolute(file).parent_path());
}

} // namespace starbow
