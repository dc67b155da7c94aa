#include "config/json/reader.h"
#include "tests/support/files.h"

namespace reader_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

Document document(const std::string& text) { return read_document(write_text("reader.json", text)); }
std::string refusal(const std::string& text)
{
    return complaint([&] { document(text); });
}
std::string at_line(int line, const std::string& rest)
{
    return scratch("reader.json").string() + ":" + std::to_string(line) + ": " + rest;
}

} // namespace

// Each typing mistake is reported at its line, in words that don't mention the parser's state.
TEST(ReaderTest, InvalidJsonIsReportedWithARemedy)
{
    const std::vector<std::array<std::string, 3>> cases = {
        {"{\n \"a\": [\n {\"b\": \"c\" // d\n \"e\": 1}]}", "3", "is followed by \"e\"; a comma"},
        {"{\n \"a\": 1\n \"b\": 2}", "2", "is followed by \"b\"; a comma"},
        {"{\n \"a\": [1\n 2.5e3]}", "2", "is followed by 2.5e3; a comma"},
        {"{\"a\": 1,\n}", "2", "} follows a comma"},
        {"{\"a\": [1,\n]}", "2", "] follows a comma"},
        {"{a: 1}", "1", "a stands where a name should"},
        {"{'a': 1}", "1", "' stands where a name should"},
        {"{\"a\" 1}", "1", "1 follows a name; a colon"},
        {"{\"a\":\ntru}", "2", "tru is not a value"},
        {"{\"a\": +1}", "1", "+1 is not a value"},
        {"{\"a\": .5}", "1", ".5 is not a value"},
        {"{\"a\": 0x1F}", "1", "0x1F is not a value"},
        {"{\"a\": 1", "1", "ends too early"},
        {"{\"a\": \"b\n}", "1", "a text has no end"},
        {"{\"a\": \"\\q\"}", "1", "can't be read"},
        {"{\"a\": 1}}", "1", "} comes after the end"},
        {"{\"a\": [1, 2}", "1", "is followed by }; a comma between them, or a closing ]"},
        {"{\"a\": NaN}", "1", "NaN is not a value"},
    };
    for (const auto& [text, line, problem] : cases)
        try {
            parse_document("f", text);
            FAIL() << text;
        } catch (const InputError& error) {
            const std::string what = error.what();
            EXPECT_TRUE(what.starts_with("f:" + line + ": ")) << text << "\n" << what;
            EXPECT_NE(what.find(problem), what.npos) << text << "\n" << what;
            EXPECT_TRUE(what.ends_with("right")) << what;
        }
}

TEST(ReaderTest, OtherProgramsFilesAreNamed)
{
    using namespace std::string_literals;
    for (const std::string& text : {"\xff\xfe{\0}\0"s, "\xfe\xff\0{\0}"s, "{\0\n\0}\0"s, "\0{\0}"s})
        EXPECT_TRUE(refusal(text).ends_with(
            "reader.json: is written in UTF-16; UTF-8 is right, which editors offer when a file is saved"))
            << refusal(text);
    for (const auto& [name, kind] : {std::pair{"a.obj", "a Wavefront OBJ"}, {"b.FBX", "an FBX"}, {"c.dae", "a COLLADA"}}) {
        const auto file = write_text(name, "# x");
        EXPECT_EQ(complaint([&] { read_document(file); }),
            file.string() + ": is " + kind
                + " model by its name; glTF 2.0 (.glb or .gltf) is right, and Blender exports it");
    }
}

TEST(ReaderTest, CommentsAreAllowed)
{
    const Document d = document("// one\n{ /* two */ \"a\": 1 } // three");
    EXPECT_EQ(number(member(root(d), "a"), {0, 2}), 1);
}

TEST(ReaderTest, UnreadableFilesAreReported)
{
    EXPECT_EQ(complaint([] { read_document("no/such.json"); }), "no/such.json: does not exist; a JSON file is right");
    EXPECT_EQ(complaint([] { read_document("/usr"); }), "/usr: is a folder; a JSON file is right");
    EXPECT_NE(refusal("").find("is empty; "), std::string::npos);
    // This file opens, but reading at address 0 fails, even for root.
    EXPECT_NE(complaint([] { read_document("/proc/self/mem"); }).find("can't be read"), std::string::npos);
    const auto through_file = write_text("plain", "x") / "below.json";
    EXPECT_NE(complaint([&] { read_document(through_file); }).find("can't be opened"), std::string::npos);
    EXPECT_EQ(complaint([] { read_document("/dev/zero"); }), "/dev/zero: is a device, not a file; a JSON file is right");
    EXPECT_EQ(complaint([] { read_document("two\nlines"); }), "two?lines: does not exist; a JSON file is right");
}

TEST(ReaderTest, APlainTextSteersNoTerminal)
{
    // Every code point in UTF-8, as Unicode's table of general categories and UAX 9 name those that steer.
    for (std::uint32_t code = 0; code < 0x110000; ++code) {
        if (code >= 0xd800 && code < 0xe000)
            continue;
        const auto tail = [&](int shift) { return char(0x80 | (code >> shift & 0x3f)); };
        const std::string text = code < 0x80 ? std::string{char(code)}
            : code < 0x800                   ? std::string{char(0xc0 | code >> 6), tail(0)}
            : code < 0x10000                 ? std::string{char(0xe0 | code >> 12), tail(6), tail(0)}
                                             : std::string{char(0xf0 | code >> 18), tail(12), tail(6), tail(0)};
        const bool control = code < 0x20 || (code >= 0x7f && code <= 0x9f);
        const bool direction = code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e)
            || (code >= 0x2066 && code <= 0x2069);
        const bool separator = code == 0x2028 || code == 0x2029;
        ASSERT_EQ(plain_text(text), control || direction || separator ? "?" : text) << std::hex << code;
    }
    for (int first = 0x80; first < 0x100; ++first) { // no byte of 128 and more stands alone
        EXPECT_EQ(plain_text(std::string{char(first)}), "?");
        EXPECT_EQ(plain_text(std::string{char(first), 'a'}), "?a");
    }
    EXPECT_EQ(plain_text("\xed\xa0\x80"), "???") << "half of a surrogate pair";
    EXPECT_EQ(plain_text("\xe0\x82\x9b"), "???") << "a control character in three bytes";
    const Document named = document("{ \"a\": \"b\\u202ec\" }");
    EXPECT_NE(complaint([&] { text(member(root(named), "a")); }).find("holds a control character"), std::string::npos);
    EXPECT_EQ(one_line("\xc2\x9b"
                       "2J"),
        "?2J");
}

TEST(ReaderTest, FilesOfSixteenMebibytesAreRead)
{
    const std::string start = "{ \"a\": 1 }";
    EXPECT_NO_THROW(document(start + std::string((16 << 20) - start.size(), ' ')));
    EXPECT_NE(
        refusal(start + std::string((16 << 20) + 1 - start.size(), ' ')).find("larger than 16 MiB"), std::string::npos);
}

TEST(ReaderTest, SyntaxErrorsHaveLineAndColumn)
{
    for (const auto& [text, line, place] : std::vector<std::tuple<std::string, int, std::string>>{
             {"{", 1, "column 2: "},
             {"{\n  \"a\": 1,\n}", 3, "column 1: "},
             {"{\n  \"a\": NaN\n}", 2, "column 8: "},
             {"{ \"a\": Infinity }", 1, "column 8: "},
             {"{ \"a\": -Infinity }", 1, "column 8: "},
             {"{ \"a\": 1 } 2", 1, "column 12: "},
             {"{ \"a\": 01 }", 1, "column 8: "},
             {"{ 'a': 1 }", 1, "column 3: "},
             {"{ \"a\" 1 }", 1, "column 7: "},
             {"[1, 2", 1, "column 6: "},
             {"{ \"a\": \"open", 1, "column 13: "},
             {"{ \"a\": \"\n\" }", 1, "column 9: "},
             {"{ \"a\": \"\xff\" }", 1, "column 9: "},
             {"{ \"ä\": x }", 1, "column 8: "},
             {"/* open", 1, "column 8: "},
             {"// only a comment", 1, "column 18: "},
             {"   ", 1, "column 4: "},
             {std::string(1, '\0'), 1, "column 1: "},
             {"\xef\xbb", 1, "column 2: "},
         }) {
        SCOPED_TRACE(text);
        const std::string message = refusal(text), start = at_line(line, place);
        EXPECT_EQ(message.substr(0, start.size()), start);
    }
    EXPECT_LT(refusal("\"" + std::string(1 << 20, 'x')).size(), 700u); // the message does not contain the whole text
}

TEST(ReaderTest, NumbersBeyondADoubleAreRefused)
{
    const std::string right = " is too large for a number; up to 1.79e308 is right";
    EXPECT_EQ(refusal("{ \"a\": [0, { \"b/~\": 1e999 }] }"), at_line(1, "/a/1/b~1~0: 1e999" + right));
    EXPECT_EQ(refusal("[[1, 2], -1e400]"), at_line(1, "/1: -1e400" + right));
    EXPECT_EQ(refusal("1e999"), at_line(1, "1e999" + right));
    EXPECT_NO_THROW(document("[1e-999, 99999999999999999999999]"));
}

TEST(ReaderTest, RepeatedMembersAreRefused)
{
    EXPECT_EQ(
        refusal("{ \"a\": { \"b\": 1, \"b\": 1 } }"), at_line(1, "/a/b: \"b\" is given twice; one of the two is right"));
    EXPECT_EQ(refusal("[0, {\"\": 1, \"\": 2}]"), at_line(1, "/1/: \"\" is given twice; one of the two is right"));
    EXPECT_NO_THROW(document("{ \"a\": { \"b\": 1 }, \"b\": { \"b\": 1 } }"));
}

TEST(ReaderTest, DeepNestingIsRefused)
{
    const std::string open(64, '['), close(64, ']');
    EXPECT_NO_THROW(document(open + close));
    EXPECT_NE(refusal(open + "[]" + close).find("is nested too deeply; at most 64 levels are right"), std::string::npos);
    EXPECT_NE(refusal(std::string(1 << 20, '[')).find("nested too deeply"), std::string::npos);
    std::string objects;
    for (int i = 0; i < 65; ++i)
        objects += "{\"a\":";
    EXPECT_NE(refusal(objects).find("nested too deeply"), std::string::npos);
}

TEST(ReaderTest, UnknownMembersNameTheNearest)
{
    const Document d = document("{ \"gama\": 4 }");
    EXPECT_EQ(complaint([&] {
        reject_unknown_members(root(d), {"rapidity", "direction", "beta", "gamma"});
    }),
        at_line(1, "/gama: 4 stands under an unknown name; \"gamma\", \"beta\" or \"rapidity\" is right"));
    const Document long_name = document("{ \"" + std::string(100000, 'x') + "\": 1 }");
    EXPECT_LT(complaint([&] { reject_unknown_members(root(long_name), {"a"}); }).size(), 700u);
}

TEST(ReaderTest, ValuesOfTheWrongKindAreRefused)
{
    std::string long_text;
    for (int i = 0; i < 100; ++i)
        long_text += "ä";
    const Document d = document(R"({ "n": 5, "f": 1.5, "s": "text", "b": true, "z": null, "v": [1, "x", 3], "o": {},
        "e": "", "c": "a\u0000b", "long": ")"
        + long_text + "\" }");
    const auto at = [&](const char* name) { return member(root(d), name); };
    const std::vector<std::pair<std::string, std::string>> cases{
        {complaint([&] {
             number(at("s"), {0, 1});
         }),
            "/s: \"text\" is not a number; a number from 0 to 1 is right"},
        {complaint([&] {
             number(at("z"), {0, 1});
         }),
            "/z: null is not a number; a number from 0 to 1 is right"},
        {complaint([&] {
             number(at("n"), {0, 1});
         }),
            "/n: 5 is too large; a number from 0 to 1 is right"},
        {complaint([&] {
             number(at("n"), {5, 1e12, true});
         }),
            "/n: 5 is too small; a number above 5 up to 1e+12 is right"},
        {complaint([&] { integer(at("f"), 1, 9); }), "/f: 1.5 is not a whole number; one from 1 to 9 is right"},
        {complaint([&] { boolean(at("n")); }), "/n: 5 is neither true nor false; one of these is right"},
        {complaint([&] { text(at("b")); }), "/b: true is not a text; a text in double quotes is right"},
        {complaint([&] { text(at("e")); }), "/e: \"\" is empty; a text with at least one letter is right"},
        {complaint([&] { text(at("c")); }), "/c: \"a\\u0000b\" holds a control character; a text without them is right"},
        {complaint([&] {
             one_of(at("s"), {"one", "two"});
         }),
            "/s: \"text\" is not known here; \"one\" or \"two\" is right"},
        {complaint([&] { one_of(at("n"), {"one"}); }), "/n: 5 is not known here; \"one\" is right"},
        {complaint([&] {
             vec3(at("v"), {0, 9});
         }),
            "/v/1: \"x\" is not a number; a number from 0 to 9 is right"},
        {complaint([&] {
             vec4(at("v"), {0, 9});
         }),
            "/v: [1,\"x\",3] has length 3; a list of 4 numbers in [ ] is right"},
        {complaint([&] {
             vec3(at("n"), {0, 9});
         }),
            "/n: 5 is not a list; a list of 3 numbers in [ ] is right"},
        {complaint([&] { reject_unknown_members(at("v"), {}); }),
            "/v: [1,\"x\",3] is not an object; an object in { } is right"},
        {complaint([&] { member(at("o"), "a"); }), "/o: {} lacks \"a\"; an object with this member is right"},
    };
    for (const auto& [message, expected] : cases)
        EXPECT_EQ(message, at_line(expected.starts_with("/e") || expected.starts_with("/c") ? 2 : 1, expected));
    const std::string cut = complaint([&] { boolean(at("long")); });
    EXPECT_NE(cut.find("ä... is neither"), std::string::npos) << cut; // the text is cut between letters
    EXPECT_FALSE(find_member(root(d), "nothing"));
}

TEST(ReaderTest, MutatedFilesAreReadOrRefused)
{
    expect_survives([](const auto& file) { read_document(file); },
        {"{ \"a\": [1, 2.5, -3e5], \"b\": { \"c\": \"text\", \"d\": null }, // comment\n \"e\": true }", "[[[[]]]]"});
}

} // namespace reader_test
