#include "lab_table.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "lab_log.h"
#include "overlay.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <unordered_map>

namespace starbow {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

enum class Kind { time, overlay, quantity, flag, number };
struct Column {
    std::string name;
    Kind kind = Kind::number;
    bool always = false; ///< never empty
    Range range{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
};

/// The first of the columns that logs of older versions lack.
constexpr std::string_view first_of_reading = "reading_of";

std::vector<std::string_view> split(std::string_view line)
{
    std::vector<std::string_view> cells;
    for (std::size_t from = 0; from <= line.size();) {
        const std::size_t to = std::min(line.find(',', from), line.size());
        cells.push_back(line.substr(from, to - from));
        from = to + 1;
    }
    return cells;
}

Column column_of(std::string_view name)
{
    Column column{std::string(name)};
    const auto ends = [&](std::string_view end) { return name.ends_with(end); };
    const bool of_ship = name.find("aim_") == name.npos && name.find("mark") == name.npos && !name.starts_with("reading");
    column.always = of_ship && !name.starts_with("doppler_1");
    if (name == "utc")
        column.kind = Kind::time;
    else if (name == "overlay")
        column.kind = Kind::overlay;
    else if (name == first_of_reading)
        column.kind = Kind::quantity;
    else if (ends("_on"))
        column.kind = Kind::flag;
    else if (ends("_deg"))
        column.range = {0, 180};
    else if (name == "gamma")
        column.range = {1, std::numeric_limits<double>::max()};
    else if (name == "beta" || name == "one_minus_beta")
        column.range = {0, 1};
    else if (ends("_doppler") || ends("_nm") || ends("_uncertainty"))
        column.range.low = 0, column.range.low_open = true;
    else if (ends("relative_gamma_beta") || ends("_number") || ends("_light") || (!of_ship && ends("_light_s")))
        column.range.low = 0;
    return column;
}

const std::vector<Column>& columns()
{
    static const std::vector<Column> all = [] {
        const std::string header = log_header();
        std::vector<Column> columns;
        for (const std::string_view name : split(header))
            columns.push_back(column_of(name));
        return columns;
    }();
    return all;
}

/// Columns of a log of an older version.
std::size_t older_columns()
{
    const auto first = std::find_if(
        columns().begin(), columns().end(), [](const Column& column) { return column.name == first_of_reading; });
    return std::size_t(first - columns().begin());
}

/// A quantity's place among all; refuses other names than a log's.
template <class Wrong> double read_quantity(std::string_view cell, const Wrong& wrong)
{
    if (cell.empty())
        return none;
    const auto found = std::find_if(all_lab_quantities.begin(), all_lab_quantities.end(),
        [&](const LabQuantityEntry& one) { return one.theory && one.name == cell; });
    if (found == all_lab_quantities.end())
        wrong("is not a quantity; wavelength_nm, angle_deg or another that starbow run --log writes is right");
    return double(found - all_lab_quantities.begin());
}

bool is_time(std::string_view text)
{
    constexpr std::string_view form = "0000-00-00T00:00:00.000Z";
    return text.size() == form.size() && std::equal(text.begin(), text.end(), form.begin(), [](char c, char like) {
        return like == '0' ? c >= '0' && c <= '9' : c == like;
    });
}

[[noreturn]] void refuse(const std::string& file, long line, const std::string& rest)
{
    throw InputError(one_line(file) + ":" + std::to_string(line) + ": " + rest);
}

[[noreturn]] void refuse(
    const std::string& file, long line, const Column& column, std::string_view cell, const std::string& problem)
{
    refuse(file, line, column.name + ": \"" + one_line(std::string(cell), 60) + "\" " + problem);
}

double read_cell(std::string_view cell, const Column& column, const std::string& file, long line)
{
    const auto wrong = [&](const std::string& problem) { refuse(file, line, column, cell, problem); };
    switch (column.kind) {
    case Kind::time:
        if (!is_time(cell))
            wrong("is not a time; one such as 2026-11-25T08:30:00.000Z is right");
        return none;
    case Kind::overlay:
        if (std::find(overlay_names.begin(), overlay_names.end(), cell) == overlay_names.end())
            wrong("is not an overlay; off, aim, grid, ring, distance or another that starbow run --log writes is right");
        return none;
    case Kind::quantity:
        return read_quantity(cell, wrong);
    case Kind::flag:
        if (cell != "0" && cell != "1")
            wrong("is not a switch; 0 or 1 is right");
        return cell == "1";
    case Kind::number:
        break;
    }
    const char* right
        = column.always ? "; a number such as 0.866 is right" : "; a number such as 0.866, or nothing, is right";
    if (cell.empty() && !column.always)
        return none;
    double value = 0;
    const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (read.ec != std::errc() || read.ptr != cell.data() + cell.size() || !std::isfinite(value))
        wrong(std::string("is not a number") + right);
    const auto [low, high, low_open] = column.range;
    if (value < low || value > high || (low_open && value == low))
        wrong("is out of range; a number "
            + (high < std::numeric_limits<double>::max() ? "from " + shown(low) + " to " + shown(high)
                                                         : (low_open ? "above " : "of at least ") + shown(low))
            + " is right");
    return value;
}

} // namespace

double LabLine::operator[](std::string_view column) const
{
    static const std::unordered_map<std::string_view, std::size_t> places = [] {
        std::unordered_map<std::string_view, std::size_t> all;
        for (std::size_t i = 0; i < columns().size(); ++i)
            all.emplace(columns()[i].name, i);
        return all;
    }();
    const auto found = places.find(column);
    if (found == places.end()) {
        std::fprintf(stderr, "starbow: the log has no column %s\n", std::string(column).c_str());
        std::abort();
    }
    return values[found->second];
}

LabLine read_lab_line(std::string_view text, const std::string& file, long line)
{
    const std::vector<std::string_view> cells = split(text);
    const std::size_t older = older_columns();
    if (cells.size() != columns().size() && cells.size() != older)
        refuse(file, line,
            "\"" + one_line(std::string(text), 60) + "\" has " + std::to_string(cells.size())
                + " cells; a line as starbow run --log writes it, with " + std::to_string(columns().size())
                + " cells and commas between them, is right");
    LabLine read{.line = line};
    read.values.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
        read.values.push_back(read_cell(cells[i], columns()[i], file, line));
    read.values.resize(columns().size(), none);
    for (std::size_t i = older + 1; i < columns().size(); ++i)
        if (std::isfinite(read.values[older]) != std::isfinite(read.values[i]))
            refuse(file, line,
                columns()[i].name
                    + ": a reading has all of its five cells, or none; a line as starbow run --log writes it "
                      "is right");
    return read;
}

std::vector<std::pair<long, std::string_view>> lab_texts(std::string_view bytes, const std::string& file)
{
    if (bytes.empty())
        throw InputError(one_line(file) + " is empty; a log that starbow run --log has written is right");
    std::vector<std::pair<long, std::string_view>> texts;
    long line = 0;
    for (std::size_t from = 0; from < bytes.size();) {
        const std::size_t to = std::min(bytes.find('\n', from), bytes.size());
        std::string_view text = bytes.substr(from, to - from);
        if (text.ends_with('\r'))
            text.remove_suffix(1);
        texts.emplace_back(++line, text);
        from = to + 1;
    }
    const std::vector<std::string_view> names = split(texts.front().second);
    const std::size_t right = names.size() == older_columns() ? names.size() : columns().size();
    for (std::size_t i = 0; i < std::max(names.size(), right); ++i) {
        const std::string_view name = i < names.size() ? names[i] : std::string_view();
        if (i >= columns().size())
            refuse(file, 1,
                "column " + std::to_string(i + 1) + ": \"" + one_line(std::string(name), 60)
                    + "\" is one column too many; the names that starbow run --log writes are right");
        if (name != columns()[i].name)
            refuse(file, 1,
                "column " + std::to_string(i + 1) + ": \"" + one_line(std::string(name), 60)
                    + "\" is not what a log has there; \"" + columns()[i].name
                    + "\" is right, as starbow run --log writes it");
    }
    texts.erase(texts.begin());
    return texts;
}

std::vector<LabLine> read_lab_lines(std::string_view bytes, const std::string& file)
{
    std::vector<LabLine> lines;
    for (const auto& [line, text] : lab_texts(bytes, file))
        lines.push_back(read_lab_line(text, file, line));
    return lines;
}

} // namespace starbow
