// Messages from the network, whole and damaged.
#include "config/model/shipped.h"
#include "runtime/remote/messages.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace messages_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

RemoteSettings settings()
{
    return {.port = 8080,
        .address = "192.168.7.20",
        .hosts = {"starbow.local", "[2001:db8::7]"},
        .certificate = {},
        .key = {},
        .pins = {},
        .osc = {}};
}

/// An OSC message, each part padded with zeros to four bytes.
std::string osc(const std::string& path, const std::string& types, const std::string& values = "")
{
    const auto padded = [](std::string text) {
        text.push_back('\0');
        text.resize((text.size() + 3) / 4 * 4, '\0');
        return text;
    };
    return padded(path) + padded("," + types) + values;
}
std::string text_value(std::string text)
{
    text.push_back('\0');
    text.resize((text.size() + 3) / 4 * 4, '\0');
    return text;
}
std::string word_value(std::uint32_t number)
{
    return {char(number >> 24), char(number >> 16), char(number >> 8), char(number)};
}
std::string bundle(const std::vector<std::string>& messages)
{
    std::string text("#bundle\0", 8);
    text += std::string("\0\0\0\0\0\0\0\1", 8);
    for (const std::string& one : messages)
        text += word_value(std::uint32_t(one.size())) + one;
    return text;
}
std::vector<Command> commands(const std::string& bytes)
{
    return commands_of_osc({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}
std::string refusal(const std::string& bytes)
{
    return complaint([&] { commands(bytes); });
}

const std::vector<std::string> osc_samples{osc("/starbow/scene", "s", text_value("avenue")),
    osc("/starbow/doppler", "i", word_value(0)), osc("/starbow/speed-limit", "f", word_value(0x40e00000)),
    osc("/starbow/stop", ""), osc("/starbow/fade", "T"),
    bundle({osc("/starbow/stop", ""), osc("/starbow/caption", "s", text_value("Grüße"))})};

const std::vector<std::string> message_samples{R"({"id":1,"command":["scene","avenue"]})", R"({"id":2,"command":["stop"]})",
    R"({"id":3,"picture":true})", R"({"id":4,"command":["speed-limit","7.0888"]})",
    R"({"id":5,"command":["caption","Gr\u00fc\u00dfe \ud83d\ude00"]})"};

} // namespace

TEST(Messages, RequestsAreRead)
{
    const Request scene = request_of(message_samples[0]);
    EXPECT_EQ(scene.id, 1);
    EXPECT_EQ(scene.command, (Command{.kind = CommandKind::scene, .text = "avenue"}));
    EXPECT_EQ(request_of(message_samples[2]).picture, true);
    EXPECT_EQ(request_of(message_samples[3]).command->number, 7.0888);
    EXPECT_EQ(pin_of(R"({"pin":"012345"})"), "012345");
    EXPECT_EQ(id_of(R"({"id":77,"command":["nonsense"]})"), 77);
}

TEST(Messages, WrongRequestsAreRefusedInOneSentence)
{
    for (const char* wrong : {"", "x", "[]", "3", "{}", R"({"id":0,"command":["stop"]})", R"({"id":-1,"command":["stop"]})",
             R"({"id":1.5,"command":["stop"]})", R"({"id":1000000001,"command":["stop"]})",
             R"({"id":18446744073709551615,"command":["stop"]})", R"({"id":"1","command":["stop"]})", R"({"id":1})",
             R"({"id":1,"command":[]})", R"({"id":1,"command":"stop"})", R"({"id":1,"command":["stop","now"]})",
             R"({"id":1,"command":[1]})", R"({"id":1,"command":["scene","../../etc/passwd"]})",
             R"({"id":1,"command":["scene","own.json"]})", R"({"id":1,"command":["scene","a","b"]})",
             R"({"id":1,"command":["pointer","1","2","3"]})", R"({"id":1,"command":["speed-limit","nan"]})",
             R"({"id":1,"command":["speed-limit","1e999"]})", R"({"id":1,"command":["stop"],"picture":true})",
             R"({"id":1,"command":["stop"],"more":1})", R"({"id":1,"picture":1})",
             "{\"id\":1,\"command\":[\"caption\",\"\xff\"]}"}) {
        const std::string message = complaint([&] { request_of(wrong); });
        EXPECT_TRUE(message.ends_with("right") || message.find(" is right: ") != message.npos) << wrong << ": " << message;
    }
    EXPECT_NE(complaint([] { request_of(std::string(5000, ' ')); }).find("at most 4096 are right"), std::string::npos);
    EXPECT_NE(complaint([] { request_of(std::string(4096, '[')); }).find("not a JSON object"), std::string::npos);
    EXPECT_NE(complaint([] { pin_of(R"({"pin":123456})"); }).find("has no PIN"), std::string::npos);
}

TEST(Messages, TheTokenIsFoundAmongCookies)
{
    EXPECT_EQ(token_of("starbow=abc"), "abc");
    EXPECT_EQ(token_of("other=1; starbow=abc; more=2"), "abc");
    for (const char* none : {"", "starbow", "xstarbow=abc", "other=starbow=abc", ";;; ;", "Starbow=abc"})
        EXPECT_EQ(token_of(none), "") << none;
}

TEST(Messages, HostsAndOriginsAreOnTheList)
{
    for (const char* right :
        {"192.168.7.20:8080", "localhost:8080", "127.0.0.1:8080", "[::1]:8080", "Starbow.LOCAL:8080", "[2001:db8::7]:8080"})
        EXPECT_TRUE(host_is_listed(right, settings())) << right;
    for (const char* wrong : {"", "starbow.local", "starbow.local:80", "starbow.local:8081",
             "starbow.local:8080.evil.example", "evil.example:8080", "starbow.local.evil.example:8080", "192.168.7.21:8080",
             ":8080", "[::1]", "[::1", "starbow.local:8080:8080", "starbow.local:08080"})
        EXPECT_FALSE(host_is_listed(wrong, settings())) << wrong;
    RemoteSettings usual = settings();
    usual.port = 80;
    EXPECT_TRUE(host_is_listed("starbow.local", usual));
    EXPECT_TRUE(host_is_listed("[::1]", usual));
    usual.certificate = "c.pem";
    EXPECT_FALSE(host_is_listed("starbow.local", usual));
    EXPECT_TRUE(origin_is_of("http://starbow.local:8080", "starbow.local:8080", false));
    EXPECT_TRUE(origin_is_of("https://Starbow.local:8080", "starbow.local:8080", true));
    for (const char* wrong : {"", "null", "https://starbow.local:8080", "http://starbow.local", "http://evil.example:8080",
             "http://starbow.local:8080.evil.example", "http://starbow.local:8080/"})
        EXPECT_FALSE(origin_is_of(wrong, "starbow.local:8080", false)) << wrong;
}

TEST(Messages, AddressesAreComparedAsPlainOnes)
{
    EXPECT_EQ(plain_address("::ffff:10.0.0.7"), "10.0.0.7");
    EXPECT_EQ(plain_address("10.0.0.7"), "10.0.0.7");
    EXPECT_EQ(counted_address("::ffff:10.0.0.7"), "10.0.0.7");
    EXPECT_EQ(counted_address("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::");
    EXPECT_EQ(counted_address("2001:db8:1:2:ffff::1"), counted_address("2001:db8:1:2::9"));
}

TEST(Messages, StatusesAndAnswersAreJson)
{
    Snapshot now;
    now.scene = "avenue", now.tour = "twins", now.step = 2, now.steps = 9, now.effects.on.set(Effect::doppler, false),
    now.speed = 0.5;
    now.effects.comparison = Comparison::no_light_delay;
    now.caption = "\xff\"</script>";
    now.gamma = std::numeric_limits<double>::infinity();
    now.doing = Doing::attract_tour, now.left_s = 41.2, now.calm = true, now.max_gamma = 5.0 / 3;
    now.item = 2, now.items = 6, now.item_s = 83.9, now.next_caption = {{"en", "Next."}, {"de", "Gleich."}};
    now.error = "A sentence.";
    now.grip = "left, tilt", now.grip_says = "30.5", now.as_saved = true;
    const json docent = json::parse(status_text(now, false))["status"],
               engineer = json::parse(status_text(now, true))["status"];
    EXPECT_EQ(docent["scene"], "avenue");
    EXPECT_EQ(docent["step"], 2);
    EXPECT_EQ(docent["doppler"], false);
    EXPECT_EQ(docent["doing"], "attract_tour");
    EXPECT_EQ(docent["left-s"], 42);
    EXPECT_EQ(docent["calm"], true);
    EXPECT_NEAR(docent["max-speed"].get<double>(), 0.8, 1e-12);
    EXPECT_EQ(docent["item"], 2);
    EXPECT_EQ(docent["item-s"], 83);
    EXPECT_EQ(docent["next-caption"], json::parse(R"({ "en": "Next.", "de": "Gleich." })"));
    EXPECT_EQ(docent["comparison"], "no-light-delay");
    EXPECT_EQ(docent["gamma"], 0);
    EXPECT_FALSE(docent.contains("error"));
    EXPECT_EQ(engineer["error"], "A sentence.");
    EXPECT_EQ(engineer["grip"], "left, tilt");
    EXPECT_EQ(engineer["grip-says"], "30.5");
    EXPECT_FALSE(docent.contains("grip"));
    EXPECT_EQ(docent["as-saved"], true);
    EXPECT_EQ(json::parse(condition_text({.metrics = "m 1", .log = {"a line"}, .grips = {"left, tilt"}, .unkept = 2})),
        (json{{"log", {"a line"}}, {"grips", {"left, tilt"}}, {"unkept", 2}}));
    EXPECT_EQ(json::parse(answer_text(7, ""))["answer"], (json{{"id", 7}, {"applied", true}}));
    EXPECT_EQ(json::parse(answer_text(8, "No."))["answer"]["refused"], "No.");
    EXPECT_EQ(json::parse(hello_text(Role::engineer, "1"))["hello"]["role"], "engineer");
}

TEST(Messages, ListsNameTheShippedFilesAndRoles)
{
    const json lists = json::parse(lists_text({"none", "grid"}, load_programme(shipped_file("programmes", "evening"))));
    for (const auto& [command, folder] :
        {std::pair{"tour", "tours"}, {"scene", "scenes"}, {"layout", "layouts"}, {"shot", "shots"}, {"language", "words"}})
        EXPECT_EQ(lists["names"][command].size(), shipped(std::string("config/") + folder).size()) << command;
    EXPECT_EQ(lists["names"]["quality"], (json{"balanced", "draft", "fine"})); // and not the ladder
    EXPECT_EQ(lists["names"]["pattern"], (json{"none", "grid"}));
    EXPECT_EQ(lists["programme"].size(), 6u);
    EXPECT_EQ(lists["programme"][1]["kind"], "tour");
    EXPECT_EQ(lists["programme"][1]["name"], "first-minute");
    EXPECT_EQ(lists["programme"][1]["minutes"], 3);
    EXPECT_TRUE(lists["programme"][1]["notes"].contains("de"));
    EXPECT_TRUE(json::parse(lists_text({}, {}))["programme"].empty());
    EXPECT_EQ(lists["speed-limits"][4], 100);
    EXPECT_EQ(lists["commands"]["restart"], (json{{"role", "engineer"}, {"value", "none"}}));
    const json words = json::parse(words_text());
    EXPECT_EQ(words["de"]["remote.no"], "Nein");
    EXPECT_EQ(words["de"]["name.scene.avenue"], "Die Allee");
    for (const char* doing : doing_names)
        EXPECT_TRUE(words["de"].contains(std::string("does.") + doing)) << doing;
    EXPECT_FALSE(words["en"].contains("hud.speed"));
}

TEST(Osc, MessagesAndBundlesAreRead)
{
    EXPECT_EQ(commands(osc_samples[0]), (std::vector<Command>{{.kind = CommandKind::scene, .text = "avenue"}}));
    EXPECT_EQ(commands(osc_samples[1]),
        (std::vector<Command>{{.kind = CommandKind::effect, .on = false, .effect = Effect::doppler}}));
    EXPECT_EQ(commands(osc_samples[2]), (std::vector<Command>{{.kind = CommandKind::speed_limit, .number = 7}}));
    EXPECT_EQ(commands(osc_samples[4]), (std::vector<Command>{{.kind = CommandKind::fade, .on = true}}));
    EXPECT_EQ(commands(osc_samples[5]),
        (std::vector<Command>{{.kind = CommandKind::stop}, {.kind = CommandKind::caption, .text = "Grüße"}}));
    EXPECT_EQ(commands(osc("/starbow/doppler", "f", word_value(0x3f800000)))[0].on, true);
    EXPECT_EQ(commands(osc("/starbow/doppler", "s", text_value("on")))[0].on, true);
    EXPECT_EQ(commands(osc("/starbow/stop", "i", word_value(1))).size(), 1u);
    EXPECT_EQ(commands(osc("/starbow/pointer", "ff", word_value(0x41f00000) + word_value(0x41a00000))),
        (std::vector<Command>{{.kind = CommandKind::pointer, .number = 30, .second = 20}}));
    EXPECT_TRUE(commands(bundle({})).empty());
    EXPECT_EQ(commands(bundle({bundle({osc("/starbow/stop", "")}), osc("/starbow/reset", "")})).size(), 2u);
}

/// What consoles send for a button: 1, 127 of a MIDI note, a fader's part, true, an impulse or a word; 0 or false when it is
/// let go.
TEST(Osc, TrueAndPositiveNumbersActFalseAndZeroDoNot)
{
    const std::string one = word_value(1), zero = word_value(0), note = word_value(127), half = word_value(0x3f000000),
                      whole_double = word_value(0x3ff00000) + word_value(0), long_one = word_value(0) + word_value(1);
    const std::vector<std::pair<std::string, std::string>> on{{"T", ""}, {"I", ""}, {"i", one}, {"i", note}, {"f", half},
        {"f", word_value(0x3f800000)}, {"f", word_value(0x42fe0000)}, {"d", whole_double}, {"h", long_one},
        {"s", text_value("on")}, {"s", text_value("true")}, {"s", text_value("1")}},
        off{{"F", ""}, {"i", zero}, {"f", zero}, {"d", zero + zero}, {"h", zero + zero}, {"s", text_value("off")},
            {"s", text_value("false")}, {"s", text_value("0")}};
    for (const auto& [types, values] : on) {
        EXPECT_EQ(
            commands(osc("/starbow/fade", types, values)), (std::vector<Command>{{.kind = CommandKind::fade, .on = true}}))
            << types;
        EXPECT_EQ(commands(osc("/starbow/stop", types, values)), (std::vector<Command>{{.kind = CommandKind::stop}}))
            << types;
    }
    for (const auto& [types, values] : off) {
        EXPECT_EQ(commands(osc("/starbow/fade", types, values)), (std::vector<Command>{{.kind = CommandKind::fade}}))
            << types;
        EXPECT_TRUE(commands(osc("/starbow/stop", types, values)).empty()) << types;
    }
    for (const auto& [types, values] : std::vector<std::pair<std::string, std::string>>{
             {"i", word_value(0xffffffff)}, {"f", word_value(0x7fc00000)}, {"s", text_value("maybe")}, {"N", ""}}) {
        EXPECT_NE(refusal(osc("/starbow/fade", types, values)), "") << types;
        EXPECT_NE(refusal(osc("/starbow/stop", types, values)), "") << types;
    }
}

TEST(Osc, WrongMessagesAreRefusedInOneSentence)
{
    for (const std::string& wrong : {std::string(), std::string("/"), std::string(4, '\0'), osc("/other/stop", ""),
             osc("/starbow/none", ""), osc("/starbow/doppler", "ii", word_value(1) + word_value(1)),
             osc("/starbow/scene", "ss", text_value("a") + text_value("b")), osc("/starbow/scene", "i", ""),
             osc("/starbow/scene", "s", text_value("../x")), osc("/starbow/scene", "b", word_value(0xffffffff)),
             osc("/starbow/doppler", "N"),
             bundle({bundle({bundle({bundle({bundle({bundle({bundle({bundle({bundle({})})})})})})})})}), bundle({""}),
             bundle({"x"}), std::string("#bundle\0", 8) + std::string(8, '\1') + word_value(0x7fffffff),
             bundle(std::vector<std::string>(65, osc("/starbow/stop", "")))})
        EXPECT_NE(refusal(wrong), "") << wrong;
}

/// A million of each under STARBOW_ALL_CASES; nothing but an InputError comes out, and some of both kinds.
TEST(RemoteFuzz, DamagedMessagesAreReadOrRefused)
{
    const int count = all_cases() ? 1000000 : fuzz_count();
    std::mt19937 random(8080);
    int read[3]{}, refused[3]{};
    const auto attempt = [&](int kind, const std::function<void()>& act) {
        try {
            act();
            ++read[kind];
        } catch (const InputError& error) {
            ++refused[kind];
            ASSERT_EQ(std::string(error.what()).find_first_of("\n\r"), std::string::npos) << error.what();
        }
    };
    const std::vector<std::string> headers{"other=1; starbow=0123456789abcdef0123456789abcdef; more=2", "starbow.local:8080",
        "http://starbow.local:8080", "[2001:db8::7]:8080", "::ffff:10.0.0.7", "{\"pin\":\"123456\"}"};
    for (int i = 0; i < count; ++i) {
        const std::string message = mutated(message_samples[random() % message_samples.size()], random);
        attempt(0, [&] { request_of(message); });
        id_of(message);
        std::string datagram = osc_samples[random() % osc_samples.size()];
        for (unsigned faults = random() % 4; faults > 0; --faults)
            if (random() % 4 == 0 && !datagram.empty())
                datagram.resize(random() % datagram.size());
            else if (!datagram.empty())
                datagram[random() % datagram.size()] = char(random() % 3 == 0 ? random() : random() % 8);
        attempt(1, [&] { commands(datagram); });
        const std::string header = mutated(headers[random() % headers.size()], random);
        attempt(2, [&] { pin_of(header); });
        token_of(header);
        host_is_listed(header, settings());
        origin_is_of(header, "starbow.local:8080", false);
        counted_address(header);
    }
    for (const int kind : {0, 1, 2}) {
        EXPECT_GT(read[kind], count / 100) << kind;
        EXPECT_GT(refused[kind], count / 100) << kind;
    }
}

} // namespace messages_test
