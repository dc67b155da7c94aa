#include "config/json/error.h"
#include "input/head_tracker.h"
#include <arpa/inet.h>
#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace head_tracker_test {

using namespace starbow;
using namespace std::chrono_literals;
using glm::dvec3;

namespace {

using Packet = std::array<double, 6>;

std::optional<Head> parsed(const Packet& packet) { return parse_head(std::as_bytes(std::span(packet))); }

/// A tracker on this computer.
class Sender {
public:
    explicit Sender(int port)
    {
        to_.sin_family = AF_INET;
        to_.sin_port = htons(std::uint16_t(port));
        to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    }
    ~Sender() { close(socket_); }
    void send(const void* bytes, std::size_t size)
    {
        ASSERT_EQ(sendto(socket_, bytes, size, 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_), ssize_t(size));
    }

private:
    int socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to_{};
};

/// A listener on the first free port from 42420 on.
std::unique_ptr<HeadTracker> listener()
{
    for (int port = 42420;; ++port)
        try {
            return std::make_unique<HeadTracker>(HeadTracking{port, "127.0.0.1"});
        } catch (const InputError&) {
            if (port > 42600)
                throw;
        }
}

void expect_near(const dvec3& a, const dvec3& b, double within)
{
    EXPECT_LE(glm::distance(a, b), within) << a.x << " " << a.y << " " << a.z;
}

} // namespace

TEST(HeadTrackerTest, PacketsAreCentimetresAndDegrees)
{
    const auto head = parsed({10, -20, 30, 90, 0, 0});
    ASSERT_TRUE(head);
    expect_near(head->moved_m, {0.1, -0.2, 0.3}, 1e-15);
    expect_near(head->turned * dvec3(1, 0, 0), {0, 0, -1}, 1e-12); // yawed to the left, the right hand is ahead
    expect_near(parsed({0, 0, 0, 0, 90, 0})->turned * dvec3(0, 0, -1), {0, 1, 0}, 1e-12); // pitched up, ahead is up
    expect_near(parsed({0, 0, 0, 0, 0, 90})->turned * dvec3(1, 0, 0), {0, 1, 0}, 1e-12); // rolled to the left, right is up
}

TEST(HeadTrackerTest, PacketsThatAreNoHeadAreRefused)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 6; ++i)
        for (double bad : {nan, inf, -inf}) {
            Packet packet{};
            packet[i] = bad;
            EXPECT_FALSE(parsed(packet)) << i << " " << bad;
        }
    EXPECT_FALSE(parsed({1001, 0, 0, 0, 0, 0}));
    EXPECT_FALSE(parsed({1e300, 1e300, 0, 0, 0, 0}));
    EXPECT_TRUE(parsed({0, 999, 0, 0, 0, 0}));
    const Packet packet{};
    for (std::size_t size : {0, 1, 47})
        EXPECT_FALSE(parse_head(std::as_bytes(std::span(packet)).first(size)));
    const std::array<double, 7> longer{};
    EXPECT_FALSE(parse_head(std::as_bytes(std::span(longer))));
}

TEST(HeadTrackerTest, ASilentTrackersHeadGoesBack)
{
    const Head last{{0.3, 0, 0}, glm::angleAxis(1.0, dvec3(0, 1, 0))};
    EXPECT_EQ(held(last, 0).moved_m, last.moved_m);
    EXPECT_EQ(held(last, 1).moved_m, last.moved_m);
    EXPECT_EQ(held(last, 3).moved_m, dvec3(0));
    EXPECT_NEAR(held(last, 3).turned.w, 1, 1e-12);
    EXPECT_NEAR(held(last, 2).moved_m.x, 0.15, 1e-12);
    double before = 1;
    for (double t = 0; t < 5; t += 0.01) {
        const double x = held(last, t).moved_m.x;
        EXPECT_LE(x, before);
        EXPECT_LE(before - x, t == 0 ? 1 : 0.3 * 1.5 / 2 * 0.01 + 1e-12); // smoothstep is steepest in its middle: 3/2
        before = x;
    }
}

TEST(HeadTrackerTest, TheLastOfManyPacketsCounts)
{
    auto tracker = listener();
    const auto now = std::chrono::steady_clock::now();
    EXPECT_FALSE(tracker->heard(now));
    EXPECT_EQ(tracker->read(now).moved_m, dvec3(0));
    Sender sender(tracker->tracking().port);
    for (double x : {1.0, 2.0, 3.0}) {
        const Packet packet{100 * x, 0, 0, 0, 0, 0};
        sender.send(packet.data(), sizeof packet);
    }
    sender.send("no head", 7);
    for (int i = 0; i < 200 && !tracker->heard(now); ++i) {
        std::this_thread::sleep_for(5ms);
        (void)tracker->read(now);
    }
    EXPECT_EQ(tracker->read(now).moved_m, dvec3(3, 0, 0));
    EXPECT_EQ(tracker->read(now + 10s).moved_m, dvec3(0));
    EXPECT_FALSE(tracker->heard(now + 10s));
}

TEST(HeadTrackerTest, APortInUseIsReported)
{
    auto tracker = listener();
    try {
        HeadTracker again(tracker->tracking());
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(tracker->tracking().port)), std::string::npos);
    }
}

} // namespace head_tracker_test
