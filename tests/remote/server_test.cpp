// The remote from outside: HTTP, WebSocket, OSC and `starbow tell` over sockets of the test's own, with this thread as the
// frame thread.
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "runtime/remote/remote.h"
#include "runtime/remote/tell.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"
#include <arpa/inet.h>
#include <atomic>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <sys/socket.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

/// libwebsockets 4.1.6 leaks the TLS context for clients that each vhost with TLS has: 16 kB for each opened remote.
extern "C" const char* __lsan_default_suppressions() { return "leak:libwebsockets.so\nleak:libcrypto.so\nleak:libssl.so\n"; }

namespace server_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

sockaddr_in address_of(const char* ip, int port)
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(std::uint16_t(port));
    inet_pton(AF_INET, ip, &address.sin_addr);
    return address;
}

int free_port(int type)
{
    const int probe = socket(AF_INET, type, 0);
    sockaddr_in address = address_of("127.0.0.1", 0);
    socklen_t size = sizeof address;
    bind(probe, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
    close(probe);
    return ntohs(address.sin_port);
}

/// A connection that reads with a limit of time.
class Wire {
public:
    explicit Wire(int port, const char* from = "127.0.0.1")
        : socket_(socket(AF_INET, SOCK_STREAM, 0))
    {
        const sockaddr_in address = address_of("127.0.0.1", port), own = address_of(from, 0);
        EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
        const timeval limit{.tv_sec = 10, .tv_usec = 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
        EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    }
    ~Wire() { close(socket_); }
    Wire(const Wire&) = delete;

    void send(const std::string& bytes) { ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
    /// Up to `size` bytes; fewer where the connection ends.
    std::string read(std::size_t size)
    {
        std::string bytes(size, '\0');
        std::size_t have = 0;
        for (ssize_t got = 1; have < size && got > 0; have += std::size_t(std::max<ssize_t>(got, 0)))
            got = recv(socket_, bytes.data() + have, size - have, 0);
        bytes.resize(have);
        return bytes;
    }
    std::string read_head()
    {
        std::string head;
        while (!head.ends_with("\r\n\r\n")) {
            const std::string one = read(1);
            if (one.empty())
                break;
            head += one;
        }
        return head;
    }
    /// Sends a WebSocket frame (RFC 6455, 5.2) with a mask of zeros.
    void send_frame(const std::string& text, int opcode = 1)
    {
        std::string head{char(0x80 | opcode)};
        if (text.size() < 126)
            head += char(0x80 | text.size());
        else
            head += {char(0x80 | 126), char(text.size() >> 8), char(text.size())};
        send(head + std::string(4, '\0') + text);
    }
    /// The next frame: its opcode and payload; opcode -1 at the end.
    std::pair<int, std::string> read_frame()
    {
        const std::string head = read(2);
        if (head.size() < 2)
            return {-1, ""};
        std::size_t size = head[1] & 127;
        if (size >= 126) {
            const std::string more = read(size == 126 ? 2 : 8);
            size = 0;
            for (const char byte : more)
                size = size << 8 | (unsigned char)(byte);
        }
        return {head[0] & 15, read(size)};
    }
    /// The next message with this member, past others.
    json read_message(const char* member)
    {
        for (int i = 0; i < 200; ++i) {
            const auto [opcode, text] = read_frame();
            if (opcode == 8 || opcode < 0)
                return nullptr;
            const json message = opcode == 1 ? json::parse(text, nullptr, false) : json();
            if (message.contains(member))
                return message[member];
        }
        return nullptr;
    }
    /// The code of the close frame, past other frames; -1: the connection ends without one.
    int read_close()
    {
        for (int i = 0; i < 200; ++i) {
            const auto [opcode, text] = read_frame();
            if (opcode == 8 && text.size() >= 2)
                return (unsigned char)(text[0]) << 8 | (unsigned char)(text[1]);
            if (opcode < 0)
                break;
        }
        return -1;
    }

private:
    int socket_;
};

/// A running remote, whose frame thread answers "gone" with a refusal and all else as applied.
class Running {
public:
    explicit Running(const std::function<void(RemoteSettings&)>& change = {})
    {
        setenv("STATE_DIRECTORY", scratch("remote-state").c_str(), 1);
        settings.port = free_port(SOCK_STREAM);
        settings.pins = write_text("remote-pins", "look 111111\ndocent 222222\nengineer 333333\n");
        chmod(settings.pins.c_str(), 0600);
        settings.osc = {.port = free_port(SOCK_DGRAM), .from = {"127.0.0.1"}};
        if (change)
            change(settings);
        remote = std::make_unique<Remote>(RemoteOptions{.settings = settings,
            .patterns = {"none", "grid"},
            .programme = Programme{{{.tour = "rainbow", .minutes = 3, .notes = {.texts = {{"en", "Say hello."}}}}}},
            .version = "1.2.3",
            .thumbnails = {{"tour/rainbow", thumbnail}}});
        frames_ = std::thread([this] {
            NumberedCommand command;
            for (int frame = 0; !ends_; ++frame) {
                while (remote->take(command)) {
                    taken.push_back(words_of(command.command));
                    remote->answer(command.number, command.command.text == "gone" ? "There is no gone." : "");
                    scene = command.command.kind == CommandKind::scene ? command.command.text : scene;
                    ++count;
                }
                Snapshot& next = remote->next_snapshot() = {};
                next.scene = scene, next.step = frame, next.uptime_s = frame / 100.;
                remote->publish_snapshot();
                remote->next_condition().metrics = "frames_total " + std::to_string(frame) + "\n";
                remote->publish_condition();
                ++shown_;
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
        });
    }
    ~Running() { end(); }
    /// Afterwards `taken` may be read.
    void end()
    {
        frames_more(3);
        ends_ = true;
        if (frames_.joinable())
            frames_.join();
        remote.reset();
    }

    std::filesystem::path thumbnail = scratch("thumbnail") / "rainbow.png"; ///< the file may be written later
    std::string host() const { return "127.0.0.1:" + std::to_string(settings.port); }
    /// The whole answer to a request; headers end with \r\n each.
    std::string http(const std::string& line, const std::string& headers = "", const std::string& body = "",
        const char* from = "127.0.0.1") const
    {
        Wire wire(settings.port, from);
        wire.send(line + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers
            + (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" + body);
        const std::string head = wire.read_head();
        const std::size_t length = head.find("content-length: ");
        return head + (length == head.npos ? "" : wire.read(std::stoul(head.substr(length + 16))));
    }
    int status(const std::string& line, const std::string& headers = "", const std::string& body = "",
        const char* from = "127.0.0.1") const
    {
        const std::string answer = http(line, headers, body, from);
        return answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
    }
    std::string origin() const { return "Origin: http://" + host() + "\r\n"; }
    /// The Cookie header of a login.
    std::string cookie(const std::string& pin) const
    {
        const std::string answer = http("POST /login", origin(), "{\"pin\":\"" + pin + "\"}");
        const std::size_t at = answer.find("set-cookie: ");
        EXPECT_NE(at, answer.npos) << answer;
        EXPECT_NE(answer.find("; HttpOnly; SameSite=Strict"), answer.npos);
        return at == answer.npos ? "" : "Cookie: " + answer.substr(at + 12, answer.find(';', at) - at - 12) + "\r\n";
    }
    std::unique_ptr<Wire> page(const std::string& pin) const
    {
        auto wire = std::make_unique<Wire>(settings.port);
        wire->send("GET / HTTP/1.1\r\nHost: " + host() + "\r\n" + origin() + cookie(pin) + upgrade);
        EXPECT_TRUE(wire->read_head().starts_with("HTTP/1.1 101"));
        return wire;
    }
    void osc(const char* from, const std::string& bytes) const
    {
        const int sender = socket(AF_INET, SOCK_DGRAM, 0);
        const sockaddr_in own = address_of(from, 0), to = address_of("127.0.0.1", settings.osc.port);
        EXPECT_EQ(bind(sender, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
        sendto(sender, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
        close(sender);
    }
    void wait_for(int commands) const
    {
        until([&] { return count >= commands; });
        EXPECT_EQ(count, commands);
    }
    /// Waits until the frame thread has begun and ended so many frames from here on.
    void frames_more(int frames) const
    {
        const int last = shown_ + frames + 1; // the frame that runs has begun before
        EXPECT_TRUE(until([&] { return ends_ || shown_ >= last; }));
    }
    TellOptions tell_options(const std::string& pin = "333333") const
    {
        return {.port = settings.port, .pin = pin, .certificate = {}};
    }

    static constexpr const char* upgrade
        = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: starbow\r\n\r\n";
    RemoteSettings settings;
    std::unique_ptr<Remote> remote;
    std::vector<std::vector<std::string>> taken;
    std::string scene = "avenue";
    std::atomic<int> count{0};

private:
    std::atomic<bool> ends_{false};
    std::atomic<int> shown_{0}; ///< frames
    std::thread frames_;
};

} // namespace

TEST(Server, ACommandIsAppliedAndTheStateIsShown)
{
    Running running;
    const auto page = running.page("222222");
    EXPECT_EQ(page->read_message("hello"), (json{{"role", "docent"}, {"version", "1.2.3"}}));
    EXPECT_EQ(page->read_message("status")["scene"], "avenue");
    page->send_frame(R"({"id":7,"command":["scene","twins"]})");
    EXPECT_EQ(page->read_message("answer"), (json{{"id", 7}, {"applied", true}}));
    json status;
    for (int i = 0; i < 5 && status["scene"] != "twins"; ++i)
        status = page->read_message("status");
    EXPECT_EQ(status["scene"], "twins");
    page->send_frame(R"({"id":8,"command":["scene","gone"]})");
    EXPECT_EQ(page->read_message("answer"), (json{{"id", 8}, {"applied", false}, {"refused", "There is no gone."}}));
    page->send_frame(R"({"id":9,"command":["restart"]})");
    EXPECT_EQ(page->read_message("answer")["applied"], false);
    page->send_frame("nonsense");
    EXPECT_EQ(page->read_message("answer")["id"], 0);
    EXPECT_EQ(running.count, 2);
}

TEST(Server, StatusesComeAtMostTenTimesASecond)
{
    Running running;
    // The first one is sent after `start`, so that a busy machine only lengthens the time.
    const auto start = std::chrono::steady_clock::now();
    const auto page = running.page("111111");
    for (int i = 0; i < 11; ++i)
        EXPECT_FALSE(page->read_message("status").is_null());
    EXPECT_GT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(950));
}

TEST(Server, StrangersGetNothing)
{
    Running running;
    const std::string body = R"({"pin":"222222"})", origin = running.origin();
    EXPECT_EQ(running.status("GET /"), 200);
    EXPECT_EQ(running.status("GET /nothing"), 404);
    EXPECT_EQ(running.status("GET /../../../etc/passwd"), 404);
    EXPECT_EQ(running.status("DELETE /"), 405);
    EXPECT_EQ(running.status("GET /lists"), 401);
    EXPECT_EQ(running.status("GET /", "Origin: http://evil.example\r\n"), 403);
    EXPECT_EQ(running.status("POST /login", "", body), 403);
    EXPECT_EQ(running.status("POST /login", "Origin: null\r\n", body), 403);
    EXPECT_EQ(running.status("POST /login", origin, "{}"), 400);
    EXPECT_EQ(running.status("POST /login", origin, R"({"pin":"222223"})"), 401);
    EXPECT_EQ(running.status("GET /", origin + Running::upgrade), 401);
    const std::string docent = running.cookie("222222");
    EXPECT_EQ(running.status("GET /", docent + Running::upgrade), 403);
    EXPECT_EQ(running.status("GET /", docent + "Origin: http://evil.example\r\n" + Running::upgrade), 403);
    Wire wire(running.settings.port);
    wire.send("GET / HTTP/1.1\r\nHost: evil.example:" + std::to_string(running.settings.port) + "\r\n\r\n");
    EXPECT_TRUE(wire.read_head().starts_with("HTTP/1.1 421"));
    const std::string page = running.http("GET /");
    for (const char* header : {"content-security-policy: default-src 'none'; script-src 'self'",
             "x-content-type-options: nosniff", "frame-ancestors 'none'", "cache-control: no-store"})
        EXPECT_NE(page.find(header), page.npos) << header;
}

TEST(Server, ATokenEndsWithItsLogoutAndSoDoItsPages)
{
    Running running;
    const std::string cookie = running.cookie("222222");
    Wire page(running.settings.port);
    page.send("GET / HTTP/1.1\r\nHost: " + running.host() + "\r\n" + running.origin() + cookie + Running::upgrade);
    EXPECT_TRUE(page.read_head().starts_with("HTTP/1.1 101"));
    EXPECT_EQ(running.status("GET /lists", cookie), 200);
    EXPECT_EQ(running.status("POST /logout", running.origin() + cookie, "x"), 200);
    EXPECT_EQ(running.status("GET /lists", cookie), 401);
    EXPECT_NE(page.read_close(), -1);
}

TEST(Server, AProgrammesNotesAreForDocents)
{
    Running running;
    EXPECT_EQ(running.http("GET /lists", running.cookie("111111")).find("Say hello."), std::string::npos);
    EXPECT_NE(running.http("GET /lists", running.cookie("222222")).find("Say hello."), std::string::npos);
}

TEST(Server, SmallPicturesAreThereWithALoginOnceTheyAreDrawn)
{
    Running running;
    const std::string cookie = running.cookie("111111");
    EXPECT_EQ(running.status("GET /thumbnail/tour/rainbow"), 401);
    EXPECT_EQ(running.status("GET /thumbnail/tour/rainbow", cookie), 404);
    std::filesystem::create_directories(running.thumbnail.parent_path());
    write_bytes(running.thumbnail, "\x89PNG and more");
    const std::string answer = running.http("GET /thumbnail/tour/rainbow", cookie);
    EXPECT_NE(answer.find("image/png"), std::string::npos);
    EXPECT_TRUE(answer.ends_with("\x89PNG and more"));
    for (const char* wrong : {"tour/none", "../rainbow.png", ""})
        EXPECT_EQ(running.status(std::string("GET /thumbnail/") + wrong, cookie), 404) << wrong;
    std::filesystem::remove(running.thumbnail);
}

TEST(Server, FiveWrongPinsLockLoginsButNotPages)
{
    Running running;
    const auto page = running.page("222222");
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(running.status("POST /login", running.origin(), R"({"pin":"999999"})"), 401);
    EXPECT_EQ(running.status("POST /login", running.origin(), R"({"pin":"999999"})"), 429);
    EXPECT_EQ(running.status("POST /login", running.origin(), R"({"pin":"222222"})"), 429);
    page->send_frame(R"({"id":7,"command":["stop"]})");
    EXPECT_EQ(page->read_message("answer")["applied"], true);
}

TEST(Server, LargeAndManyMessagesEndTheConnection)
{
    Running running;
    const std::string message = R"({"id":1,"command":["caption",")";
    const auto large = running.page("222222");
    large->send_frame(std::string(4096, ' '));
    EXPECT_EQ(large->read_message("answer")["applied"], false);
    large->send_frame(std::string(4097, ' '));
    EXPECT_EQ(large->read_close(), 1009);
    const auto parts = running.page("222222"); // and where it comes in parts
    for (int i = 0; i < 5; ++i) {
        std::string part(1000, ' ');
        std::string frame{
            char(i == 0 ? 1 : 0), char(0x80 | 126), char(part.size() >> 8), char(part.size() & 255), 0, 0, 0, 0};
        parts->send(frame.append(part));
    }
    EXPECT_EQ(parts->read_close(), 1009);
    const auto fast = running.page("222222");
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 1; i <= 30; ++i)
        fast->send_frame("{\"id\":" + std::to_string(i) + R"(,"command":["stop"]})");
    EXPECT_EQ(fast->read_close(), 1008);
    // Twenty, and twenty more for each second that a busy machine took.
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    running.end();
    EXPECT_LE(running.count, 21 + 20 * taken.count());
    EXPECT_GE(running.count, 20);
}

TEST(Server, ConnectionsAreBounded)
{
    Running running;
    const auto page = running.page("222222");
    std::vector<std::unique_ptr<Wire>> wires;
    for (int i = 0; i < 280; ++i)
        wires.push_back(std::make_unique<Wire>(running.settings.port));
    int alive = 0;
    for (const auto& wire : wires) {
        wire->send("GET /icon.svg HTTP/1.1\r\nHost: " + running.host() + "\r\n\r\n");
        alive += wire->read(12).starts_with("HTTP/1.1 200");
    }
    EXPECT_LE(alive, 255);
    EXPECT_GE(alive, 250);
    page->send_frame(R"({"id":7,"command":["stop"]})"); // who is in is served on
    EXPECT_EQ(page->read_message("answer")["applied"], true);
    wires.clear();
    EXPECT_TRUE(until([&] { return running.status("GET /") == 200; })) << "none is let in after they have gone";
}

TEST(Server, MetricsAreForThisMachineAndEngineers)
{
    Running running;
    std::string metrics;
    for (int i = 0; i < 100 && metrics.find("frames_total ") == metrics.npos; ++i)
        metrics = running.http("GET /metrics");
    EXPECT_NE(metrics.find("frames_total "), metrics.npos);
    EXPECT_NE(metrics.find("\nstarbow_remote_pages 0\n"), metrics.npos);
}

TEST(Server, OscComesFromTheListAlone)
{
    Running running;
    running.osc("127.0.0.2", std::string("/starbow/stop\0\0\0,\0\0\0", 20));
    running.osc("127.0.0.1", "damaged");
    running.osc("127.0.0.1", std::string("/starbow/restart\0\0\0\0,\0\0\0", 24)); // an engineer's
    running.osc("127.0.0.1", std::string("/starbow/doppler\0\0\0\0,i\0\0\0\0\0\0", 28));
    running.wait_for(1);
    const std::string metrics = running.http("GET /metrics");
    EXPECT_NE(metrics.find("starbow_remote_refused_datagrams_total 3\n"), metrics.npos);
    running.end();
    EXPECT_EQ(running.taken, (std::vector<std::vector<std::string>>{{"doppler", "off"}}));
}

TEST(Server, TellGivesACommandAndPrintsTheState)
{
    Running running;
    tell(running.tell_options(), {"scene", "twins"});
    EXPECT_NE(state_of_exhibit(running.tell_options()).find("scene: twins\n"), std::string::npos);
    for (const auto& [options, words, says] :
        {std::tuple{running.tell_options(), std::vector<std::string>{"scene", "gone"}, "There is no gone"},
            {running.tell_options(), {"jump"}, "is not known"},
            {running.tell_options("222222"), {"restart"}, "not for the role docent"},
            {running.tell_options("999999"), {"stop"}, "PIN is wrong"}}) {
        const std::string message = complaint([&] { tell(options, words); });
        EXPECT_NE(message.find(says), message.npos) << message;
    }
    TellOptions nowhere = running.tell_options();
    nowhere.port = free_port(SOCK_STREAM);
    EXPECT_NE(complaint([&] { tell(nowhere, {"stop"}); }).find("no exhibit answers"), std::string::npos);
}

TEST(Server, WhoComesSeesWhatHappenedWhileNobodyWasThere)
{
    Running running;
    EXPECT_NE(state_of_exhibit(running.tell_options()).find("scene: avenue\n"), std::string::npos);
    const auto nobody = [&] { return running.http("GET /metrics").find("starbow_remote_pages 0\n") != std::string::npos; };
    EXPECT_TRUE(until(nobody)) << "that connection does not end";
    running.osc("127.0.0.1", std::string("/starbow/scene\0\0,s\0\0twins\0\0\0", 28));
    running.wait_for(1);
    running.frames_more(1); // the frame that shows it
    EXPECT_NE(state_of_exhibit(running.tell_options()).find("scene: twins\n"), std::string::npos);
}

TEST(Server, WithACertificateAllIsEncrypted)
{
    Running running([](RemoteSettings& settings) {
        settings.certificate = source_dir() / "tests/remote/certificate.pem";
        settings.key = source_dir() / "tests/remote/key.pem";
    });
    EXPECT_TRUE(running.remote->page().starts_with("https://"));
    TellOptions options = running.tell_options();
    options.certificate = running.settings.certificate;
    tell(options, {"scene", "twins"});
    EXPECT_NE(state_of_exhibit(options).find("scene: twins\n"), std::string::npos);
    Wire wire(running.settings.port);
    wire.send("GET / HTTP/1.1\r\nHost: " + running.host() + "\r\n\r\n");
    EXPECT_EQ(wire.read_head().find("HTTP/1.1 200"), std::string::npos);
    options.certificate = source_dir() / "tests/remote/other_certificate.pem";
    EXPECT_NE(complaint([&] { tell(options, {"stop"}); }).find("no exhibit answers"), std::string::npos);
}

TEST(Server, WithoutAFilePinsAreDrawnAndWork)
{
    Running running([](RemoteSettings& settings) { settings.pins.clear(); });
    const Pins pins = running.remote->drawn_pins();
    EXPECT_NE(running.cookie(pins[1]), "");
    tell(running.tell_options(pins[2]), {"restart"});
    EXPECT_EQ(Running().remote->drawn_pins(), Pins{});
}

TEST(Server, TheLogWarnsOfAnOpenNetworkAndHoldsNoPin)
{
    for (const bool open : {false, true}) {
        const std::filesystem::path file = scratch("remote-log");
        std::FILE* stream = std::fopen(file.c_str(), "w");
        open_log({.stream = stream});
        Pins pins;
        {
            Running running([&](RemoteSettings& settings) {
                settings.address = open ? "0.0.0.0" : "127.0.0.1";
                settings.pins.clear();
            });
            pins = running.remote->drawn_pins();
            running.status("POST /login", running.origin(), "{\"pin\":\"" + pins[1] + "\"}");
        }
        flush_messages(10);
        open_log({});
        std::fclose(stream);
        const std::string text = read_text(file);
        EXPECT_EQ(text.find("unencrypted") != text.npos, open) << text;
        for (const std::string& pin : pins)
            EXPECT_EQ(text.find(pin), text.npos) << text;
    }
}

TEST(Server, AWrongStartIsRefused)
{
    for (const auto& [change, says] :
        {std::pair<std::function<void(RemoteSettings&)>, const char*>{
             [](RemoteSettings& settings) { settings.pins = "/nowhere/pins"; }, "does not exist"},
            {[](RemoteSettings& settings) { settings.certificate = settings.key = "/nowhere/pem"; }, "does not exist"},
            {[](RemoteSettings& settings) { settings.certificate = settings.key = settings.pins; },
                "can't be opened at port"},
            {[](RemoteSettings& settings) {
                 settings.certificate = settings.key = settings.pins;
                 settings.address = "192.0.2.7"; // which comes later, if ever
             },
                "can't be opened at port"}}) {
        const std::string message = complaint([&] { Running another(change); });
        EXPECT_NE(message.find(says), message.npos) << message;
        EXPECT_TRUE(message.ends_with("is right")) << message;
    }
}

/// The exhibit begins without the ports that it can't have, and takes them up once they are free.
TEST(Server, PortsThatAreInUseAreWaitedForAndTakenUp)
{
    const std::filesystem::path file = scratch("remote-waits");
    std::FILE* stream = std::fopen(file.c_str(), "w");
    open_log({.stream = stream});
    auto first = std::make_unique<Running>();
    const RemoteSettings wanted = first->settings;
    {
        Running second([&](RemoteSettings& settings) { settings.port = wanted.port, settings.osc = wanted.osc; });
        EXPECT_TRUE(until([&] { return !second.remote->lack().empty(); }));
        EXPECT_EQ(second.remote->lack(),
            "the remote's port " + std::to_string(wanted.port) + " of 127.0.0.1 can't be had (Address already in use)");
        EXPECT_EQ(first->status("GET /"), 200);
        first.reset();
        EXPECT_TRUE(until([&] { return second.remote->lack().empty(); }));
        EXPECT_EQ(second.status("GET /"), 200);
        second.osc("127.0.0.1", std::string("/starbow/stop\0\0\0,\0\0\0", 20));
        second.wait_for(1);
    }
    Running nowhere([](RemoteSettings& settings) { settings.address = "192.0.2.7"; });
    EXPECT_TRUE(until([&] { return nowhere.remote->lack().find("192.0.2.7") != std::string::npos; }));
    flush_messages(10);
    open_log({});
    std::fclose(stream);
    const std::string text = read_text(file);
    for (const char* line : {"of 127.0.0.1 can't be had (Address already in use)", "of 127.0.0.1 is there now"})
        for (const char* what : {"network: the remote's port ", "network: OSC's UDP port "})
            EXPECT_TRUE(std::regex_search(
                text, std::regex(std::string(what) + "[0-9]+ " + std::regex_replace(line, std::regex("[().]"), "\\$&"))))
                << what << line << text;
    EXPECT_NE(text.find("of 192.0.2.7 can't be had (Cannot assign requested address)"), text.npos) << text;
}

/// One wrong PIN from each of 16 addresses locks out strangers; this machine logs in as before, and the log names no
/// innocent.
TEST(Server, WrongPinsOfManyAddressesDoNotLockOutThisMachine)
{
    const std::filesystem::path file = scratch("remote-locked");
    std::FILE* stream = std::fopen(file.c_str(), "w");
    open_log({.stream = stream});
    {
        Running running;
        const std::string right = R"({"pin":"222222"})", wrong = R"({"pin":"999999"})";
        EXPECT_EQ(running.status("POST /login", running.origin(), right, "127.0.5.1"), 200);
        for (int i = 1; i <= 16; ++i)
            EXPECT_EQ(running.status("POST /login", running.origin(), wrong, ("127.0.3." + std::to_string(i)).c_str()), 401);
        EXPECT_EQ(running.status("POST /login", running.origin(), right, "127.0.4.1"), 429);
        EXPECT_EQ(running.status("POST /login", running.origin(), right, "127.0.5.1"), 200);
        EXPECT_EQ(running.status("POST /login", running.origin(), right), 200);
    }
    flush_messages(10);
    open_log({});
    std::fclose(stream);
    const std::string text = read_text(file);
    EXPECT_NE(
        text.find("wrong PINs at 16 addresses, the last of them 127.0.3.16: for 5 minutes logins are refused but from this "
                  "machine and from addresses that have logged in within a day"),
        text.npos)
        << text;
    EXPECT_EQ(text.find("127.0.4.1"), text.npos) << text;
    EXPECT_EQ(text.find("five wrong PINs"), text.npos) << text;
}

/// Nobody holds all connections: neither one address, nor many, nor a program on this machine.
TEST(Server, OneAddressHoldsOnlyItsShareOfTheConnections)
{
    Running running;
    std::vector<std::unique_ptr<Wire>> held;
    for (int i = 0; i < 300; ++i)
        held.push_back(std::make_unique<Wire>(running.settings.port, "127.0.3.1"));
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(running.status("GET /", "", "", "127.0.3.2"), 200);
    held.clear();
    EXPECT_EQ(running.status("POST /login", running.origin(), R"({"pin":"222222"})", "127.0.5.1"), 200);
    for (int i = 0; i < 300; ++i)
        held.push_back(std::make_unique<Wire>(running.settings.port, ("127.0.4." + std::to_string(i / 25 + 1)).c_str()));
    EXPECT_EQ(running.status("GET /"), 200);
    EXPECT_EQ(running.status("GET /", "", "", "127.0.5.1"), 200);
}

TEST(Server, RefusedOscIsLoggedOnceInAWhile)
{
    const std::filesystem::path file = scratch("remote-osc");
    std::FILE* stream = std::fopen(file.c_str(), "w");
    open_log({.stream = stream});
    {
        Running running;
        for (int i = 0; i < 200; ++i)
            running.osc("127.0.0.1", "damaged");
        running.osc("127.0.0.2", std::string("/starbow/stop\0\0\0,\0\0\0", 20));
        EXPECT_TRUE(until([&] {
            return running.http("GET /metrics").find("starbow_remote_refused_datagrams_total 201\n") != std::string::npos;
        }));
    }
    flush_messages(10);
    open_log({});
    std::fclose(stream);
    const std::string text = read_text(file);
    const std::size_t at = text.find("info remote: OSC from 127.0.0.1: a datagram is not an OSC message");
    ASSERT_NE(at, text.npos) << text;
    EXPECT_EQ(text.find("OSC from", at + 20), text.npos) << text; // further ones within ten seconds are counted
}

TEST(Server, AKeyThatAllMayReadIsWarnedOf)
{
    for (const mode_t mode : {0644, 0640}) {
        const std::filesystem::path file = scratch("remote-key-log"), key = scratch("remote-key.pem");
        std::filesystem::copy_file(
            source_dir() / "tests/remote/key.pem", key, std::filesystem::copy_options::overwrite_existing);
        chmod(key.c_str(), mode);
        std::FILE* stream = std::fopen(file.c_str(), "w");
        open_log({.stream = stream});
        {
            Running running([&](RemoteSettings& settings) {
                settings.certificate = source_dir() / "tests/remote/certificate.pem";
                settings.key = key;
            });
        }
        flush_messages(10);
        open_log({});
        std::fclose(stream);
        EXPECT_EQ(read_text(file).find("has the rights 644, which let every user of this machine read the key; 640 is right")
                != std::string::npos,
            mode == 0644)
            << read_text(file);
    }
}

TEST(Server, DamagedBytesDoItNoHarm)
{
    Running running;
    std::mt19937 random(18);
    const std::string cookie = running.cookie("222222");
    const std::string get = "GET / HTTP/1.1\r\nHost: " + running.host() + "\r\n" + running.origin() + cookie;
    const std::vector<std::string> seeds{get + "\r\n", get + Running::upgrade + std::string("\x81\x82\0\0\0\0{}", 8),
        "POST /login HTTP/1.1\r\nHost: " + running.host() + "\r\n" + running.origin() + "Content-Length: 2\r\n\r\n{}"};
    for (int i = 0; i < (all_cases() ? 20000 : 300); ++i) {
        Wire wire(running.settings.port);
        wire.send(mutated(seeds[random() % seeds.size()], random));
        running.osc("127.0.0.1", mutated(std::string("/starbow/doppler\0\0\0\0,i\0\0\0\0\0\0", 28), random));
        // An answer shows that the connections before it were accepted: on a busy machine this loop would otherwise run
        // ahead of the server, which then refuses the 257th open connection, as it should.
        if (i % 64 == 63) {
            ASSERT_EQ(running.status("GET /"), 200) << "after " << i + 1 << " damaged requests";
        }
    }
    EXPECT_EQ(running.status("GET /"), 200);
    const auto page = running.page("222222");
    page->send_frame(R"({"id":7,"command":["stop"]})");
    EXPECT_EQ(page->read_message("answer")["applied"], true);
}

} // namespace server_test
