#include "input/head_tracker.h"
#include "tests/support/waiting.h"
#include <arpa/inet.h>
#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <sys/socket.h>
#include <unistd.h>

namespace head_tracker_test {

using namespace starbow;
using namespace starbow::testing;
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

/// A listener on the first free port from 42420 on. said: receives its lines.
std::unique_ptr<HeadTracker> listener(std::vector<std::string>* said = nullptr)
{
    for (int port = 42420;; ++port) {
        auto tracker = std::make_unique<HeadTracker>(
            HeadTracking{port, "127.0.0.1", {3, 1, 0.5}}, [said](LogKind kind, const std::string& line) {
                if (said && kind != LogKind::network_waits)
                    said->push_back(line);
            });
        tracker->read(std::chrono::steady_clock::now());
        if (tracker->lack().empty() || port > 42600)
            return tracker;
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
    EXPECT_TRUE(until([&] { return tracker->read(now).moved_m == dvec3(3, 0, 0); }));
    EXPECT_EQ(tracker->read(now + 10s).moved_m, dvec3(0));
    EXPECT_FALSE(tracker->heard(now + 10s));
}

TEST(HeadTrackerTest, AHeadStaysInTheLayoutsRoom)
{
    std::vector<std::string> said;
    auto tracker = listener(&said);
    Sender sender(tracker->tracking().port);
    auto now = std::chrono::steady_clock::now();
    // Each packet comes so long after the one before that the tracker has become silent: it is heard again with this one.
    const auto read_after = [&](const Packet& packet) {
        now += 10s;
        EXPECT_FALSE(tracker->heard(now));
        sender.send(packet.data(), sizeof packet);
        EXPECT_TRUE(until([&] { return (void)tracker->read(now), tracker->heard(now); }));
        return tracker->read(now).moved_m;
    };
    EXPECT_EQ(read_after({-299, 100, 50, 0, 0, 0}), dvec3(-2.99, 1, 0.5));
    EXPECT_TRUE(said.empty());
    EXPECT_EQ(read_after({-800, 101, 49, 0, 0, 0}), dvec3(-3, 1, 0.49));
    EXPECT_EQ(read_after({10, 20, -900, 0, 0, 0}), dvec3(0.1, 0.2, -0.5));
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("outside the layout's room_m"), std::string::npos) << said[0];
}

TEST(HeadTrackerTest, APacketThatIsNoHeadLeavesTheHeadBefore)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Packet& wrong : {Packet{0, nan, 0, 0, 0, 0}, Packet{1e9, 0, 0, 0, 0, 0}}) {
        std::vector<std::string> said;
        auto tracker = listener(&said);
        Sender sender(tracker->tracking().port);
        const auto now = std::chrono::steady_clock::now();
        const Packet right{10, 20, -40, 0, 0, 0};
        sender.send(right.data(), sizeof right);
        ASSERT_TRUE(until([&] { return tracker->read(now).moved_m == dvec3(0.1, 0.2, -0.4); }));
        sender.send(wrong.data(), sizeof wrong);
        ASSERT_TRUE(until([&] { return (void)tracker->read(now + 1s), !said.empty(); }));
        EXPECT_NE(said[0].find("no pose of a head"), std::string::npos) << said[0];
        EXPECT_EQ(tracker->read(now + 1s).moved_m, dvec3(0.1, 0.2, -0.4));
        EXPECT_FALSE(tracker->heard(now + 3s)) << "it counts as a head";
        sender.send(wrong.data(), sizeof wrong);
        sender.send(right.data(), sizeof right);
        ASSERT_TRUE(until([&] { return (void)tracker->read(now + 10s), tracker->heard(now + 10s); }));
        EXPECT_EQ(said.size(), 1u) << "it is said once";
    }
}

/// The exhibit is not dark for want of its tracker: what is missing is said once, and tried again once a second.
TEST(HeadTrackerTest, APortInUseIsWaitedForAndTakenUp)
{
    auto tracker = listener();
    std::vector<std::string> said;
    const HeadTracking wanted = tracker->tracking();
    HeadTracker second(wanted, [&](LogKind, const std::string& line) { said.push_back(line); });
    auto now = std::chrono::steady_clock::now();
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(second.read(now + i * 2s).moved_m, dvec3(0));
    const std::string place = "the head tracker's port " + std::to_string(wanted.port) + " of 127.0.0.1";
    EXPECT_EQ(said,
        std::vector<std::string>{place
            + " can't be had (Address already in use); the exhibit goes on without it, "
              "and takes it up once it is there"});
    EXPECT_EQ(second.lack(), place + " can't be had (Address already in use)");
    tracker.reset();
    now += 8s;
    second.read(now + 500ms); // not tried yet
    EXPECT_EQ(said.size(), 1u);
    second.read(now + 1s);
    ASSERT_EQ(said.size(), 2u);
    EXPECT_EQ(said[1], place + " is there now");
    EXPECT_EQ(second.lack(), "");
    Sender sender(wanted.port);
    const Packet packet{10, 20, -40, 0, 0, 0};
    sender.send(packet.data(), sizeof packet);
    EXPECT_TRUE(until([&] { return second.read(now + 2s).moved_m == dvec3(0.1, 0.2, -0.4); }));
}

/// 192.0.2.0/24 is nobody's (RFC 5737).
TEST(HeadTrackerTest, AnAddressThatTheMachineLacksIsWaitedFor)
{
    std::vector<std::string> said;
    HeadTracker tracker({42420, "192.0.2.7", {3, 1, 0.5}}, [&](LogKind, const std::string& line) { said.push_back(line); });
    const auto now = std::chrono::steady_clock::now();
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(tracker.read(now + i * 2s).moved_m, dvec3(0));
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("of 192.0.2.7 can't be had (Cannot assign requested address)"), std::string::npos) << said[0];
    EXPECT_FALSE(tracker.heard(now + 6s));
}

} // namespace head_tracker_test
