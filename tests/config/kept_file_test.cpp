// Files that the program keeps for a later start: whichever bit is wrong, and wherever they end, they are not read.
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "config/json/row_cache.h"
#include "tests/support/damage.h"
#include <set>
#include <sys/stat.h>

namespace kept_file_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

struct Parts {
    std::vector<float> numbers;
    std::string text;
    std::int32_t one = 0;
    bool operator==(const Parts&) const = default;
};

bool read(const std::filesystem::path& path, std::uint64_t key, Parts& to)
{
    KeptFile file(path, "parts1", key);
    to.numbers.resize(file.size(0) / sizeof(float));
    to.text.resize(file.size(1));
    return file.read({bytes_of(to.numbers), bytes_of(to.text), bytes_of(to.one)});
}

TEST(KeptFiles, AreReadWholeOrNotAtAll)
{
    const Parts made{{1, -2.5f, 3}, "some bytes more", 77};
    const std::filesystem::path file = scratch("kept") / "parts";
    write_kept(file, "parts1", 5, {bytes_of(made.numbers), bytes_of(made.text), bytes_of(made.one)}, 0600);
    struct stat about { };
    ASSERT_EQ(stat(file.c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777, 0600u);
    const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(50);
    std::filesystem::last_write_time(file, long_ago);
    Parts kept;
    ASSERT_TRUE(read(file, 5, kept));
    EXPECT_EQ(kept, made);
    EXPECT_GT(std::filesystem::last_write_time(file), long_ago + std::chrono::hours(40)) << "it was just read";
    EXPECT_FALSE(read(file, 6, kept)) << "another key";
    EXPECT_FALSE(read(scratch("kept") / "none", 5, kept));
    EXPECT_FALSE(read(scratch("kept"), 5, kept)) << "a folder";
    for (const char* kind : {"parts2", "parts", "parts11", ""}) {
        KeptFile other(file, kind, 5);
        EXPECT_EQ(other.size(0), 0u) << kind;
    }
    {
        KeptFile fewer(file, "parts1", 5), shifted(file, "parts1", 5);
        EXPECT_FALSE(fewer.read({bytes_of(kept.numbers), bytes_of(kept.text)}));
        std::string longer(made.text.size() + 4, ' ');
        EXPECT_FALSE(shifted.read({bytes_of(kept.numbers), bytes_of(longer)}));
    }
    const std::string whole = read_text(file);
    std::size_t count = 0;
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        EXPECT_FALSE(read(file, 5, kept)) << how;
        ++count;
    });
    EXPECT_EQ(count, 9 * whole.size() + 5);
    write_bytes(file, whole);
    EXPECT_TRUE(read(file, 5, kept));
}

// Coordinates that change sign differ in the highest bits of words alone.
TEST(ContentHash, SignsDoNotCancelEachOther)
{
    std::vector<float> numbers;
    for (int i = 0; i < 64; ++i)
        numbers.push_back(float(i + 1));
    const auto value = [&] {
        ContentHash hash;
        hash.add(numbers.data(), numbers.size() * sizeof(float));
        return hash.value();
    };
    std::set<std::uint64_t> values{value()};
    std::size_t count = 1;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        for (std::size_t k = i; k < numbers.size(); ++k, ++count) {
            const std::vector<float> before = numbers;
            numbers[i] *= -1;
            if (k != i)
                numbers[k] *= -1;
            values.insert(value());
            numbers = before;
        }
    EXPECT_EQ(values.size(), count);
}

TEST(ContentHash, PartsHaveTheirEnds)
{
    const auto value = [](std::initializer_list<std::string> parts) {
        ContentHash hash;
        for (const std::string& part : parts)
            hash.add(part.data(), part.size());
        return hash.value();
    };
    const std::string zero(1, '\0');
    EXPECT_NE(value({"ab", "c"}), value({"a", "bc"}));
    EXPECT_NE(value({"ab"}), value({"ab" + zero}));
    EXPECT_NE(value({""}), value({}));
    EXPECT_NE(value({std::string(32, 'x'), "y"}), value({std::string(32, 'x') + "y"}));
}

// A row with a wrong bit, be it in its number, and those after it are computed again.
TEST(RowCache, ARowIsTheOneThatWasPutOrIsMissing)
{
    constexpr std::size_t bytes = 24;
    constexpr int rows = 5;
    const std::filesystem::path file = scratch("rows");
    const auto row = [](int number) {
        std::vector<std::byte> all;
        for (std::size_t i = 0; i < bytes; ++i)
            all.push_back(std::byte(16 * number + int(i)));
        return all;
    };
    {
        RowCache kept(file, "some picture", bytes, rows);
        for (const int number : {2, 0, 1})
            kept.put(number, row(number).data());
    }
    const std::string whole = read_text(file);
    EXPECT_EQ(RowCache(file, "some picture", bytes, rows).count(), 3);
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        {
            RowCache kept(file, "some picture", bytes, rows);
            EXPECT_TRUE(damaged.size() > whole.size() ? kept.count() == 3 : kept.count() < 3) << how;
            for (int number = 0; number < rows; ++number) {
                const std::byte* const found = kept.row(number);
                EXPECT_TRUE(!found || std::equal(found, found + bytes, row(number).data())) << how << ", row " << number;
                if (!found && number != 3)
                    kept.put(number, row(number).data());
            }
        }
        RowCache again(file, "some picture", bytes, rows);
        EXPECT_EQ(again.count(), 4) << how << ": the file takes the other rows";
    });
}

} // namespace
} // namespace kept_file_test
