// PINs, tokens and locks, with a clock of the test's own.
#include "runtime/remote/auth.h"
#include "tests/support/damage.h"
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sys/stat.h>

namespace auth_test {

using namespace starbow;
using namespace starbow::testing;
using namespace std::chrono_literals;

namespace {

const Pins pins{"111111", "222222", "333333"};
constexpr Logins::Time start = Logins::Time{} + 1000h;

std::filesystem::path pin_file(const std::string& text, mode_t mode = 0640)
{
    const std::filesystem::path file = write_text("pins", text);
    chmod(file.c_str(), mode);
    return file;
}

std::string token(Logins& logins, std::string_view pin, Logins::Time now = start)
{
    return logins.attempt({"10.0.0.1"}, pin, now).token;
}

} // namespace

TEST(Pins, AFileOfPinsIsRead)
{
    EXPECT_EQ(read_pins(pin_file("# of the site\nengineer 987654\n\n  docent\t000042 # the desk\n")),
        (Pins{"", "000042", "987654"}));
}

TEST(Pins, AFileThatOthersReadOrThatIsWrongIsRefusedAndNotShown)
{
    for (const mode_t mode : {0644, 0641, 0660, 0604, 0777, 0650})
        EXPECT_NE(complaint([&] { read_pins(pin_file("docent 123456\n", mode)); }).find("which opens it to more people"),
            std::string::npos)
            << mode;
    for (const mode_t mode : {0400, 0440, 0600, 0640})
        EXPECT_EQ(read_pins(pin_file("docent 123456\n", mode))[1], "123456") << mode;
    for (const char* text : {"docent 12345\n", "docent 1234567\n", "docent 12345x\n", "visitor 123456\n", "docent\n",
             "docent 123456 7\n", "123456\n", "docent 123456\ndocent 654321\n", "docent 123456\nlook 123456\n"}) {
        const std::string message = complaint([&] { read_pins(pin_file(text)); });
        EXPECT_TRUE(message.ends_with("is right")) << message;
        EXPECT_FALSE(std::regex_search(message.substr(message.find("pins")), std::regex("12345|654321"))) << message;
    }
    EXPECT_NE(complaint([] { read_pins(pin_file("# nobody\n")); }).find("has no PIN"), std::string::npos);
    EXPECT_NE(complaint([] { read_pins(scratch("no-such-pins")); }).find("does not exist"), std::string::npos);
    EXPECT_NE(complaint([] { read_pins("/tmp"); }).find("is a folder"), std::string::npos);
    EXPECT_NE(complaint([] { read_pins("/dev/zero"); }).find("is a device"), std::string::npos);
    mkfifo(scratch("pins-fifo").c_str(), 0600);
    EXPECT_NE(complaint([] { read_pins(scratch("pins-fifo")); }).find("is a FIFO"), std::string::npos);
    EXPECT_NE(complaint([] { read_pins(pin_file(std::string(100000, '#'))); }).find("is larger than 65536 bytes"),
        std::string::npos);
}

TEST(Pins, DrawnOnesHaveSixDigitsAndDiffer)
{
    std::set<std::string> all;
    for (int i = 0; i < 200; ++i) {
        const Pins drawn = draw_pins();
        for (const std::string& pin : drawn) {
            EXPECT_TRUE(std::regex_match(pin, std::regex("[0-9]{6}"))) << pin;
            all.insert(pin);
        }
        EXPECT_EQ(std::set<std::string>(drawn.begin(), drawn.end()).size(), 3u);
    }
    EXPECT_GT(all.size(), 590u); // of 600 draws among a million, 0.2 coincide on average
}

TEST(Logins, APinGivesItsRoleAndATokenOf128Bits)
{
    Logins logins(pins);
    std::set<std::string> tokens;
    for (std::size_t i = 0; i < pins.size(); ++i) {
        const Logins::Attempt attempt = logins.attempt({"10.0.0.1"}, pins[i], start);
        EXPECT_EQ(attempt.answer, Logins::Answer::right);
        EXPECT_EQ(attempt.role, Role(i));
        EXPECT_TRUE(std::regex_match(attempt.token, std::regex("[0-9a-f]{32}"))) << attempt.token;
        EXPECT_EQ(logins.role_of(attempt.token, start), Role(i));
        tokens.insert(attempt.token);
    }
    EXPECT_EQ(tokens.size(), 3u);
    for (const char* wrong : {"", "0", "00000000000000000000000000000000"})
        EXPECT_EQ(logins.role_of(wrong, start), std::nullopt);
    for (const std::string& one : tokens) {
        EXPECT_EQ(logins.role_of(one.substr(0, 31), start), std::nullopt);
        EXPECT_EQ(logins.role_of(one + "0", start), std::nullopt);
    }
}

TEST(Logins, ARoleWithoutAPinIsForNobody)
{
    Logins logins(Pins{"", "222222", ""});
    EXPECT_EQ(logins.attempt({"10.0.0.1"}, "", start).answer, Logins::Answer::wrong);
    EXPECT_EQ(logins.attempt({"10.0.0.1"}, "222222", start).answer, Logins::Answer::right);
}

TEST(Logins, FiveWrongPinsLockAnAddressForFiveMinutes)
{
    Logins logins(pins);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(logins.attempt({"10.0.0.1"}, "999999", start + i * 1s).answer, Logins::Answer::wrong);
    EXPECT_EQ(logins.attempt({"10.0.0.1"}, "111111", start + 10s).answer, Logins::Answer::right); // which forgives nothing
    const Logins::Attempt fifth = logins.attempt({"10.0.0.1"}, "999999", start + 20s);
    EXPECT_EQ(fifth.answer, Logins::Answer::locked);
    EXPECT_EQ(fifth.left, 300s);
    const Logins::Attempt right = logins.attempt({"10.0.0.1"}, "222222", start + 80s);
    EXPECT_EQ(right.answer, Logins::Answer::locked);
    EXPECT_EQ(right.left, 240s);
    EXPECT_EQ(right.token, "");
    EXPECT_EQ(logins.attempt({"10.0.0.2"}, "222222", start + 80s).answer, Logins::Answer::right);
    EXPECT_EQ(logins.attempt({"10.0.0.1"}, "222222", start + 319s).answer, Logins::Answer::locked);
    EXPECT_EQ(logins.attempt({"10.0.0.1"}, "222222", start + 321s).answer, Logins::Answer::right);
    // A docent who mistypes once a day is never locked out.
    for (int day = 1; day < 30; ++day)
        EXPECT_EQ(logins.attempt({"10.0.0.1"}, "222223", start + day * 24h).answer, Logins::Answer::wrong);
}

TEST(Logins, ManyAddressesGuessNoFasterThanSixteen)
{
    Logins logins(pins);
    int guesses = 0;
    for (int address = 0; address < 1000; ++address)
        for (int i = 0; i < 5; ++i) {
            const std::string from = "10.0." + std::to_string(address / 256) + "." + std::to_string(address % 256);
            guesses += logins.attempt({from}, "999999", start + 1s * i).answer == Logins::Answer::wrong;
        }
    EXPECT_EQ(guesses, 16 * 4); // the fifth wrong one of an address is answered by the lock
    EXPECT_EQ(logins.attempt({"10.9.9.9"}, "222222", start + 10s).answer, Logins::Answer::locked);
    EXPECT_EQ(logins.attempt({"10.9.9.9"}, "222222", start + 310s).answer, Logins::Answer::right);
}

/// A lock that begins again within a day is twice as long; after a day without one it is as at first.
TEST(Logins, EachLockIsLongerThanTheOneBefore)
{
    Logins logins(pins);
    Logins::Time now = start;
    const auto locked_s = [&] {
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(logins.attempt({"10.0.0.1"}, "999999", now).begins, Logins::Lock::none);
        const Logins::Attempt fifth = logins.attempt({"10.0.0.1"}, "999999", now);
        EXPECT_EQ(fifth.begins, Logins::Lock::address);
        EXPECT_EQ(fifth.left, fifth.length);
        EXPECT_EQ(logins.attempt({"10.0.0.1"}, "111111", now + fifth.length - 1s).answer, Logins::Answer::locked);
        EXPECT_EQ(logins.attempt({"10.0.0.1"}, "111111", now + fifth.length - 1s).begins, Logins::Lock::none);
        now += fifth.length;
        return fifth.length;
    };
    EXPECT_EQ(locked_s(), 300s);
    EXPECT_EQ(locked_s(), 600s);
    EXPECT_EQ(locked_s(), 1200s);
    for (int i = 0; i < 3; ++i)
        locked_s();
    EXPECT_EQ(locked_s(), 64 * 300s);
    EXPECT_EQ(locked_s(), 64 * 300s); // and no longer
    now += 25h;
    EXPECT_EQ(locked_s(), 300s);
}

/// Wrong PINs from many addresses lock out strangers, but not this machine, and not those that have logged in within a day.
TEST(Logins, ManyDoubtfulAddressesLockOutStrangersAlone)
{
    Logins logins(pins);
    EXPECT_EQ(logins.attempt({"10.0.9.1"}, "222222", start).answer, Logins::Answer::right);
    const auto attack = [&](Logins::Time now) {
        int begun = 0;
        for (int i = 0; i < 200; ++i) {
            const Logins::Attempt attempt = logins.attempt({"10.0.1." + std::to_string(i)}, "999999", now);
            EXPECT_EQ(attempt.answer, i < 16 ? Logins::Answer::wrong : Logins::Answer::locked) << i;
            EXPECT_EQ(attempt.begins, i == 15 ? Logins::Lock::strangers : Logins::Lock::none) << i;
            begun += attempt.begins == Logins::Lock::strangers;
        }
        return begun;
    };
    EXPECT_EQ(attack(start + 1h), 1);
    EXPECT_EQ(logins.attempt({"10.0.9.9"}, "222222", start + 1h).answer, Logins::Answer::locked);
    EXPECT_EQ(logins.attempt({"10.0.9.9"}, "222222", start + 1h).left, 300s);
    EXPECT_EQ(logins.attempt({"10.0.9.1"}, "222222", start + 1h).answer, Logins::Answer::right);
    EXPECT_EQ(logins.attempt({"127.0.0.1", true}, "333333", start + 1h).answer, Logins::Answer::right);
    EXPECT_EQ(logins.attempt({"192.168.7.20", true}, "333333", start + 1h).answer, Logins::Answer::right);
    EXPECT_EQ(logins.attempt({"127.0.0.2"}, "333333", start + 1h).answer, Logins::Answer::locked); // loopback is no password
    // The next round is longer, and a day later nobody is known any more.
    attack(start + 2h);
    EXPECT_EQ(logins.attempt({"10.0.9.9"}, "222222", start + 2h).left, 600s);
    EXPECT_EQ(logins.attempt({"10.0.9.1"}, "222222", start + 2h).answer, Logins::Answer::right);
    attack(start + 50h);
    EXPECT_EQ(logins.attempt({"10.0.9.1"}, "222222", start + 50h).answer, Logins::Answer::locked);
    // Who may log in while strangers are locked out may guess no more than others.
    int guesses = 0;
    for (int i = 0; i < 100; ++i)
        guesses += logins.attempt({"127.0.0.1", true}, "999999", start + 50h).answer == Logins::Answer::wrong;
    EXPECT_EQ(guesses, 4);
}

TEST(Logins, ATokenEndsTwelveHoursAfterItsLastUse)
{
    Logins logins(pins);
    const std::string one = token(logins, "222222");
    EXPECT_EQ(logins.role_of(one, start + 11h), Role::docent);
    EXPECT_EQ(logins.role_of(one, start + 22h), Role::docent);
    EXPECT_EQ(logins.role_of(one, start + 35h), std::nullopt);
    EXPECT_EQ(logins.role_of(one, start + 22h), Role::docent); // the clock of this test went back, and no use prolonged it
    logins.log_out(one);
    EXPECT_EQ(logins.role_of(one, start + 22h), std::nullopt);
}

TEST(Logins, TheNumberOfTokensIsBounded)
{
    Logins logins(pins);
    const std::string first = token(logins, "222222");
    for (int i = 0; i < 255; ++i)
        token(logins, "222222");
    EXPECT_EQ(logins.role_of(first, start), Role::docent);
    token(logins, "222222");
    EXPECT_EQ(logins.role_of(first, start), std::nullopt);
}

TEST(Logins, TokensOutlastARestartButNotAnotherPin)
{
    const std::filesystem::path file = scratch("state") / "logins";
    Logins before(pins);
    const std::string docent = token(before, "222222"), engineer = token(before, "333333");
    before.keep(file, start);
    struct stat about { };
    ASSERT_EQ(stat(file.c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777, 0600u);
    Logins after(Pins{"111111", "222222", "444444"});
    after.restore(file, start);
    EXPECT_EQ(after.role_of(docent, start), Role::docent);
    EXPECT_EQ(after.role_of(engineer, start), std::nullopt);
    EXPECT_EQ(after.role_of(docent, start + 13h), std::nullopt);
    // Damage, a file that others may read, no file: people log in again.
    for_each_damage(read_text(file), [&](const std::string& damaged, const std::string& how) {
        const std::filesystem::path wrong = write_text("logins-damaged", damaged);
        chmod(wrong.c_str(), 0600);
        Logins some(pins);
        some.restore(wrong, start);
        EXPECT_EQ(some.role_of(docent, start), std::nullopt) << how;
        EXPECT_EQ(some.role_of(engineer, start), std::nullopt) << how;
        EXPECT_EQ(some.role_of("", start), std::nullopt) << how;
    });
    chmod(file.c_str(), 0644);
    Logins open(pins);
    open.restore(file, start);
    open.restore(scratch("no-logins"), start);
    EXPECT_EQ(open.role_of(docent, start), std::nullopt);
}

TEST(Rate, TwentyASecondAndTwentyAtOnce)
{
    Rate rate(20);
    int taken = 0;
    for (int i = 0; i < 100; ++i)
        taken += rate.take(start);
    EXPECT_EQ(taken, 20);
    for (int ms = 1; ms <= 10000; ++ms)
        taken += rate.take(start + ms * 1ms);
    EXPECT_NEAR(taken, 220, 1);
    for (int i = 0; i < 100; ++i)
        taken += rate.take(start + 1h);
    EXPECT_NEAR(taken, 240, 1);
}

TEST(Secrets, AreComparedWhole)
{
    EXPECT_TRUE(same_secret("", ""));
    EXPECT_TRUE(same_secret("abc", "abc"));
    for (const char* other : {"", "ab", "abd", "bbc", "abcd"})
        EXPECT_FALSE(same_secret("abc", other)) << other;
}

} // namespace auth_test
