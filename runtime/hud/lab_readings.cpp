#include "lab_readings.h"
#include "config/json/csv.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "lab_rows.h"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace starbow {
namespace {

constexpr std::string_view list_columns[] = {"no", "quantity", "reading", "uncertainty"};
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; // spreadsheets write it

const LabRow* row_named(std::string_view no)
{
    const auto rows = lab_rows();
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const LabRow& row) { return row.no == no; });
    return found == rows.end() ? nullptr : &*found;
}

const LabQuantityEntry* quantity_named(std::string_view name)
{
    const auto found = std::find_if(
        all_lab_quantities.begin(), all_lab_quantities.end(), [&](const LabQuantityEntry& one) { return one.name == name; });
    return found == all_lab_quantities.end() ? nullptr : &*found;
}

/// The cells of a line (RFC 4180), whose quoted ones hold no line's end.
std::vector<std::string> cells_of(std::string_view line, char between)
{
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += c, ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (c == between && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    for (std::string& cell : cells) {
        const auto from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
        cell = from == cell.npos ? "" : cell.substr(from, to - from + 1);
    }
    return cells;
}

/// A line of a list, with what messages need.
struct ListLine {
    const std::string& file;
    long number;
    bool decimal_comma;
    std::vector<std::string> cells;

    [[noreturn]] void refuse(std::size_t column, const std::string& problem) const
    {
        throw InputError(one_line(file) + ":" + std::to_string(number) + ": " + std::string(list_columns[column]) + ": \""
            + one_line(cells[column], 60) + "\" " + problem);
    }
    double number_in(std::size_t column) const
    {
        std::string text = cells[column];
        if (decimal_comma)
            std::replace(text.begin(), text.end(), ',', '.');
        if (text.starts_with("−")) // a minus as people print it
            text.replace(0, std::string_view("−").size(), "-");
        double value = 0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !(std::abs(value) <= 1e12))
            refuse(column, "is not a number; a number such as 0.866 is right");
        return value;
    }
};

StudentReading read_list_line(const ListLine& line)
{
    const LabRow* row = row_named(line.cells[0]);
    if (!row)
        line.refuse(0, "is not a row of the worksheet; a number such as A1 is right");
    const double value = line.number_in(2), uncertainty = line.number_in(3);
    if (uncertainty < 1e-12)
        line.refuse(3, "is out of range; a number above 0 is right");
    return {{value, uncertainty, row->theory}, std::string(row->no), line.number};
}

std::string_view first_line(std::string_view bytes)
{
    if (bytes.starts_with(byte_order_mark))
        bytes.remove_prefix(byte_order_mark.size());
    return bytes.substr(0, bytes.find_first_of("\r\n"));
}

} // namespace

std::string reading_label(const std::string& of, const Words& words)
{
    if (const LabRow* row = row_named(of))
        return of + ": " + words(entry_of(row->of).says);
    const LabQuantityEntry* quantity = quantity_named(of);
    return quantity ? words(quantity->says) : of;
}

std::size_t reading_order(const std::string& of)
{
    if (const LabRow* row = row_named(of))
        return std::size_t(row - lab_rows().data());
    const LabQuantityEntry* quantity = quantity_named(of);
    return lab_rows().size() + (quantity ? std::size_t(quantity->which) : all_lab_quantities.size());
}

std::optional<StudentReading> reading_of(const LabLine& line)
{
    const double of = line["reading_of"];
    if (!std::isfinite(of))
        return {};
    return StudentReading{{line["reading"], line["reading_uncertainty"], line["reading_theory"]},
        std::string(all_lab_quantities[std::size_t(of)].name), line.line};
}

bool is_reading_list(std::string_view bytes)
{
    const std::string_view line = first_line(bytes);
    return line.starts_with(list_columns[0]) && line.size() > list_columns[0].size()
        && std::string_view(",;\t").find(line[list_columns[0].size()]) != std::string_view::npos;
}

std::vector<StudentReading> read_reading_list(std::string_view bytes, const std::string& file)
{
    const std::string_view head = first_line(bytes);
    const char between = head[list_columns[0].size()];
    const std::vector<std::string> names = cells_of(head, between);
    if (!std::equal(names.begin(), names.end(), std::begin(list_columns), std::end(list_columns)))
        throw InputError(one_line(file) + ":1: \"" + one_line(std::string(head), 60)
            + "\" are not the names of a list of readings; no,quantity,reading,uncertainty is right");
    bytes.remove_prefix(std::size_t(head.data() + head.size() - bytes.data()));
    std::vector<StudentReading> readings;
    long number = 1;
    for (std::size_t from = bytes.find('\n'); from != bytes.npos;) {
        const std::size_t begin = from + 1, end = std::min(bytes.find('\n', begin), bytes.size());
        std::string_view text = bytes.substr(begin, end - begin);
        from = end < bytes.size() ? end : bytes.npos;
        if (text.ends_with('\r'))
            text.remove_suffix(1);
        ListLine line{file, ++number, between != ',', cells_of(text, between)};
        if (text.empty() || (line.cells.size() > 2 && line.cells[2].empty()))
            continue;
        if (line.cells.size() != std::size(list_columns))
            throw InputError(one_line(file) + ":" + std::to_string(number) + ": \"" + one_line(std::string(text), 60)
                + "\" has " + std::to_string(line.cells.size()) + " cells; 4 are right: no, quantity, reading, uncertainty");
        readings.push_back(read_list_line(line));
    }
    return readings;
}

std::string reading_list(const Words& words)
{
    std::string list = "no,quantity,reading,uncertainty\r\n";
    for (const LabRow& row : lab_rows())
        list += std::string(row.no) + "," + csv_cell(words(entry_of(row.of).says)) + ",,\r\n";
    return list;
}

double chi_square_probability(double chi_square, long degrees)
{
    // Q(a + 1, y) = Q(a, y) + y^a e^-y / Gamma(a + 1), from Q(1/2, y) or Q(1, y): all terms are positive.
    const double y = 0.5 * chi_square;
    if (!(y > 0) || std::isinf(y))
        return y > 0 ? 0 : 1;
    double a = degrees % 2 ? 0.5 : 1, Q = degrees % 2 ? std::erfc(std::sqrt(y)) : std::exp(-y);
    for (; a < 0.5 * double(degrees) - 0.25; ++a)
        Q += std::exp(a * std::log(y) - y - std::lgamma(a + 1));
    return std::min(Q, 1.0);
}

ReadingStatistics statistics_of(std::span<const StudentReading> readings)
{
    ReadingStatistics all;
    double squares = 0; // Welford
    for (const StudentReading& reading : readings) {
        const double deviation = reading.value - reading.theory, off = deviation - all.mean;
        all.mean += off / double(++all.count);
        squares += off * (deviation - all.mean);
        all.chi_square += reading.sigmas() * reading.sigmas();
        if (std::abs(reading.sigmas()) > outlier_sigmas)
            all.outliers.push_back(reading.line);
    }
    if (all.count > 1) {
        all.spread = std::sqrt(squares / double(all.count - 1));
        all.standard_error = all.spread / std::sqrt(double(all.count));
    }
    if (all.count > 0)
        all.probability = chi_square_probability(all.chi_square, all.count);
    return all;
}

} // namespace starbow
