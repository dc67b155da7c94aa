#include "head_tracker.h"
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cmath>
#include <cstring>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace starbow {
namespace {

constexpr double farthest_m = 10, hold_s = 1, return_s = 2;

} // namespace

std::optional<Head> parse_head(std::span<const std::byte> packet)
{
    std::array<double, 6> values;
    if (packet.size() != sizeof values)
        return {};
    std::memcpy(values.data(), packet.data(), sizeof values); // supported machines are little-endian
    Head head;
    head.moved_m = 0.01 * glm::dvec3(values[0], values[1], values[2]);
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (!finite || !(glm::length(head.moved_m) <= farthest_m))
        return {};
    const glm::dvec3 angles = glm::radians(glm::dvec3(values[3], values[4], values[5]));
    head.turned = glm::angleAxis(angles.x, glm::dvec3(0, 1, 0)) * glm::angleAxis(angles.y, glm::dvec3(1, 0, 0))
        * glm::angleAxis(angles.z, glm::dvec3(0, 0, 1));
    return head;
}

Head held(const Head& last, double silent_s)
{
    const double back = glm::smoothstep(0.0, 1.0, (silent_s - hold_s) / return_s);
    return {(1 - back) * last.moved_m, glm::slerp(last.turned, glm::dquat(1, 0, 0, 0), back)};
}

HeadTracker::HeadTracker(const HeadTracking& tracking, LogTo log)
    : tracking_(tracking)
    , log_(log)
    , awaited_("the head tracker's port " + std::to_string(tracking.port) + " of " + tracking.address, std::move(log))
{
}

HeadTracker::~HeadTracker()
{
    if (socket_ >= 0)
        close(socket_);
}

void HeadTracker::open(std::chrono::steady_clock::time_point now)
{
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(std::uint16_t(tracking_.port));
    inet_pton(AF_INET, tracking_.address.c_str(), &at.sin_addr); // the layout's reader has seen to it
    const int made = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (made >= 0 && bind(made, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0) {
        socket_ = made;
        awaited_.comes();
        return;
    }
    const std::string why = std::strerror(errno);
    if (made >= 0)
        close(made);
    awaited_.fails(why, now);
}

Head HeadTracker::read(std::chrono::steady_clock::time_point now)
{
    if (awaited_.is_due(now))
        open(now);
    std::array<std::byte, 64> packet;
    // Limits the packets of a frame, so that a faulty sender can't hold it up.
    for (int i = 0; i < 1000 && socket_ >= 0; ++i) {
        const ssize_t size = recv(socket_, packet.data(), packet.size(), 0);
        if (size < 0)
            break;
        const auto head = parse_head({packet.data(), std::size_t(size)});
        if (!head) {
            if (!std::exchange(said_wrong_, true))
                log_(LogKind::tracker_wrong_packets,
                    "the head tracker on port " + std::to_string(tracking_.port)
                        + " sends packets that hold no pose of a head (" + std::to_string(size)
                        + " bytes, not finite, or far away); they are left out");
            continue;
        }
        last_ = *head;
        last_.moved_m = glm::clamp(head->moved_m, -tracking_.room_m, tracking_.room_m);
        heard_ = now;
        if (last_.moved_m != head->moved_m && !std::exchange(said_outside_, true))
            log_(LogKind::tracker_outside,
                "the head tracker on port " + std::to_string(tracking_.port)
                    + " reports a head outside the layout's room_m; it is drawn at the room's edge");
    }
    return heard_ ? held(last_, std::chrono::duration<double>(now - *heard_).count()) : Head{};
}

bool HeadTracker::heard(std::chrono::steady_clock::time_point now) const
{
    return heard_ && now - *heard_ < std::chrono::duration<double>(hold_s + return_s);
}

} // namespace starbow
