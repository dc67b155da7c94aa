#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// One line of a log of measurements as numbers, in the log's units: seconds, light-seconds, degrees.
struct LabLine {
    long line = 0; ///< its number in the file, from 1; the file's first line has the names
    std::vector<double> values; ///< by column; NaN where the cell is empty, and for the columns of text; of reading_of the
                                ///< LabQuantity

    /// The value in a column of this name; NaN where the cell is empty. An unknown name is a programming error and ends
    /// the program.
    double operator[](std::string_view column) const;
};

/// Reads a line of a log, without its end. file, line: for messages. Throws InputError "FILE:LINE: COLUMN: VALUE problem"
/// for cells that LabLog does not write: another number of cells, no numbers, numbers beyond their range. A line of an older
/// version ends before the columns of readings, which are then empty.
LabLine read_lab_line(std::string_view text, const std::string& file, long line);

/// The lines of a log's bytes without their ends, the first with the names left out, each with its number. Throws
/// InputError for bytes that begin otherwise than a log, with the first column that is wrong. A log of an older version has
/// no columns of readings.
std::vector<std::pair<long, std::string_view>> lab_texts(std::string_view bytes, const std::string& file);

/// Reads all bytes of a log. Throws InputError as the two above.
std::vector<LabLine> read_lab_lines(std::string_view bytes, const std::string& file);

/// The greatest log that is read: ten lines a second for three days.
constexpr std::size_t most_lab_bytes = std::size_t(2) << 30;

} // namespace starbow
