#include "config/json/whole_file.h"
#include "runtime/images/capture.h"
#include "tests/support/files.h"
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <stb/stb_image.h>
#include <sys/resource.h>

namespace capture_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// Random bits: NaNs with payloads, infinities, denormals.
Channels planes(glm::ivec2 size, const std::vector<std::string>& names, bool smooth)
{
    std::mt19937 random(7);
    Channels channels;
    for (const std::string& name : names) {
        std::vector<float> plane(std::size_t(size.x) * size.y);
        for (std::size_t i = 0; i < plane.size(); ++i) {
            const std::uint32_t bits = random();
            std::memcpy(&plane[i], &bits, sizeof bits);
            if (smooth)
                plane[i] = float(i) * 0.25f;
        }
        plane[0] = std::numeric_limits<float>::quiet_NaN();
        plane[plane.size() / 2] = -std::numeric_limits<float>::infinity();
        channels.emplace_back(name, plane);
    }
    return channels;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

int files_beside(const std::filesystem::path& file)
{
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
        ++count;
    return count;
}

std::filesystem::path folder(const std::string& name)
{
    const auto path = scratch(name);
    std::filesystem::create_directories(path);
    return path;
}

} // namespace

TEST(CaptureTest, PngKeepsEveryByteWithoutAlpha)
{
    const glm::ivec2 size(37, 23);
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < size.x * size.y * 4; ++i)
        rgba.push_back(std::uint8_t(i * 7 + i / 256));
    const auto file = folder("png") / "picture.png";
    write_png(file, size, rgba);
    EXPECT_EQ(files_beside(file), 1);
    int w = 0, h = 0, n = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> read(stbi_load(file.c_str(), &w, &h, &n, 0), stbi_image_free);
    ASSERT_TRUE(read);
    ASSERT_EQ(glm::ivec2(w, h), size);
    ASSERT_EQ(n, 3); // alpha is dropped
    for (int i = 0; i < w * h; ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(read.get()[i * 3 + c], rgba[std::size_t(i) * 4 + c]);

    const auto [size_again, again] = read_png(file);
    ASSERT_EQ(size_again, size);
    ASSERT_EQ(again.size(), rgba.size());
    for (std::size_t i = 0; i < again.size(); ++i)
        ASSERT_EQ(again[i], i % 4 == 3 ? 255 : rgba[i]);
    write_whole(file, "no picture");
    EXPECT_NE(complaint([&] { read_png(file); }).find("a whole PNG file is right"), std::string::npos);
}

TEST(CaptureTest, ExrKeepsEveryBit)
{
    const std::vector<std::string> names{
        "Y", "cameraDirection.X", "cameraDirection.Z", "A", "B", "aNameBeyondTheThirtyOneLettersOfOldFiles.X"};
    for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(33, 17), glm::ivec2(64, 16), glm::ivec2(5, 100)})
        for (bool smooth : {false, true}) {
            const Channels channels = planes(size, names, smooth);
            const auto file = scratch("picture.exr");
            write_exr(file, size, channels);
            const auto [read_size, read] = read_exr(file);
            ASSERT_EQ(read_size, size);
            ASSERT_EQ(read.size(), names.size());
            for (std::size_t i = 0; i + 1 < read.size(); ++i)
                EXPECT_LT(read[i].first, read[i + 1].first);
            for (const auto& [name, plane] : channels) {
                const auto found = std::find_if(read.begin(), read.end(), [&](const auto& c) { return c.first == name; });
                ASSERT_NE(found, read.end()) << name;
                EXPECT_TRUE(same_bits(found->second, plane)) << name;
            }
        }
}

TEST(CaptureTest, TheSamePictureGivesTheSameBytes)
{
    Channels channels = planes({40, 50}, {"R", "G", "B"}, true);
    write_exr(scratch("one.exr"), {40, 50}, channels);
    std::swap(channels[0], channels[2]);
    write_exr(scratch("two.exr"), {40, 50}, channels);
    EXPECT_EQ(read_text(scratch("one.exr")), read_text(scratch("two.exr")));
    EXPECT_LT(read_text(scratch("one.exr")).size(), 3u * 40 * 50 * 4); // compressed
}

TEST(CaptureTest, PlacesThatCantBeWrittenAreNamed)
{
    const std::vector<std::uint8_t> pixel{1, 2, 3, 4};
    const auto missing = scratch("no/such/folder/a.png");
    EXPECT_EQ(complaint([&] {
        write_png(missing, {1, 1}, pixel);
    }),
        missing.string() + ": can't be written (No such file or directory); a place for a file is right");
    const auto taken = folder("taken");
    EXPECT_NE(complaint([&] { write_png(taken, {1, 1}, pixel); }).find("is there and is not a file"), std::string::npos);
    EXPECT_NE(complaint([&] { write_exr("/dev/null", {1, 1}, {{"Y", {1.f}}}); }).find("is not a file"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    EXPECT_NE(complaint([&] { write_png("/proc/a.png", {1, 1}, pixel); }).find("can't be written"), std::string::npos);
}

TEST(CaptureTest, AFailureLeavesTheOldFileAndNoTemporaryFile)
{
    const auto file = folder("full") / "old.png";
    std::ofstream(file) << "old";
    // A limit on the length of files stands in for a full disk.
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit small{64, limit.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    std::string message;
    try {
        write_png(file, {64, 64}, std::vector<std::uint8_t>(64 * 64 * 4));
    } catch (const InputError& error) {
        message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(message, file.string() + ": can't be written (File too large); a place for a file is right");
    EXPECT_EQ(read_text(file), "old");
    EXPECT_EQ(files_beside(file), 1);
}

TEST(CaptureTest, LinksStayLinks)
{
    const auto place = folder("links");
    std::ofstream(place / "true.png") << "old";
    std::filesystem::create_symlink(place / "true.png", place / "link.png");
    write_png(place / "link.png", {1, 1}, {1, 2, 3, 4});
    EXPECT_TRUE(std::filesystem::is_symlink(place / "link.png"));
    EXPECT_NE(read_text(place / "true.png"), "old");
}

TEST(CaptureTest, WrongCallsThrowALogicError)
{
    EXPECT_THROW(write_png(scratch("a.png"), {2, 2}, {1, 2, 3, 4}), std::logic_error);
    EXPECT_THROW(write_png(scratch("a.png"), {0, 2}, {}), std::logic_error);
    EXPECT_THROW(write_exr(scratch("a.exr"), {2, 2}, {{"Y", {1.f}}}), std::logic_error);
    EXPECT_THROW(write_exr(scratch("a.exr"), {1, 1}, {}), std::logic_error);
    EXPECT_THROW(write_exr(scratch("a.exr"), {1, 1}, {{"", {1.f}}}), std::logic_error);
    EXPECT_THROW(write_exr(scratch("a.exr"), {1, 1}, {{"Y", {1.f}}, {"Y", {2.f}}}), std::logic_error);
    EXPECT_FALSE(std::filesystem::exists(scratch("a.exr")));
}

TEST(CaptureTest, BrokenExrFilesAreRefused)
{
    EXPECT_NE(complaint([] { read_exr("no/such.exr"); }).find("no/such.exr: does not exist"), std::string::npos);
    EXPECT_NE(complaint([] { read_exr("/usr"); }).find("is a folder"), std::string::npos);
    EXPECT_NE(complaint([] { read_exr(write_text("a.exr", "")); }).find("is not an EXR file"), std::string::npos);
    EXPECT_NE(
        complaint([] { read_exr(write_text("a.exr", "{ \"no\": 1 }")); }).find("is not an EXR file"), std::string::npos);

    write_exr(scratch("whole.exr"), {7, 40}, planes({7, 40}, {"R", "a.X"}, true));
    const std::string whole = read_text(scratch("whole.exr"));
    for (std::size_t length = 0; length < whole.size(); length += length < 500 ? 1 : 37)
        complaint([&] { read_exr(write_text("cut.exr", whole.substr(0, length))); });
}

TEST(CaptureTest, MutatedExrFilesAreReadOrRefused)
{
    write_exr(scratch("seed.exr"), {7, 40}, planes({7, 40}, {"R", "a.X"}, true));
    write_exr(scratch("noise.exr"), {9, 20}, planes({9, 20}, {"R"}, false));
    const std::vector<std::string> wholes{read_text(scratch("seed.exr")), read_text(scratch("noise.exr"))};
    std::mt19937 random(11);
    int loaded = 0, refused = 0;
    for (int i = 0; i < fuzz_count(); ++i) {
        std::string bytes = wholes[random() % 2];
        for (unsigned faults = 1 + random() % 3; faults > 0; --faults) {
            const std::size_t at = random() % std::min<std::size_t>(bytes.size(), random() % 2 ? 460 : bytes.size());
            const char extremes[]{0, 1, 0x7f, char(0x80), char(0xff), char(random())};
            bytes[at] = extremes[random() % 6];
        }
        try {
            read_exr(write_text("mutated.exr", bytes));
            ++loaded;
        } catch (const InputError& error) {
            ++refused;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(loaded, 0);
    EXPECT_GT(refused, 0);
}

} // namespace capture_test
