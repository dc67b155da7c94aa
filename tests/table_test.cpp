// The table in tests/README.md, from which CMake takes each form's tests, names every test once and says what it buys.
#include "tests/support/files.h"
#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace table_test {
namespace {

using namespace starbow::testing;
namespace fs = std::filesystem;

struct Row {
    std::string form, buys;
};

std::multimap<std::string, Row> rows()
{
    static const std::regex row(R"(\| `([^`]+)` \| ([a-z]+) \| [0-9.]+ \| (.*) \|)");
    std::multimap<std::string, Row> all;
    std::istringstream text(read_text(source_dir() / "tests/README.md"));
    std::string line;
    while (std::getline(text, line)) {
        std::smatch cells;
        if (std::regex_match(line, cells, row))
            all.insert({cells[1], {cells[2], cells[3]}});
        else
            EXPECT_FALSE(line.starts_with("| `")) << "not a row of test, form, seconds and what it buys: " << line;
    }
    return all;
}

TEST(TableOfTests, NamesEveryTestOnceWithItsFormAndWhatItBuys)
{
    const fs::path tests = source_dir() / "tests";
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(tests))
        if (const std::string name = entry.path().filename().string(); name.ends_with("_test.cpp") || name.ends_with("_test.sh"))
            files.insert(fs::relative(entry.path(), tests).generic_string());
    ASSERT_GT(files.size(), 200u);
    const auto table = rows();
    for (const std::string& file : files)
        EXPECT_EQ(table.count(file), 1u) << file << " has not one row in tests/README.md";
    for (const auto& [file, row] : table) {
        EXPECT_TRUE(files.contains(file)) << file << ", in tests/README.md, does not exist";
        EXPECT_TRUE(row.form == "quick" || row.form == "sanitized" || row.form == "all") << file << ": " << row.form;
        EXPECT_GE(row.buys.size(), 15u) << file;
        EXPECT_FALSE(row.form == "sanitized" && (file.ends_with("_gpu_test.cpp") || file.ends_with(".sh"))) << file;
    }
}

} // namespace
} // namespace table_test
