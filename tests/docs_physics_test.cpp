// The pages of docs/physics, read from the repository itself: equations, citations and files that they name exist.
#include "tests/support/files.h"
#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace docs_physics_test {

using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

struct Page {
    std::string name, text;
};

/// The pages with equations.
const std::vector<std::string>& page_names()
{
    static const std::vector<std::string> names{"relativity.md", "light.md", "solar-system.md", "numerics.md"};
    return names;
}

std::vector<Page> pages()
{
    std::vector<Page> all;
    for (const std::string& name : page_names())
        all.push_back({name, read_text(source_dir() / "docs/physics" / name)});
    return all;
}

std::vector<std::string> all_of(const std::string& text, const std::regex& what)
{
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), what), end; at != end; ++at)
        found.push_back((*at)[1]);
    return found;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);)
        all.push_back(line);
    return all;
}

/// One sentence for each equation that has its number twice, that no row of a table names with a file and a test, and for
/// each number in brackets without an equation.
std::vector<std::string> wrong_equations(const std::vector<Page>& pages)
{
    static const std::regex tag(R"(\\tag\{([A-Z]\d+)\})"), citation(R"(\(([RLSN]\d+)\))"), file("`[a-z][\\w/.-]*/[\\w.-]+`"),
        test("`[A-Z]\\w+\\.[A-Z]\\w+`");
    std::vector<std::string> wrong;
    std::map<std::string, std::string> tagged;
    std::set<std::string> tested;
    for (const Page& page : pages) {
        for (const std::string& number : all_of(page.text, tag))
            if (!tagged.emplace(number, page.name).second)
                wrong.push_back(page.name + " has a second equation (" + number + ")");
        for (const std::string& line : lines_of(page.text))
            if (line.starts_with("| (") && std::regex_search(line, file) && std::regex_search(line, test))
                for (const std::string& number : all_of(line.substr(0, line.find('|', 1)), citation))
                    tested.insert(number);
    }
    for (const Page& page : pages)
        for (const std::string& number : all_of(page.text, citation))
            if (!tagged.contains(number))
                wrong.push_back(page.name + " names (" + number + "), which is no equation");
    for (const auto& [number, name] : tagged)
        if (!tested.contains(number))
            wrong.push_back(name + " has no row with a file and a test for (" + number + ")");
    return wrong;
}

/// One sentence for each work that a page cites and the list lacks, or the other way round. A page cites as [Rindler2006];
/// at its end such a name leads to the list's entry.
std::vector<std::string> wrong_citations(const std::vector<Page>& pages, const std::string& references)
{
    static const std::regex entry(R"#(<a id="(\w+)"></a>\*\*\w+\*\*)#"), bold(R"(</a>\*\*(\w+)\*\*)"),
        name(R"(\[([A-Z]\w*[12]\d{3})\])"), definition(R"((?:^|\n)\[([A-Z]\w*[12]\d{3})\]: )");
    std::vector<std::string> wrong;
    const auto small = [](std::string text) {
        std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        return text;
    };
    const std::vector<std::string> anchors = all_of(references, entry), keys = all_of(references, bold);
    std::set<std::string> listed, cited;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!listed.insert(keys[i]).second)
            wrong.push_back("references.md has " + keys[i] + " twice");
        if (i >= anchors.size() || anchors[i] != small(keys[i]))
            wrong.push_back("references.md: " + keys[i] + " lacks the anchor " + small(keys[i]));
    }
    for (const Page& page : pages) {
        std::set<std::string> defined;
        for (const std::string& key : all_of(page.text, definition)) {
            defined.insert(key);
            if (page.text.find("[" + key + "]: references.md#" + small(key) + "\n") == std::string::npos
                && page.text.find("[" + key + "]: physics/references.md#" + small(key) + "\n") == std::string::npos)
                wrong.push_back(page.name + ": [" + key + "] leads elsewhere");
        }
        std::set<std::string> used;
        for (const std::string& key : all_of(std::regex_replace(page.text, definition, "\n"), name))
            used.insert(key);
        for (const std::string& key : used) {
            if (!listed.contains(key))
                wrong.push_back(page.name + " cites [" + key + "], which references.md lacks");
            else if (!defined.contains(key))
                wrong.push_back(page.name + ": [" + key + "] leads nowhere");
        }
        for (const std::string& key : defined)
            if (!used.contains(key))
                wrong.push_back(page.name + " does not use [" + key + "]");
        cited.insert(used.begin(), used.end());
    }
    for (const std::string& key : listed)
        if (!cited.contains(key))
            wrong.push_back("no page cites [" + key + "]");
    return wrong;
}

/// One sentence for each file that a page names or links to and that does not exist. exists: of a path from the root.
std::vector<std::string> missing_files(const std::vector<Page>& pages, const std::function<bool(const std::string&)>& exists)
{
    static const std::regex named(R"(`((?:config|displays|docs|input|runtime|scenes|shaders|tests)/[\w/.-]+\.\w+)`)"),
        linked(R"(\]\(([^)#:]+)(?:#[^)]*)?\))");
    std::vector<std::string> wrong;
    for (const Page& page : pages) {
        for (const std::string& path : all_of(page.text, named))
            if (!exists(path))
                wrong.push_back(page.name + " names " + path + ", which does not exist");
        for (const std::string& path : all_of(page.text, linked))
            if (!exists((fs::path("docs/physics") / path).lexically_normal().generic_string()))
                wrong.push_back(page.name + " links to " + path + ", which does not exist");
    }
    return wrong;
}

std::string lines(const std::vector<std::string>& all)
{
    std::string text;
    for (const std::string& one : all)
        text += one + "\n";
    return text;
}

} // namespace

TEST(DocsPhysics, EveryEquationHasOneNumberAFileAndATest)
{
    const std::vector<Page> all = pages();
    for (const Page& page : all)
        EXPECT_NE(page.text.find("\\tag{"), std::string::npos) << page.name;
    EXPECT_EQ(lines(wrong_equations(all)), "");
}

TEST(DocsPhysics, EveryCitationHasAnEntryAndEveryEntryIsCited)
{
    std::vector<Page> all = pages();
    for (const auto& entry : fs::directory_iterator(source_dir() / "docs"))
        if (entry.path().extension() == ".md")
            all.push_back({entry.path().filename().string(), read_text(entry.path())});
    EXPECT_EQ(lines(wrong_citations(all, read_text(source_dir() / "docs/physics/references.md"))), "");
}

TEST(DocsPhysics, EveryNamedFileExists)
{
    std::vector<Page> all = pages();
    all.push_back({"README.md", read_text(source_dir() / "docs/physics/README.md")});
    const auto exists = [](const std::string& path) { return fs::is_regular_file(source_dir() / path); };
    EXPECT_EQ(lines(missing_files(all, exists)), "");
}

/// A page's first lines name the program's version, which CMakeLists.txt has.
TEST(DocsPhysics, EveryPageNamesTheVersion)
{
    const std::vector<std::string> version
        = all_of(read_text(source_dir() / "CMakeLists.txt"), std::regex(R"(project\(starbow VERSION ([\d.]+))"));
    ASSERT_EQ(version.size(), 1u);
    for (const Page& page : pages())
        EXPECT_LT(page.text.find("*Starbow " + version[0] + ". Conventions: "), 60u) << page.name;
}

TEST(DocsPhysics, PlantedFaultsAreFound)
{
    const std::string row = "| (R1) | `shaders/a.glsl` | | `Boost.VelocitiesAdd` |\n";
    EXPECT_EQ(lines(wrong_equations({{"a.md", "$$x \\tag{R1}$$ as in (R1)\n" + row}})), "");
    EXPECT_EQ(lines(wrong_equations({{"a.md", "\\tag{R1} \\tag{R1}\n" + row}})), "a.md has a second equation (R1)\n");
    EXPECT_EQ(lines(wrong_equations({{"a.md", "\\tag{R1} by (R3)\n" + row}})), "a.md names (R3), which is no equation\n");
    EXPECT_EQ(lines(wrong_equations({{"a.md", "\\tag{R1}\n| (R1) | `shaders/a.glsl` | | |\n"}})),
        "a.md has no row with a file and a test for (R1)\n");

    const std::string list = "- <a id=\"rindler2006\"></a>**Rindler2006**: W. Rindler\n";
    const std::string to = "[Rindler2006]: references.md#rindler2006\n";
    EXPECT_EQ(lines(wrong_citations({{"a.md", "so [Rindler2006]: yes\n" + to}}, list)), "");
    EXPECT_EQ(lines(wrong_citations({{"a.md", "so [Rindler2006]\n"}}, list)), "a.md: [Rindler2006] leads nowhere\n");
    EXPECT_EQ(lines(wrong_citations({{"a.md", "so [Rindler2006] [Kraus2000]\n" + to}}, list)),
        "a.md cites [Kraus2000], which references.md lacks\n");
    EXPECT_EQ(lines(wrong_citations({{"a.md", "so\n"}}, list)), "no page cites [Rindler2006]\n");

    const auto exists = [](const std::string& path) { return path == "shaders/a.glsl" || path == "docs/physics/a.svg"; };
    EXPECT_EQ(lines(missing_files({{"a.md", "`shaders/a.glsl` ![A](a.svg)\n"}}, exists)), "");
    EXPECT_EQ(lines(missing_files({{"a.md", "`shaders/b.glsl` [b](../b.md#part)\n"}}, exists)),
        "a.md names shaders/b.glsl, which does not exist\na.md links to ../b.md, which does not exist\n");
}

} // namespace docs_physics_test
