// The worksheet: its rows are those of docs/lab.md, their theory is that of school formulas, and the pages in both languages
// have every row.
#include "config/json/csv.h"
#include "config/model/shipped.h"
#include "config/model/shot.h"
#include "runtime/hud/lab_readings.h"
#include "runtime/hud/lab_rows.h"
#include "runtime/hud/lab_sheet.h"
#include "tests/support/lab_theory.h"
#include <gtest/gtest.h>
#include <set>

namespace lab_rows_test {

using namespace starbow;
using namespace starbow::testing;

TEST(LabRows, AreThoseOfTheDocument)
{
    const std::vector<DocumentRow> document = lab_rows_of_the_document();
    ASSERT_EQ(lab_rows().size(), document.size());
    for (std::size_t i = 0; i < document.size(); ++i) {
        const LabRow& row = lab_rows()[i];
        const std::vector<std::string>& cells = document[i].cells;
        SCOPED_TRACE(row.no);
        EXPECT_EQ(row.no, cells[0]);
        const bool in_flight = row.points.empty();
        if (!in_flight) {
            EXPECT_EQ(row.shot, cells[1]);
            EXPECT_EQ(row.keys, cells[2]);
            EXPECT_EQ(row.points, cells[3]);
        }
        const std::size_t at = in_flight ? 2 : 4;
        EXPECT_EQ(words()(entry_of(row.of).says), cells[at]);
        // The document has fewer digits.
        EXPECT_NEAR(row.theory, std::stod(cells[at + 1]), 0.1 * row.error + 5e-4 * std::abs(row.theory));
        EXPECT_DOUBLE_EQ(row.error, std::stod(cells[at + 2]));
    }
}

TEST(LabRows, HaveTheTheoryOfSchoolFormulas)
{
    const std::map<std::string, double> theory = lab_theory();
    EXPECT_EQ(theory.size(), lab_rows().size());
    for (const LabRow& row : lab_rows()) {
        SCOPED_TRACE(row.no);
        ASSERT_TRUE(theory.contains(std::string(row.no)));
        const double right = theory.at(std::string(row.no));
        EXPECT_NEAR(row.theory, right, 1e-6 * std::abs(right)) << "seven figures";
    }
}

// The keys of a row, pressed in its shot, give the effects of its command.
TEST(LabRows, CommandsHaveTheEffectsOfTheKeys)
{
    for (const LabRow& row : lab_rows()) {
        Effects effects = load_shot(source_dir() / "config/shots" / (std::string(row.shot) + ".json")).effects;
        for (const char key : row.keys)
            effects.on.flip(Effect(key - '1'));
        // A ratio of lights compares stills that differ in the headlight effect alone.
        if (!row.keys.empty()) {
            EXPECT_EQ(effects_named(row.effects) & usual_effects, effects.on & usual_effects) << row.no;
        }
        EXPECT_EQ(row.keys.empty(), row.effects.empty()) << row.no;
    }
    EXPECT_EQ(still_command(lab_rows()[1], true),
        "starbow render --shot clocks-passing --by-eye --overlay protractor --measure \"-14.7deg,0deg; 16.8deg,0deg\" --out "
        "out/A2");
    EXPECT_EQ(still_command(lab_rows()[5], false),
        "starbow render --shot clocks-passing --effects none --measure \"0deg,0deg\" --out out/A6");
}

TEST(LabRows, TheTeachersSheetAloneHasTheTheory)
{
    for (const char* language : {"en", "de"}) {
        const std::string student = lab_sheet(SheetFor::student, words(language)),
                          teacher = lab_sheet(SheetFor::teacher, words(language));
        for (const LabRow& row : lab_rows()) {
            const std::string cell = "<td>" + std::string(row.no) + "</td>";
            EXPECT_NE(student.find(cell), student.npos) << row.no;
            EXPECT_NE(teacher.find(cell), teacher.npos) << row.no;
        }
        for (const char* theory : {"35.757", "35,757", "635.1", "635,1", "16.5", "16,5"})
            EXPECT_EQ(student.find(theory), student.npos) << theory;
        EXPECT_NE(teacher.find(words(language).number("35.757")), teacher.npos);
        EXPECT_NE(student.find("--by-eye"), student.npos);
        // The direction where D is 1 is found by a turn, which no single still has.
        EXPECT_EQ(student.find("out/D5<"), student.npos);
        EXPECT_NE(teacher.find("out/D5<"), teacher.npos);
        EXPECT_NE(student.find("out/D7<"), student.npos);
    }
}

// Every quantity has a name of its own in the log, and those of an instant are the first, which the entry numbers from 1.
TEST(LabRows, QuantitiesHaveNamesOfTheirOwn)
{
    std::set<std::string_view> names;
    bool instant = true;
    for (std::size_t i = 0; i < all_lab_quantities.size(); ++i) {
        EXPECT_EQ(std::size_t(all_lab_quantities[i].which), i);
        names.insert(all_lab_quantities[i].name);
        EXPECT_TRUE(instant || !all_lab_quantities[i].theory) << i;
        instant = all_lab_quantities[i].theory;
    }
    EXPECT_EQ(names.size(), all_lab_quantities.size());
}

TEST(LabRows, AnEmptyListIsReadAndHasNoReading)
{
    for (const char* language : {"en", "de"}) {
        const std::string list = reading_list(words(language));
        EXPECT_TRUE(is_reading_list(list));
        EXPECT_TRUE(read_reading_list(list, "x.csv").empty());
        EXPECT_EQ(std::size_t(std::ranges::count(list, '\n')), 1 + lab_rows().size());
    }
}

} // namespace lab_rows_test
