#include "config/json/reader.h"
#include "tests/support/files.h"
#include <functional>

namespace span_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// The text of the value at a pointer, as the file has it.
std::string slice(const std::string& text, const std::string& pointer)
{
    const Document d = parse_document("a.json", text);
    const auto span = find_span(d, pointer);
    if (!span)
        return "nothing";
    return text.substr(span->begin, span->end - span->begin);
}

int line(const std::string& text, const std::string& pointer)
{
    const Document d = parse_document("a.json", text);
    return find_span(d, pointer).value().line;
}

/// Calls act for every value of a document, with its pointer.
void each(const Place& place, const std::function<void(const Place&)>& act)
{
    act(place);
    if (place.json->is_object())
        for (const auto& [name, value] : place.json->items())
            each(find_member(place, name).value(), act);
    else if (place.json->is_array())
        for (const Place& element : items(place, 0, 1000000, "things"))
            each(element, act);
}

/// The bytes of every value's span, parsed alone, must give that value. A span that is too short or too long would give
/// another number, or none. Each search takes time in proportion to the file, so only one value of `step` is checked, from
/// the `first` on.
void expect_slices_parse_back(const std::string& text, std::size_t step, std::size_t first = 0)
{
    SCOPED_TRACE(text.substr(0, 300));
    const Document d = parse_document("a.json", text);
    std::size_t index = step - first;
    each(root(d), [&](const Place& place) {
        if (index++ % step != 0)
            return;
        const auto span = find_span(d, place.pointer);
        ASSERT_TRUE(span) << place.pointer;
        ASSERT_LT(span->begin, span->end);
        ASSERT_LE(span->end, text.size());
        const std::string bytes = text.substr(span->begin, span->end - span->begin);
        EXPECT_EQ(nlohmann::json::parse(bytes, nullptr, true, true), *place.json) << place.pointer << ": " << bytes;
        // A value's span has no white space and no comment around it.
        EXPECT_EQ(bytes.find_first_of(" \t\r\n/"), bytes.find_first_of(" \t\r\n/", 1));
        EXPECT_TRUE(bytes.front() == '{' || bytes.front() == '[' || bytes.front() == '"'
            || bytes.find_first_of(" \t\r\n,:]}/") == bytes.npos)
            << bytes;
        EXPECT_EQ(span->line, 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(span->begin), '\n'));
        if (place.json->is_object()) {
            ASSERT_EQ(span->first_key.has_value(), !place.json->empty());
            if (span->first_key) {
                EXPECT_EQ(text[*span->first_key], '"');
                const std::string between = text.substr(span->begin + 1, *span->first_key - span->begin - 1);
                EXPECT_TRUE(nlohmann::json::parse("{" + between + "}", nullptr, true, true).empty()) << between;
            }
        }
    });
}

} // namespace

TEST(SpanTest, EveryKindOfValueHasItsSpan)
{
    const std::string text
        = R"({ "n": -1.5e+3, "i": 0, "t": true, "f": false, "z": null, "s": "a", "l": [1, [ ], {}], "o": { "x": 12 } })";
    EXPECT_EQ(slice(text, ""), text);
    EXPECT_EQ(slice(text, "/n"), "-1.5e+3");
    EXPECT_EQ(slice(text, "/i"), "0");
    EXPECT_EQ(slice(text, "/t"), "true");
    EXPECT_EQ(slice(text, "/f"), "false");
    EXPECT_EQ(slice(text, "/z"), "null");
    EXPECT_EQ(slice(text, "/s"), "\"a\"");
    EXPECT_EQ(slice(text, "/l"), "[1, [ ], {}]");
    EXPECT_EQ(slice(text, "/l/0"), "1");
    EXPECT_EQ(slice(text, "/l/1"), "[ ]");
    EXPECT_EQ(slice(text, "/l/2"), "{}");
    EXPECT_EQ(slice(text, "/o"), "{ \"x\": 12 }");
    EXPECT_EQ(slice(text, "/o/x"), "12");
    for (const char* none : {"/", "/q", "/o/y", "/l/3", "/l/00", "/n/0", "x", "//", "/o/x/"})
        EXPECT_EQ(slice(text, none), "nothing") << none;
}

TEST(SpanTest, NumbersEndAtTheNextCharacter)
{
    for (const char* number : {"0", "-0", "12", "1.25", "-1E5", "1e-05", "99999999999999999999"})
        for (const char* after : {"]", ",0]", " ]", "\n]", "\r\n]", "\t]", "/* 9 */]", "// 9\n]"}) {
            EXPECT_EQ(slice(std::string("[") + number + after, "/0"), number) << after;
            EXPECT_EQ(slice(std::string("[/*1*/") + number + after, "/0"), number) << after;
            EXPECT_EQ(slice(std::string("[ // 1\n") + number + after, "/0"), number) << after;
        }
    EXPECT_EQ(slice("12", ""), "12"); // the end of the file
    EXPECT_EQ(slice("12\n", ""), "12");
    EXPECT_EQ(slice("{\"a\":12}", "/a"), "12");
    EXPECT_EQ(slice("\xef\xbb\xbf"
                    "12",
                  ""),
        "12"); // a byte order mark
}

TEST(SpanTest, StringsMayHaveQuotesAndBackslashes)
{
    for (const char* string : {R"("")", R"("\"")", R"("\\")", R"("\\\"")", R"("a\"b\\")", R"("\u0022\\\\")",
             R"("// no /* comment")", R"("{[,:")", "\"\xc3\xa4\"", R"("\"\"\"")"}) {
        EXPECT_EQ(slice(string, ""), string);
        EXPECT_EQ(slice(std::string("[\"\\\\\",") + string + "]", "/1"), string);
        EXPECT_EQ(slice(std::string("[ /* \" \\ */") + string + " /* \" */ ]", "/0"), string);
        EXPECT_EQ(slice(std::string("[ // \\\n") + string + "]", "/0"), string);
        const std::string name = nlohmann::json::parse(string);
        EXPECT_EQ(slice(std::string("{") + string + ":" + string + "}", std::string("/").append(escaped(name))), string);
    }
}

TEST(SpanTest, ValuesKnowTheirLine)
{
    const std::string text = "// one\n{\r\n \"a\": 1,\r\n \"b\": [\n2,\n /* \n */ 3 ],\n\"c\": { \"d\":\n\"x\\ny\" } }";
    EXPECT_EQ(line(text, ""), 2);
    EXPECT_EQ(line(text, "/a"), 3);
    EXPECT_EQ(line(text, "/b"), 4);
    EXPECT_EQ(line(text, "/b/0"), 5);
    EXPECT_EQ(line(text, "/b/1"), 7);
    EXPECT_EQ(line(text, "/c"), 8);
    EXPECT_EQ(line(text, "/c/d"), 9);
    const Document d = parse_document("a.json", text);
    EXPECT_EQ(complaint([&] { boolean(*find_member(*find_member(root(d), "c"), "d")); }),
        "a.json:9: /c/d: \"x\\ny\" is neither true nor false; one of these is right");
    EXPECT_EQ(complaint([&] { member(root(d), "e"); }).substr(0, 10), "a.json:2: ");
}

TEST(SpanTest, NamesMayNeedEscapes)
{
    const std::string text = R"({ "a/b": 1, "~": 2, "": 3, "\u0041": 4, "0": [5], "~1": 6 })";
    EXPECT_EQ(slice(text, "/a~1b"), "1");
    EXPECT_EQ(slice(text, "/~0"), "2");
    EXPECT_EQ(slice(text, "/"), "3");
    EXPECT_EQ(slice(text, "/A"), "4");
    EXPECT_EQ(slice(text, "/0/0"), "5");
    EXPECT_EQ(slice(text, "/~01"), "6");
}

TEST(SpanTest, SpansOfShippedAndMutatedFilesParseBack)
{
    std::vector<std::string> seeds;
    for (const char* folder : {"config/layouts", "config/scenes", "config/shots"})
        for (const auto& file : shipped(folder)) {
            seeds.push_back(read_text(file));
            if (!all_cases() && seeds.size() % 4 != 0)
                continue;
            const auto step_in = [](const std::string& text) { return all_cases() ? 1 : 1 + text.size() / 1024; };
            expect_slices_parse_back(seeds.back(), step_in(seeds.back()));
            std::string windows = "\xef\xbb\xbf";
            for (char c : seeds.back())
                windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
            expect_slices_parse_back(windows, step_in(windows));
        }
    std::mt19937 random(1905);
    int parsed = 0;
    for (int i = 0; i < fuzz_count() / 5; ++i) {
        const std::string text = mutated(seeds[random() % seeds.size()], random);
        try {
            parse_document("a.json", text);
        } catch (const InputError&) {
            continue;
        }
        ++parsed;
        const std::size_t step = 1 + text.size() / 1024;
        expect_slices_parse_back(text, step, random() % step);
        if (HasFailure())
            break;
    }
    EXPECT_GT(parsed, 20);
}

} // namespace span_test
