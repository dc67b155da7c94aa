#include "config/json/file_name.h"
#include "config/json/whole_file.h"
#include "describe_layout.h"
#include <charconv>
#include <cmath>
#include <sstream>

namespace starbow {
namespace {

constexpr std::size_t most_entries = 65536;

/// Throws about a line of a .cube file.
[[noreturn]] void complain_line(const std::filesystem::path& file, int line, const std::string& problem)
{
    throw InputError(one_line(file.string()) + (line > 0 ? ":" + std::to_string(line) : ""), "", problem);
}

/// The words of a line; a text in quotes is left as it is, since only titles have one.
std::vector<std::string_view> words(std::string_view line)
{
    std::vector<std::string_view> found;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
        found.push_back(line.substr(at, end - at));
        at = end;
    }
    return found;
}

std::optional<double> as_number(std::string_view word)
{
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        return {};
    return value;
}

/// Three numbers from the word at `first` on.
std::optional<glm::dvec3> as_colour(const std::vector<std::string_view>& line, std::size_t first)
{
    if (line.size() != first + 3)
        return {};
    const auto r = as_number(line[first]), g = as_number(line[first + 1]), b = as_number(line[first + 2]);
    if (!r || !g || !b)
        return {};
    return glm::dvec3(*r, *g, *b);
}

std::string in_quotes(const std::string& line) { return std::string("\"").append(one_line(line, 60)).append("\""); }

/// The fault of a table's entry, after the one before it; "" for a sound one.
std::string fault(const std::vector<glm::dvec3>& before, const glm::dvec3& entry)
{
    for (int channel = 0; channel < 3; ++channel) {
        if (!(entry[channel] >= 0 && entry[channel] <= 1))
            return "leaves the range of a screen's input; numbers from 0 to 1 are right";
        if (!before.empty() && entry[channel] < before.back()[channel])
            return "is darker in "
                + std::string(channel == 0 ? "red"
                        : channel == 1     ? "green"
                                           : "blue")
                + " than the entry before; a table that never falls is right";
    }
    return "";
}

/// A one-dimensional table in the .cube format (Adobe, Cube LUT specification 1.0, 2013).
std::vector<glm::dvec3> load_cube(const std::filesystem::path& file)
{
    std::istringstream in(read_whole(file, std::size_t(16) << 20, "a .cube file"));
    std::vector<glm::dvec3> table;
    std::size_t size = 0;
    int count = 0;
    for (std::string line; std::getline(in, line);) {
        ++count;
        const std::vector<std::string_view> word = words(line);
        if (word.empty() || word[0][0] == '#' || word[0] == "TITLE")
            continue;
        if (word[0] == "LUT_3D_SIZE")
            complain_line(file, count, in_quotes(line) + " begins a three-dimensional table; one with LUT_1D_SIZE is right");
        if (word[0] == "LUT_1D_SIZE") {
            const auto number = word.size() == 2 ? as_number(word[1]) : std::nullopt;
            if (!number || *number != std::floor(*number) || *number < 2 || *number > double(most_entries))
                complain_line(
                    file, count, in_quotes(line) + " is not a size; LUT_1D_SIZE and a number from 2 to 65536 are right");
            size = std::size_t(*number);
            continue;
        }
        if (word[0] == "DOMAIN_MIN" || word[0] == "DOMAIN_MAX") {
            const double bound = word[0] == "DOMAIN_MIN" ? 0 : 1;
            if (as_colour(word, 1) != glm::dvec3(bound))
                complain_line(file, count,
                    in_quotes(line)
                        + " is a range that this table can't have; DOMAIN_MIN 0 0 0 and DOMAIN_MAX 1 1 1 are right");
            continue;
        }
        const auto colour = as_colour(word, 0);
        if (!colour)
            complain_line(
                file, count, in_quotes(line) + " is not known here; three numbers, red, green and blue, are right");
        if (size == 0)
            complain_line(file, count, in_quotes(line) + " stands before the table's size; LUT_1D_SIZE before it is right");
        if (table.size() == size)
            complain_line(
                file, count, in_quotes(line) + " is one entry too many; " + std::to_string(size) + " entries are right");
        if (const std::string problem = fault(table, *colour); !problem.empty())
            complain_line(file, count, in_quotes(line) + " " + problem);
        table.push_back(*colour);
    }
    if (count == 0)
        complain_line(file, 0, "is empty; a .cube file with LUT_1D_SIZE is right");
    if (size == 0 || table.size() != size)
        complain_line(file, count,
            "has " + std::to_string(table.size()) + " entries; "
                + (size == 0 ? "LUT_1D_SIZE and as many entries" : "the " + std::to_string(size) + " of LUT_1D_SIZE")
                + " is right");
    return table;
}

} // namespace

std::filesystem::path existing_file(const Place& place, const std::filesystem::path& folder)
{
    const std::filesystem::path file = as_stored(folder / text(place));
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        fail_at(place, "is a folder; the path of a file, from the layout's folder on, is right");
    if (!std::filesystem::is_regular_file(file, error))
        fail_at(place,
            "names no file in " + (folder.empty() ? "this folder" : one_line(folder.string(), 200)) + nearest_names(file)
                + "; the path of a file, from the layout's folder on, is right");
    return file;
}

std::vector<glm::dvec3> Table::read(const Place& place, const Folder& folder) const
{
    if (place.json->is_string())
        return load_cube(existing_file(place, folder.path));
    if (!place.json->is_array())
        fail_at(place, "is not a table; the name of a .cube file or a list of numbers in [ ] is right");
    std::vector<glm::dvec3> table;
    for (const Place& at : items(place, 2, most_entries, "entries, numbers or [red, green, blue],")) {
        const glm::dvec3 entry = at.json->is_array() ? vec3(at, {0, 1}) : glm::dvec3(number(at, {0, 1}));
        if (const std::string problem = fault(table, entry); !problem.empty())
            fail_at(at, problem);
        table.push_back(entry);
    }
    return table;
}

Json Table::schema(Json& definitions) const
{
    const Json input = Number{{0, 1}}.schema(definitions);
    const Json entry{{"oneOf", {input, Numbers<3>{{0, 1}}.schema(definitions)}}};
    const Json list = described::list_schema(2, most_entries, entry);
    return {{"oneOf", {Text{}.schema(definitions), list}}, {"examples", {"left-projector.cube", {0, 0.5, 0.73, 0.88, 1}}}};
}

glm::dmat3 Matrix::read(const Place& place, const Folder&) const
{
    glm::dmat3 matrix;
    const std::vector<Place> rows = items(place, 3, 3, "rows of three numbers");
    for (int row = 0; row < 3; ++row) {
        const glm::dvec3 numbers = vec3(rows[std::size_t(row)], {-100, 100});
        for (int column = 0; column < 3; ++column)
            matrix[column][row] = numbers[column];
    }
    return matrix;
}

Json Matrix::written(const glm::dmat3& matrix) const
{
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row)
        rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row]});
    return rows;
}

Json Matrix::schema(Json& definitions) const
{
    return described::list_schema(3, 3, Numbers<3>{{-100, 100}}.schema(definitions));
}

void check_members(const Place& place, const Colour*)
{
    if (const auto gamma = find_member(place, "gamma"); gamma && find_member(place, "lut"))
        fail_at(*gamma, "stands beside \"lut\", which says the same; one of the two is right");
}

} // namespace starbow
