// Exhibit files: the shipped ones, each member, and wrong files. The editors' schema must agree with the reader.
#include "config/model/exhibit_file.h"
#include "config/model/layout.h"
#include "config/model/shipped.h"
#include "tests/support/files.h"
#include "tests/support/schema_check.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace exhibit_file_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

bool schema_accepts(const json& exhibit) { return starbow::testing::schema_accepts("exhibit", exhibit); }

/// The reader's message, or "" for a valid file.
std::string message_for(const std::string& text)
{
    try {
        load_exhibit(write_text("exhibit.json", text));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

TEST(ExhibitFileTest, ShippedExhibitsNameExistingFiles)
{
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "config/exhibits")) {
        SCOPED_TRACE(entry.path().filename().string());
        EXPECT_TRUE(schema_accepts(json::parse(read_text(entry.path()), nullptr, true, true)));
        const Exhibit exhibit = load_exhibit(entry.path());
        EXPECT_NO_THROW(load_layout(shipped_file("layouts", exhibit.layout)));
        EXPECT_NO_THROW(shipped_file("scenes", exhibit.scene));
        EXPECT_NO_THROW(words_in(exhibit.language));
        for (const std::string& tour : exhibit.visiting.value_or(Visiting()).attract)
            EXPECT_NO_THROW(shipped_file("tours", tour));
        ++count;
    }
    EXPECT_GE(count, 4);
}

TEST(ExhibitFileTest, EveryMemberIsRead)
{
    const std::string text
        = R"({ "layout": "../walls/wall.json", "shot": "gamma100", "language": "de", "profiles": "sticks", "tutorial": false,
        "frame_budget_ms": 16.5, "ladder": "own/ladder.json",
        "flying": { "mode": "newtonian", "max_gamma": 50, "turn_deg_per_s": 11, "roll_deg_per_s": 12,
                    "turn_jerk_deg_per_s3": 13, "rapidity_per_s": 0.14, "rapidity_jerk_per_s2": 0.15 },
        "exposure": { "mode": "range", "automatic": false, "min_ev": -16, "max_ev": 1.7, "bloom": 0.18 },
        "visit": { "idle_s": 61, "ask_s": 11, "longest_s": 300, "fade_s": 0.5, "unlock": "red5", "attract": ["rainbow", "own/tour.json", "kept.jsonl"] } })";
    EXPECT_TRUE(schema_accepts(json::parse(text)));
    const auto file = write_text("exhibit.json", text);
    const Exhibit exhibit = load_exhibit(file);
    const auto folder = std::filesystem::absolute(file).parent_path();
    EXPECT_EQ(exhibit.layout, (folder / "../walls/wall.json").lexically_normal().string());
    EXPECT_EQ(exhibit.shot, "gamma100");
    EXPECT_EQ(exhibit.language, "de");
    EXPECT_EQ(exhibit.profiles, folder / "sticks");
    EXPECT_FALSE(exhibit.tutorial);
    EXPECT_EQ(exhibit.frame_budget_ms, 16.5);
    EXPECT_EQ(exhibit.ladder, folder / "own/ladder.json");
    EXPECT_EQ(load_exhibit(write_text("exhibit.json", R"({ "quality": "draft" })")).quality, "draft");
    const Flying& flying = exhibit.flying;
    EXPECT_EQ(flying.mode, FlightMode::newtonian);
    EXPECT_EQ(flying.max_gamma, 50);
    EXPECT_EQ(flying.turn_deg_per_s, 11);
    EXPECT_EQ(flying.roll_deg_per_s, 12);
    EXPECT_EQ(flying.turn_jerk_deg_per_s3, 13);
    EXPECT_EQ(flying.rapidity_per_s, 0.14);
    EXPECT_EQ(flying.rapidity_jerk_per_s2, 0.15);
    EXPECT_FALSE(exhibit.exposure.automatic);
    EXPECT_EQ(exhibit.exposure.mode, ExposureMode::range);
    EXPECT_EQ(exhibit.exposure.min_ev, -16);
    EXPECT_EQ(exhibit.exposure.max_ev, 1.7);
    EXPECT_EQ(exhibit.exposure.bloom, 0.18);
    ASSERT_TRUE(exhibit.visiting);
    EXPECT_EQ(exhibit.visiting->idle_s, 61);
    EXPECT_EQ(exhibit.visiting->ask_s, 11);
    EXPECT_EQ(exhibit.visiting->longest_s, 300);
    EXPECT_EQ(exhibit.visiting->fade_s, 0.5);
    EXPECT_EQ(exhibit.visiting->unlock, "red5");
    EXPECT_EQ(
        exhibit.visiting->attract, (std::vector<std::string>{"rainbow", folder / "own/tour.json", folder / "kept.jsonl"}));
    EXPECT_FALSE(load_exhibit(write_text("exhibit.json", "{}")).visiting);
}

TEST(ExhibitFileTest, MachinesAreRead)
{
    EXPECT_FALSE(load_exhibit(write_text("exhibit.json", "{}")).machines);
    const std::string text
        = R"({ "machines": { "master": "left", "interface": "lo", "domain": 7, "exhibit": "east dome" } })";
    EXPECT_TRUE(schema_accepts(json::parse(text)));
    const Exhibit exhibit = load_exhibit(write_text("exhibit.json", text));
    ASSERT_TRUE(exhibit.machines);
    EXPECT_EQ(exhibit.machines->master, "left");
    EXPECT_EQ(exhibit.machines->interface, "lo");
    EXPECT_EQ(exhibit.machines->domain, 7);
    EXPECT_EQ(exhibit.machines->exhibit, "east dome");
    const Exhibit usual
        = load_exhibit(write_text("exhibit.json", R"({ "machines": { "master": "left", "interface": "lo" } })"));
    EXPECT_EQ(usual.machines->domain, 0);
    EXPECT_EQ(usual.machines->exhibit, "");
    const std::string message = complaint([] {
        load_exhibit(write_text("exhibit.json",
            R"({ "machines": { "master": "left", "interface": "lo", "exhibit": ")" + std::string(65, 'x') + R"(" } })"));
    });
    EXPECT_NE(message.find("/machines/exhibit"), message.npos) << message;
    EXPECT_TRUE(message.ends_with("right")) << message;
}

TEST(ExhibitFileTest, OneButtonAndTheLeftHandAreRead)
{
    EXPECT_FALSE(load_exhibit(write_text("exhibit.json", "{}")).one_button);
    EXPECT_FALSE(load_exhibit(write_text("exhibit.json", "{}")).left_handed);
    const std::string text = R"({ "one_button": { "scan_s": 2.5, "act_s": 0.7 }, "left_handed": true })";
    EXPECT_TRUE(schema_accepts(json::parse(text)));
    const Exhibit exhibit = load_exhibit(write_text("exhibit.json", text));
    ASSERT_TRUE(exhibit.one_button);
    EXPECT_EQ(exhibit.one_button->scan_s, 2.5);
    EXPECT_EQ(exhibit.one_button->act_s, 0.7);
    EXPECT_TRUE(exhibit.left_handed);
}

TEST(ExhibitFileTest, ComfortIsReadAndWithoutItsBlockThereIsNone)
{
    const Comfort none = load_exhibit(write_text("exhibit.json", "{}")).flying.comfort;
    EXPECT_FALSE(none.no_roll || none.level_horizon || none.vignette);
    EXPECT_EQ(none.turn_steps_deg, 0);
    const auto read = [](const std::string& text) {
        EXPECT_TRUE(schema_accepts(json::parse(text))) << text;
        return load_exhibit(write_text("exhibit.json", text)).flying.comfort;
    };
    const Comfort steps = read(R"({ "comfort": { "no_roll": true, "turn_steps_deg": 22.5 } })");
    EXPECT_TRUE(steps.no_roll);
    EXPECT_FALSE(steps.level_horizon);
    EXPECT_EQ(steps.turn_steps_deg, 22.5);
    const Comfort smooth = read(
        R"({ "comfort": { "level_horizon": true, "vignette": { "elevation_deg": 30, "clear_deg": 50, "soft_deg": 12, "darkness": 0.5 } } })");
    EXPECT_FALSE(smooth.no_roll);
    EXPECT_TRUE(smooth.level_horizon);
    ASSERT_TRUE(smooth.vignette);
    EXPECT_EQ(smooth.vignette->elevation_deg, 30);
    EXPECT_EQ(smooth.vignette->clear_deg, 50);
    EXPECT_EQ(smooth.vignette->soft_deg, 12);
    EXPECT_EQ(smooth.vignette->darkness, 0.5);
}

TEST(ExhibitFileTest, TheGuidesWindowIsAskedForAndMayNameItsMonitor)
{
    EXPECT_FALSE(load_exhibit(write_text("own.json", "{}")).presenter);
    for (const auto& [text, connector] : {std::pair{R"({ "presenter": {} })", ""},
             {R"({ "presenter": { "monitor": { "connector": "HDMI-1" } } })", "HDMI-1"}}) {
        const Exhibit exhibit = load_exhibit(write_text("presenter.json", text));
        ASSERT_TRUE(exhibit.presenter);
        EXPECT_EQ(exhibit.presenter->monitor.connector, connector);
        EXPECT_TRUE(schema_accepts(json::parse(text))) << text;
    }
}

TEST(ExhibitFileTest, WrongExhibitsAreRefusedByReaderAndSchema)
{
    for (const auto& [text, problem] :
        std::vector<std::pair<std::string, std::string>>{{R"({ "layuot": "desk" })", "layuot"},
            {R"({ "layout": "" })", "/layout"}, {R"({ "visit": { "unlock": "abc" } })", "/visit/unlock: \"abc\""},
            {R"({ "visit": { "unlock": "ABCD" } })", "/visit/unlock"},
            {R"({ "visit": { "attract": [""] } })", "/visit/attract/0"},
            {R"({ "presenter": { "monitor": {} } })", "/presenter/monitor"}}) {
        EXPECT_NE(message_for(text).find(problem), std::string::npos) << message_for(text);
        EXPECT_FALSE(schema_accepts(json::parse(text))) << text;
    }
    // The schema can't express these rules.
    for (const char* limits : {R"("min_ev": 3, "max_ev": 2)", R"("min_ev": 34)", R"("max_ev": -60.5)"}) {
        const std::string text = message_for(std::string(R"({ "exposure": { )") + limits + " } }");
        EXPECT_NE(text.find("/exposure/"), std::string::npos) << text;
    }
    EXPECT_NE(message_for(R"({ "comfort": { "turn_steps_deg": 15, "vignette": {} } })").find("conflicts with turn_steps"),
        std::string::npos);
    EXPECT_NE(
        message_for(R"({ "scene": "avenue", "shot": "gamma100" })").find("conflicts with the shot"), std::string::npos);
    EXPECT_NE(message_for(R"({ "scene": "avenue", "tour": "rainbow" })").find("conflicts with the tour"), std::string::npos);
}

TEST(ExhibitFileTest, ATourIsANameOrAPath)
{
    const std::string text = R"({ "tour": "own/tour.json", "language": "own/fr.json" })";
    EXPECT_TRUE(schema_accepts(json::parse(text)));
    const auto file = write_text("exhibit.json", text);
    const auto folder = std::filesystem::absolute(file).parent_path();
    EXPECT_EQ(load_exhibit(file).tour, (folder / "own/tour.json").string());
    EXPECT_EQ(load_exhibit(file).language, (folder / "own/fr.json").string());
    EXPECT_EQ(load_exhibit(write_text("exhibit.json", R"({ "tour": "rainbow" })")).tour, "rainbow");
}

TEST(ExhibitFileTest, TheRemoteIsReadAndWithoutItsBlockThereIsNone)
{
    EXPECT_EQ(load_exhibit(write_text("exhibit.json", "{}")).remote.port, 0);
    const std::string text = R"({ "remote": { "port": 8443, "address": "::", "hosts": ["Starbow.local", "[2001:db8::1]"],
        "certificate": "tls/page.pem", "key": "tls/key.pem", "pins": "/run/pins",
        "osc": { "port": 9000, "from": ["192.168.7.9", "2001:db8::9"], "role": "engineer" } } })";
    EXPECT_TRUE(schema_accepts(json::parse(text)));
    const auto file = write_text("exhibit.json", text);
    const RemoteSettings remote = load_exhibit(file).remote;
    EXPECT_EQ(remote.port, 8443);
    EXPECT_EQ(remote.address, "::");
    EXPECT_EQ(remote.hosts, (std::vector<std::string>{"starbow.local", "[2001:db8::1]"}));
    EXPECT_EQ(remote.certificate, std::filesystem::absolute(file).parent_path() / "tls/page.pem");
    EXPECT_EQ(remote.key, std::filesystem::absolute(file).parent_path() / "tls/key.pem");
    EXPECT_EQ(remote.pins, "/run/pins");
    EXPECT_EQ(remote.osc.port, 9000);
    EXPECT_EQ(remote.osc.from, (std::vector<std::string>{"192.168.7.9", "2001:db8::9"}));
    EXPECT_TRUE(remote.osc.engineer);
}

TEST(ExhibitFileTest, AWrongRemoteIsRefused)
{
    for (const auto& [text, pointer, says] :
        {std::tuple{R"({"port": 80, "address": "localhost"})", "/remote/address", "is not an IP address"},
            {R"({"port": 80, "hosts": ["http://starbow.local"]})", "/remote/hosts/0", "is not a host's name"},
            {R"({"port": 80, "hosts": ["starbow.local:80"]})", "/remote/hosts/0", "is not a host's name"},
            {R"({"port": 80, "hosts": ["2001:db8::1"]})", "/remote/hosts/0", "is not a host's name"},
            {R"({"port": 80, "certificate": "c.pem"})", "/remote", "only one of certificate and key"},
            {R"({"port": 80, "osc": {"port": 1, "from": ["*"]}})", "/remote/osc/from/0", "is not an IP address"}}) {
        const std::string message = message_for(std::string(R"({ "remote": )") + text + " }");
        EXPECT_NE(message.find(std::string(pointer) + ":"), message.npos) << message;
        EXPECT_NE(message.find(says), message.npos) << message;
    }
}

} // namespace exhibit_file_test
