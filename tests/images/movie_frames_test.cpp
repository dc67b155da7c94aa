// The frames of an interrupted movie: a damaged one is drawn again, and no frame of other sources is taken.
#include "runtime/images/capture.h"
#include "runtime/images/movie.h"
#include "tests/support/damage.h"

namespace movie_frames_test {

using namespace starbow;
using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

const std::string sources = "{\"scene\":\"0123456789abcdef\",\"frames\":30}\n";
const auto silent = [](const std::string&) {};

void draw(const fs::path& file)
{
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 6 * 4 * 4; ++i)
        rgba.push_back(std::uint8_t(11 * i));
    write_png(file, {6, 4}, rgba);
}

TEST(MovieFrames, ADamagedFrameIsNotThere)
{
    const fs::path movie = scratch("damaged") / "movie.mp4", other = scratch("damaged") / "other.mp4";
    const MovieFrames frames(movie, sources, false, silent), others(other, sources, false, silent);
    const fs::path file = frames.file("wall", 7);
    EXPECT_FALSE(frames.has("wall", 7));
    draw(file);
    EXPECT_TRUE(frames.has("wall", 7));
    const std::string whole = read_text(file);
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        EXPECT_FALSE(frames.has("wall", 7)) << how;
    });
    // Among the parts of other machines a damaged frame is missing, here and there.
    others.add(frames.folder());
    EXPECT_FALSE(fs::exists(others.file("wall", 7)));
    write_bytes(others.file("wall", 7), whole.substr(0, 50));
    draw(file);
    others.add(frames.folder());
    EXPECT_EQ(read_text(others.file("wall", 7)), whole);
}

TEST(MovieFrames, FramesOfDamagedSourcesAreDrawnAgain)
{
    const fs::path movie = scratch("sources") / "movie.mp4";
    fs::path file;
    {
        const MovieFrames frames(movie, sources, false, silent);
        file = frames.folder() / "made-from.json";
    }
    ASSERT_EQ(read_text(file), sources);
    for_each_damage(sources, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        draw(MovieFrames::folder_of(movie) / "wall-000007.png");
        EXPECT_FALSE(complaint([&] { MovieFrames(movie, sources, true, silent); }).empty()) << how;
        const MovieFrames frames(movie, sources, false, silent);
        EXPECT_FALSE(frames.has("wall", 7)) << how;
        EXPECT_EQ(read_text(file), sources) << how;
    });
}

} // namespace
} // namespace movie_frames_test
