// The pages for readers: docs/README.md leads to every page, every link leads to a file and a heading that are there, and
// tables of members say what the readers of files do.
#include "config/model/schemas.h"
#include "input/keyboard.h"
#include "tests/support/files.h"
#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <regex>
#include <set>
#include <utility>

namespace docs_test {

using namespace starbow;
using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

/// The text of a page without its code: blocks between ``` and quotations between `.
std::string without_code(const std::string& page)
{
    std::istringstream text(page);
    std::string plain;
    bool code = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```"))
            code = !code;
        else if (!code)
            plain += line + "\n";
    }
    return plain;
}

/// The fragments by which a link reaches a place of a page: each id="...", and each heading as GitHub makes it: lower case,
/// spaces as hyphens, no other punctuation; of equal headings the second has -1 at its end.
std::set<std::string> fragments_of(const std::string& page)
{
    const std::string plain = without_code(page);
    static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))"), id("id=\"([^\"]+)\"");
    std::set<std::string> all;
    for (std::sregex_iterator at(plain.begin(), plain.end(), id), end; at != end; ++at)
        all.insert((*at)[1]);
    std::istringstream text(plain);
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with("#"))
            continue;
        const std::string heading = std::regex_replace(line.substr(line.find_first_not_of("# ")), link, "$1");
        std::string fragment;
        for (const char c : heading)
            if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || static_cast<unsigned char>(c) >= 128)
                fragment += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            else if (c == ' ')
                fragment += '-';
        std::string other = fragment;
        for (int n = 1; !all.insert(other).second; ++n)
            other = fragment + "-" + std::to_string(n);
    }
    return all;
}

/// The relative targets of a page's links and pictures, in Markdown and in HTML; formulas between $ have none.
std::vector<std::string> links_of(const std::string& page)
{
    // [text](target), and [name]: target at a line's beginning
    static const std::regex markdown(R"(\]\(([^)\s]+)\))"), definition(R"((?:^|\n)\[[^\]\n]+\]: (\S+))"),
        html("(href|src)=\"([^\"]+)\""), inline_code("`[^`\n]*`|\\$[^$\n]*\\$");
    const std::string plain = std::regex_replace(without_code(page), inline_code, "");
    std::vector<std::string> all;
    for (std::sregex_iterator at(plain.begin(), plain.end(), markdown), end; at != end; ++at)
        all.push_back((*at)[1]);
    for (std::sregex_iterator at(plain.begin(), plain.end(), definition), end; at != end; ++at)
        all.push_back((*at)[1]);
    for (std::sregex_iterator at(plain.begin(), plain.end(), html), end; at != end; ++at)
        all.push_back((*at)[2]);
    std::erase_if(all, [](const std::string& target) { return target.find("://") != target.npos; });
    return all;
}

/// One sentence for each link of a page that leads nowhere. read: the text of a file, relative to the repository's root, or
/// nothing if the repository does not have it. A folder's text is empty.
std::vector<std::string> broken_links(const std::string& page, const std::string& text,
    const std::function<std::optional<std::string>(const std::string&)>& read)
{
    std::vector<std::string> broken;
    for (const std::string& target : links_of(text)) {
        const std::size_t hash = std::min(target.find('#'), target.size());
        const std::string file
            = hash == 0 ? page : (fs::path(page).parent_path() / target.substr(0, hash)).lexically_normal().generic_string();
        const std::optional<std::string> other = read(file);
        if (!other)
            broken.push_back(page + " links " + target + ", which the repository does not have");
        else if (hash < target.size() && !fragments_of(*other).contains(target.substr(hash + 1)))
            broken.push_back(page + " links " + target + ", a heading that " + file + " does not have");
    }
    return broken;
}

std::optional<std::string> read_file(const std::string& file)
{
    const fs::path path = source_dir() / file;
    if (fs::is_directory(path))
        return "";
    if (!fs::is_regular_file(path))
        return std::nullopt;
    return read_text(path);
}

/// Every page below docs/, from the repository's root.
std::vector<std::string> pages()
{
    std::vector<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "docs"))
        if (entry.path().extension() == ".md")
            all.push_back(fs::relative(entry.path(), source_dir()).generic_string());
    std::sort(all.begin(), all.end());
    return all;
}

std::string lines(const std::vector<std::string>& all)
{
    std::string text;
    for (const std::string& one : all)
        text += one + "\n";
    return text;
}

} // namespace

TEST(Docs, TheIndexLeadsToEveryPage)
{
    std::set<std::string> linked{"docs/README.md"};
    for (const std::string& target : links_of(read_text(source_dir() / "docs/README.md")))
        linked.insert((fs::path("docs") / target.substr(0, target.find('#'))).lexically_normal().generic_string());
    ASSERT_GE(pages().size(), 15u);
    for (const std::string& page : pages())
        EXPECT_TRUE(linked.contains(page)) << "docs/README.md does not lead to " << page;
}

TEST(Docs, EveryLinkLeadsToAFileAndAHeading)
{
    std::vector<std::string> all = pages(), broken;
    all.insert(all.end(), {"README.md", "CONTRIBUTING.md"});
    int links = 0;
    for (const std::string& page : all) {
        const std::string text = read_text(source_dir() / page);
        links += static_cast<int>(links_of(text).size());
        for (const std::string& one : broken_links(page, text, read_file))
            broken.push_back(one);
    }
    EXPECT_GE(links, 150); // otherwise some were not found
    EXPECT_EQ(lines(broken), "");
}

/// The table of flying.md has every key of a switch in its third column, and sticks.md every role of a button.
TEST(Docs, EverySwitchStandsOnThePages)
{
    std::istringstream flying(read_text(source_dir() / "docs/flying.md"));
    std::set<std::string> documented;
    const std::regex row("\\|[^|]*\\|[^|]*\\|([^|]*)\\|[^|]*\\|"), key("[A-Za-z0-9]+");
    std::smatch cells;
    for (std::string line; std::getline(flying, line);)
        if (std::regex_match(line, cells, row)) {
            const std::string cell = cells[1];
            for (std::sregex_iterator at(cell.begin(), cell.end(), key), end; at != end; ++at)
                documented.insert(at->str());
        }
    const std::string sticks = read_text(source_dir() / "docs/sticks.md");
    for (const SwitchEntry& one : all_switches) {
        EXPECT_EQ(sticks.find("`" + dashed(one.name) + "`") != sticks.npos, button_switches[one.which]) << one.name;
        for (const int number : one.keys)
            EXPECT_TRUE(number == keys::none || one.by == Presser::builder || documented.contains(key_text(number)))
                << key_text(number) << ": " << one.help;
    }
}

/// Every member of every kind of file stands on some page: `name`, or as a part of `a.name`.
TEST(Docs, EveryMemberOfAFileStandsOnAPage)
{
    std::set<std::string> documented;
    const std::regex quoted("[`.\"]([A-Za-z_0-9]+)[`\"]");
    for (const std::string& page : pages()) {
        const std::string text = read_text(source_dir() / page);
        for (std::sregex_iterator at(text.begin(), text.end(), quoted), end; at != end; ++at)
            documented.insert((*at)[1]);
    }
    int members = 0;
    for (const std::string& kind : kinds_with_schema()) {
        const std::function<void(const nlohmann::json&)> look = [&](const nlohmann::json& at) {
            if (at.is_object() && at.contains("properties"))
                for (const auto& [name, shape] : at["properties"].items()) {
                    EXPECT_TRUE(name.starts_with("$") || documented.contains(name)) << kind << ": " << name;
                    ++members;
                }
            if (at.is_structured())
                for (const nlohmann::json& part : at)
                    look(part);
        };
        look(nlohmann::json::parse(schema_text(kind)));
    }
    EXPECT_GT(members, 300);
}

namespace {

/// An object of a schema, and the schema in which its references lead.
struct SchemaObject {
    std::shared_ptr<const nlohmann::json> schema;
    nlohmann::json object;
};

/// The shape behind references and lists; a default beside a reference stays.
nlohmann::json shape_of(const nlohmann::json& schema, nlohmann::json at)
{
    while (at.contains("$ref") || at.contains("items")) {
        nlohmann::json next = at.contains("$ref")
            ? schema.at(nlohmann::json::json_pointer(at["$ref"].get<std::string>().substr(1)))
            : at["items"];
        if (at.contains("default"))
            next["default"] = at["default"];
        at = std::move(next);
    }
    return at;
}

std::vector<SchemaObject> schema_objects()
{
    std::vector<SchemaObject> all;
    for (const std::string& kind : kinds_with_schema()) {
        const auto schema = std::make_shared<const nlohmann::json>(nlohmann::json::parse(schema_text(kind)));
        const std::function<void(const nlohmann::json&)> look = [&](const nlohmann::json& at) {
            if (at.is_object() && at.contains("properties"))
                all.push_back({schema, at});
            if (at.is_structured())
                for (const nlohmann::json& part : at)
                    look(part);
        };
        look(*schema);
    }
    return all;
}

std::vector<std::string> cells_of(const std::string& row)
{
    std::vector<std::string> cells;
    std::string cell;
    for (std::size_t i = 1; i < row.size(); ++i)
        if (row[i] == '|' && row[i - 1] != '\\')
            cells.push_back(std::exchange(cell, {}));
        else
            cell += row[i];
    return cells;
}

const std::string number_text = R"((?:-|−)?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?)";
double number_of(std::string text)
{
    text = std::regex_replace(text, std::regex("−"), "-");
    std::erase(text, ',');
    return std::stod(text);
}

/// True if a cell of the column "without it" says the schema's default.
bool says_default(const std::string& cell, const nlohmann::json& value)
{
    if (value == nlohmann::json({0., 0., 0.}) && cell.find("black") != cell.npos)
        return true;
    if (value == false && cell.find("none") != cell.npos)
        return true;
    if (value.is_number()) {
        const std::regex number(number_text);
        for (std::sregex_iterator at(cell.begin(), cell.end(), number), end; at != end; ++at)
            if (number_of(at->str()) == value.get<double>())
                return true;
        return false;
    }
    if (value.is_array()) {
        std::vector<double> said;
        const std::regex number(number_text);
        for (std::sregex_iterator at(cell.begin(), cell.end(), number), end; at != end; ++at)
            said.push_back(number_of(at->str()));
        return value == said;
    }
    return cell.find(value.is_string() ? value.get<std::string>() : value.dump()) != cell.npos;
}

/// Compares a table's row with the members that it names: their limits, whether they are needed, and their defaults.
void expect_row_of(const SchemaObject& from, const std::vector<std::string>& head, const std::vector<std::string>& row,
    const std::string& where)
{
    static const std::regex name("`([A-Za-z_.$0-9]+)`"), range("(" + number_text + ") to (" + number_text + ")");
    std::vector<std::string> names;
    for (std::sregex_iterator at(row[0].begin(), row[0].end(), name), end; at != end; ++at)
        names.push_back((*at)[1]);
    std::string prefix;
    for (std::string member : names) {
        if (const std::size_t dot = member.rfind('.'); dot != member.npos)
            prefix = member.substr(0, dot + 1);
        else if (!from.object["properties"].contains(member))
            member = prefix + member;
        nlohmann::json at = from.object, owner;
        std::string last;
        for (std::istringstream parts(member); std::getline(parts, last, '.');) {
            owner = shape_of(*from.schema, at);
            ASSERT_TRUE(owner.contains("properties") && owner["properties"].contains(last))
                << where << ": no member " << member;
            at = owner["properties"][last];
        }
        const nlohmann::json shape = shape_of(*from.schema, at);
        const std::string said = std::accumulate(row.begin() + 1, row.end(), std::string());
        if (names.size() == 1 && shape.contains("minimum") && shape.contains("maximum")) {
            bool any = false, right = false;
            for (std::sregex_iterator to(said.begin(), said.end(), range), end; to != end; ++to) {
                any = true;
                // A number of which 0 switches something off has the limits of the others on the page.
                right |= number_of((*to)[2]) == shape["maximum"]
                    && (number_of((*to)[1]) == shape["minimum"] || said.find("or 0") != said.npos);
            }
            EXPECT_TRUE(right || !any) << where << ": " << member << " is from " << shape["minimum"] << " to "
                                       << shape["maximum"];
        }
        if (head.back() != " without it " && head.back() != " if left out ")
            continue;
        const nlohmann::json needed = owner.value("required", nlohmann::json::array());
        const bool is_needed = std::find(needed.begin(), needed.end(), last) != needed.end();
        const std::string& without = row.back();
        if (names.size() == 1) {
            EXPECT_EQ(without == " must be there " || without == " needed ", is_needed) << where << ": " << member;
        }
        // Two words for a default that stands elsewhere in the file.
        if (shape.contains("default") && without != " the tour's ") {
            EXPECT_TRUE(says_default(without, shape["default"])) << where << ": " << member << " is " << shape["default"];
        }
    }
}

} // namespace

/// The pages' tables of members say the limits and the defaults that the descriptions have.
TEST(Docs, TablesOfMembersSayWhatTheReaderDoes)
{
    const std::vector<SchemaObject> objects = schema_objects();
    const std::regex member(R"(^ `([A-Za-z_$0-9]+))");
    int tables = 0, rows_read = 0;
    for (const std::string& page : pages()) {
        std::istringstream text(read_text(source_dir() / page));
        std::vector<std::string> head;
        std::vector<std::vector<std::string>> rows;
        const auto compare = [&] {
            const auto known = [&](const SchemaObject& object) {
                return std::ranges::count_if(rows, [&](const auto& row) {
                    std::smatch name;
                    return std::regex_search(row[0], name, member) && object.object["properties"].contains(name[1].str());
                });
            };
            const auto named
                = std::ranges::count_if(rows, [&](const auto& row) { return std::regex_search(row[0], member); });
            const auto best = std::ranges::max_element(objects, {}, known);
            if (named < 3 || known(*best) < named)
                return;
            ++tables;
            for (const auto& row : rows)
                if (std::regex_search(row[0], member))
                    ++rows_read, expect_row_of(*best, head, row, page);
        };
        for (std::string line; std::getline(text, line);)
            if (line.starts_with("| member"))
                head = cells_of(line), rows.clear();
            else if (line.starts_with("|") && !head.empty())
                rows.push_back(cells_of(line));
            else if (!head.empty())
                compare(), head.clear();
    }
    EXPECT_GE(tables, 10);
    EXPECT_GE(rows_read, 90);
}

/// Planted faults: the tests of links must find them.
TEST(Docs, PlantedFaultsAreFound)
{
    const auto read = [](const std::string& file) -> std::optional<std::string> {
        if (file == "docs/a.md")
            return "# A page: of *two* parts\n\n<a id=\"x1905\"></a>\n\n## Light\n\n```\n# no heading\n```\n\n## Light\n";
        return file == "docs/b.md" ? std::optional<std::string>("") : std::nullopt;
    };
    const auto broken = [&](const std::string& text) { return lines(broken_links("docs/a.md", text, read)); };
    EXPECT_EQ(broken("[b](b.md) ![b](../docs/b.md) [web](https://example.org/gone) <img src=\"b.md\">"), "");
    EXPECT_EQ(broken("[a](#a-page-of-two-parts) [l](a.md#light) [m](#light-1) [n](#x1905)\n[x]: a.md#light"), "");
    EXPECT_EQ(broken("`[c](c.md)`\n```\n[c](c.md)\n```\n"), "");
    EXPECT_EQ(broken("[c](c.md)"), "docs/a.md links c.md, which the repository does not have\n");
    EXPECT_EQ(broken("x\n[c]: c.md#d\n"), "docs/a.md links c.md#d, which the repository does not have\n");
    EXPECT_EQ(broken("<img src=\"c.png\">"), "docs/a.md links c.png, which the repository does not have\n");
    EXPECT_EQ(broken("[h](#no-heading)"), "docs/a.md links #no-heading, a heading that docs/a.md does not have\n");
    EXPECT_EQ(broken("[b](b.md#dark)"), "docs/a.md links b.md#dark, a heading that docs/b.md does not have\n");
}

} // namespace docs_test
