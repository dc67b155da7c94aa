#include "config/json/patch.h"
#include "tests/support/files.h"
#include <sys/stat.h>

namespace patch_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

std::string set(const std::string& text, const std::string& pointer, const json& value)
{
    return patched("a.json", text, {pointer, value});
}

std::string refusal(const std::string& text, const std::string& pointer, const json& value)
{
    const std::string message = complaint([&] { set(text, pointer, value); });
    EXPECT_TRUE(message.ends_with(" is right") || message.ends_with(" is right there")) << message;
    return message;
}

} // namespace

TEST(PatchTest, ReplacesAValueAndNothingElse)
{
    const std::string text = "// head\n{\n  \"a\": 1.50, // one\n  \"b\" : [1, /* x */ 2.0,3],\n  \"c\": {\"d\":true}\n}\n";
    EXPECT_EQ(set("[1]", "/0", 2.5), "[2.5]");
    EXPECT_EQ(
        set(text, "/a", -2), "// head\n{\n  \"a\": -2, // one\n  \"b\" : [1, /* x */ 2.0,3],\n  \"c\": {\"d\":true}\n}\n");
    EXPECT_EQ(set(text, "/b", {1, 2, 4.25}), // only the value that differs changes, so that the comment and 2.0 stay
        "// head\n{\n  \"a\": 1.50, // one\n  \"b\" : [1, /* x */ 2.0,4.25],\n  \"c\": {\"d\":true}\n}\n");
    EXPECT_EQ(set(text, "/b/0", 7),
        "// head\n{\n  \"a\": 1.50, // one\n  \"b\" : [7, /* x */ 2.0,3],\n  \"c\": {\"d\":true}\n}\n");
    EXPECT_EQ(set(text, "/c/d", "t\"e\\x\nt"),
        "// head\n{\n  \"a\": 1.50, // one\n  \"b\" : [1, /* x */ 2.0,3],\n  \"c\": {\"d\":\"t\\\"e\\\\x\\nt\"}\n}\n");
    EXPECT_EQ(set(text, "/b", {1, 2}), "// head\n{\n  \"a\": 1.50, // one\n  \"b\" : [1, 2],\n  \"c\": {\"d\":true}\n}\n");
    EXPECT_EQ(set(text, "/a", 1.5), text);
    EXPECT_EQ(set(text, "/a", false),
        "// head\n{\n  \"a\": false, // one\n  \"b\" : [1, /* x */ 2.0,3],\n  \"c\": {\"d\":true}\n}\n");
}

TEST(PatchTest, NumbersAreWrittenShortly)
{
    for (const auto& [value, shown] : std::vector<std::pair<double, std::string>>{{3.0, "3"}, {-40, "-40"}, {0.1, "0.1"},
             {0.065, "0.065"}, {1e300, "1e+300"}, {1 / 3., "0.3333333333333333"}, {5e-324, "5e-324"}})
        EXPECT_EQ(set("{\"a\":null}", "/a", value), "{\"a\":" + shown + "}");
    EXPECT_EQ(set("{\"a\":null}", "/a", {1.0, 0.5}), "{\"a\":[1, 0.5]}");
}

TEST(PatchTest, AddsAMemberAfterTheOpeningBrace)
{
    EXPECT_EQ(set("{}", "/a", 1), "{ \"a\": 1 }");
    EXPECT_EQ(set("{ }", "/a", 1), "{ \"a\": 1 }");
    EXPECT_EQ(set("{\n}", "/a", 1), "{ \"a\": 1\n}");
    EXPECT_EQ(set("{ // none yet\n}", "/a", 1), "{ \"a\": 1 // none yet\n}");
    EXPECT_EQ(set("{ \"b\": 2 }", "/a", 1), "{ \"a\": 1, \"b\": 2 }");
    EXPECT_EQ(set("{\n    \"b\": 2\n}", "/a", 1), "{\n    \"a\": 1,\n    \"b\": 2\n}");
    EXPECT_EQ(set("{\r\n\t\"b\": 2\r\n}", "/a", 1), "{\r\n\t\"a\": 1,\r\n\t\"b\": 2\r\n}");
    EXPECT_EQ(set("{ // about the whole\n  // about b\n  \"b\": 2 }", "/a", 1),
        "{ // about the whole\n  \"a\": 1,\n  // about b\n  \"b\": 2 }");
    EXPECT_EQ(set("{ /* long\n */ \"b\": 2 }", "/a", 1), "{ \"a\": 1, /* long\n */ \"b\": 2 }");
    EXPECT_EQ(set("{ // }\n \"b\": 2 }", "/a/b/c", {1, 2}), "{ // }\n \"a\": { \"b\": { \"c\": [1, 2] } },\n \"b\": 2 }");
    EXPECT_EQ(set("{ \"o\": [{ \"x\": 1 }, { }] }", "/o/1/x", 5), "{ \"o\": [{ \"x\": 1 }, { \"x\": 5 }] }");
    EXPECT_EQ(set("{}", "/a~1b/~0", "ä"), "{ \"a/b\": { \"~\": \"ä\" } }");
    EXPECT_EQ(set("{}", "/", true), "{ \"\": true }");
    EXPECT_EQ(set("{\"l\":{}}", "/l/0", 1), "{\"l\":{ \"0\": 1 }}"); // a name, not an index
}

TEST(PatchTest, ImpossibleChangesAreRefused)
{
    const std::string text = "{ \"n\": 1, \"o\": { \"a\": 1 }, \"l\": [1, 2], \"lo\": [{}] }";
    EXPECT_NE(refusal(text, "", 1).find("leads to no member"), std::string::npos);
    EXPECT_NE(refusal(text, "n", 1).find("leads to no member"), std::string::npos);
    EXPECT_NE(refusal(text, "/n~2", 1).find("neither ~0 nor ~1"), std::string::npos);
    EXPECT_NE(refusal(text, "/n~", 1).find("neither ~0 nor ~1"), std::string::npos);
    EXPECT_NE(refusal(text, "/n/a", 1).find("leads through /n, which has no members"), std::string::npos);
    for (const char* beyond : {"/l/2", "/l/-", "/l/a", "/l/01", "/l/-1", "/l/", "/l/999999999999999999999"})
        EXPECT_NE(refusal(text, beyond, 1).find("leads beyond the 2 elements of /l"), std::string::npos);
    EXPECT_NE(refusal(text, "/o", 1).find("is an object"), std::string::npos);
    EXPECT_NE(refusal(text, "/lo", 1).find("is a list of objects"), std::string::npos);
    for (const json& value : {json::object(), json(nullptr), json::parse("[[1]]"), json::parse("[\"a\"]"), json(NAN),
             json(INFINITY), json(std::vector<double>{1, NAN})})
        EXPECT_NE(refusal(text, "/n", value).find("can't be set to this"), std::string::npos) << value;
    EXPECT_NE(refusal(text, "/n", "\xff").find("not UTF-8"), std::string::npos);
    EXPECT_NE(refusal(text, "/\xff", 1).find("not UTF-8"), std::string::npos);
    std::string deep;
    for (int i = 0; i < 70; ++i)
        deep += "/a";
    EXPECT_NE(complaint([&] { set("{}", deep, 1); }).find("nested too deeply"), std::string::npos);
    EXPECT_NE(complaint([&] { set("{ 1 }", "/a", 1); }).find("a.json:1: column 3"), std::string::npos);
}

/// At random places of the shipped layouts: only the given member changes, and every comment stays.
TEST(PatchTest, ShippedLayoutsKeepEverythingElse)
{
    std::mt19937 random(1908);
    const std::vector<json> values{1, -2.5, true, "text", json::array({1, 2.5}), json::array(), 0};
    int set_count = 0;
    for (const auto& file : shipped("config/layouts")) {
        const std::string text = read_text(file);
        const json before = json::parse(text, nullptr, true, true);
        std::vector<std::string> pointers;
        const json flat = before.flatten();
        for (const auto& item : flat.items())
            pointers.push_back(item.key());
        for (int i = 0; i < 60; ++i) {
            std::string pointer = pointers[random() % pointers.size()];
            if (random() % 2)
                pointer = pointer.substr(0, pointer.rfind('/')) + "/new" + (random() % 2 ? "/deeper" : "");
            const json& value = values[random() % values.size()];
            std::string after;
            try {
                after = set(text, pointer, value);
            } catch (const InputError&) {
                continue; // a list has no member "new"
            }
            ++set_count;
            json expected = before;
            expected[json::json_pointer(pointer)] = value;
            ASSERT_EQ(json::parse(after, nullptr, true, true), expected) << pointer << " in\n" << after;
            std::size_t comment = 0, from = 0; // the same comments in the same order
            while ((comment = text.find("//", comment)) != text.npos) {
                const std::string words = text.substr(comment, text.find('\n', comment) - comment);
                if (words.find("://") == words.npos) {
                    from = after.find(words, from);
                    ASSERT_NE(from, after.npos) << words;
                }
                comment += words.size();
            }
        }
    }
    EXPECT_GT(set_count, 60);
}

TEST(PatchTest, MutatedFilesAreSetOrRefused)
{
    std::vector<std::string> seeds;
    for (const auto& file : shipped("config/layouts"))
        seeds.push_back(read_text(file));
    const std::vector<std::string> pointers{"/hud/width_deg", "/outputs/0/viewports/0/projection/turn_deg/yaw",
        "/outputs/0/size", "/stereo/separation_m", "/outputs/0/name"};
    std::mt19937 random(1915);
    int done = 0;
    for (int i = 0; i < fuzz_count() / 3; ++i) {
        const std::string text = mutated(seeds[random() % seeds.size()], random);
        const std::string pointer = pointers[random() % pointers.size()];
        try {
            const std::string after = set(text, pointer, json::array({3, 4}));
            ++done;
            const json before = json::parse(text, nullptr, true, true), now = json::parse(after, nullptr, true, true);
            ASSERT_EQ(now.at(json::json_pointer(pointer)), json({3, 4})) << text;
            for (const json& difference : json::diff(before, now)) {
                const std::string path = difference.at("path");
                ASSERT_TRUE(path.starts_with(pointer) || pointer.starts_with(path)) << path << " changed too in\n" << text;
            }
        } catch (const InputError& error) {
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(done, 20);
}

TEST(PatchTest, FilesAreReplacedInOneStep)
{
    const auto file = write_text("patch.json", "{ \"a\": 1 } // end\n");
    ASSERT_EQ(chmod(file.c_str(), 0640), 0);
    patch_file(file, {{"/a", 2}, {"/b/c", 3}});
    EXPECT_EQ(read_text(file), "{ \"b\": { \"c\": 3 }, \"a\": 2 } // end\n");
    struct stat status;
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0640u);

    const auto link = scratch("link.json");
    std::filesystem::create_symlink("patch.json", link);
    patch_file(link, {{"/a", 5}});
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_NE(read_text(file).find("\"a\": 5"), std::string::npos);

    // A patch applies wholly or not at all, and leaves no temporary file.
    const std::string before = read_text(file);
    EXPECT_NE(complaint([&] { patch_file(file, {{"/a", 6}, {"/a/b", 7}}); }).find("leads through /a"), std::string::npos);
    EXPECT_EQ(read_text(file), before);
    EXPECT_NE(complaint([] { patch_file("no/such.json", {{"/a", 1}}); }).find("does not exist"), std::string::npos);
    for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
        EXPECT_EQ(entry.path().filename().string().find("patch.json."), std::string::npos) << entry.path();
}

} // namespace patch_test
