// A student writes a reading down with the keys of a keyboard, and sees the theory only then.
#include "runtime/hud/lab_entry.h"
#include "runtime/hud/lab_log.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace lab_entry_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

Measured at_a_clock()
{
    Measured m;
    m.aim.seen_nm = 635.085;
    m.aim.from_motion_rad = 1.5707963;
    m.aim.clock_s = 0.25;
    m.aim.light = 0.5;
    return m;
}

std::string all_of(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines)
        text += line + "\n";
    return text;
}

} // namespace

TEST(LabEntry, AsksForQuantityValueAndUncertaintyInTurn)
{
    LabEntry entry(at_a_clock());
    // Without marks there are four quantities.
    EXPECT_EQ(entry.lines(words()).size(), 5u);
    EXPECT_EQ(entry.lines(words())[1], "1   550 nm → / nm");
    EXPECT_EQ(entry.lines(words())[3], "3   clock / s");
    entry.type("9x0\n\b");
    EXPECT_EQ(entry.lines(words()).size(), 5u) << "no such quantity";
    entry.type("1");
    entry.type("63a2.4\b5");
    EXPECT_EQ(entry.lines(words())[1], "Type your reading, then Enter: 632.5_");
    entry.type("\n3,\n");
    const std::optional<WrittenReading> reading = entry.written();
    ASSERT_TRUE(reading);
    EXPECT_FALSE(entry.open());
    EXPECT_EQ(reading->of, LabQuantity::wavelength);
    EXPECT_EQ(reading->value, 632.5);
    EXPECT_EQ(reading->uncertainty, 3);
    EXPECT_EQ(reading->theory, 635.085);
    EXPECT_EQ(says_of(*reading, words()), "Reading 632.5 ± 3, theory 635.09: −0.9 uncertainties away");
    EXPECT_EQ(says_of(*reading, words("de")), "Ablesung 632,5 ± 3, Theorie 635,09: −0,9 Unsicherheiten entfernt");
    entry.type("5\n");
    EXPECT_EQ(entry.written()->uncertainty, 3) << "what is written stays";
}

TEST(LabEntry, TheTheoryIsHiddenUntilAllIsWritten)
{
    for (const char* language : {"en", "de"}) {
        LabEntry entry(at_a_clock());
        std::string seen;
        for (const char key : std::string("3-0.2\n0.1")) {
            seen += all_of(entry.lines(words(language)));
            entry.type(std::string(1, key));
        }
        for (const char* theory : {"635", "90", "0.25", "0,25"})
            EXPECT_EQ(seen.find(theory), seen.npos) << theory;
        EXPECT_FALSE(entry.written());
        entry.type("\n");
        ASSERT_TRUE(entry.written());
        EXPECT_EQ(entry.written()->value, -0.2);
        EXPECT_EQ(entry.written()->theory, 0.25);
    }
}

TEST(LabEntry, WrongNumbersAreAskedForAgainAndEscapeGivesUp)
{
    for (const char* wrong : {"\n", "-\n", "1.2.3\n", "--1\n", "1-\n"}) {
        LabEntry entry(at_a_clock());
        entry.type(std::string("2") + wrong);
        EXPECT_EQ(entry.lines(words()).back(), "A number such as 0.5 is needed; an uncertainty is above 0.") << wrong;
        entry.type("1.5\n");
        EXPECT_EQ(entry.lines(words()).size(), 2u) << wrong;
        for (const char* none : {"0\n", "-1\n"}) {
            entry.type(none);
            EXPECT_TRUE(entry.open()) << none;
            EXPECT_EQ(entry.lines(words()).size(), 3u) << none;
        }
        entry.type("\x1b\x31\n");
        EXPECT_FALSE(entry.open());
        EXPECT_FALSE(entry.written());
    }
}

TEST(LabEntry, OffersTheQuantitiesOfTheMarksToo)
{
    Measured m = at_a_clock();
    m.aim.clock_s.reset(), m.aim.from_motion_rad.reset();
    m.pair = PairReading{.angle_rad = 0.5, .apparent_s = 17.5, .clocks_s = -2};
    EXPECT_EQ(quantities_at(m),
        (std::vector{LabQuantity::wavelength, LabQuantity::marks_angle, LabQuantity::clock_difference, LabQuantity::length,
            LabQuantity::light}));
    LabEntry entry(m);
    entry.type("2"
               "30"
               "\n"
               "1"
               "\n");
    EXPECT_NEAR(entry.written()->theory, 28.6479, 1e-4);
}

} // namespace lab_entry_test
