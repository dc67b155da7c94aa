#pragma once
#include "lab_quantities.h"
#include "lab_table.h"
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// A reading of a log or a list.
struct StudentReading : ReadNumber {
    std::string of; ///< a row of the worksheet, such as A1, or a quantity's name in the log
    long line = 0; ///< of its file
};

/// The text of a reading's quantity: "A1: ○–◇ / deg".
std::string reading_label(const std::string& of, const Words& words);
/// The places of quantities in a table: those of the worksheet in its order, then those of the log.
std::size_t reading_order(const std::string& of);

/// The reading of a log's line; nullopt where it has none.
std::optional<StudentReading> reading_of(const LabLine& line);

/// True for bytes that begin as a group's list of readings does, and not as a log.
bool is_reading_list(std::string_view bytes);
/// The readings of a group's list: the columns no, quantity, reading and uncertainty, as reading_list makes them and as
/// spreadsheets save them, with commas, semicolons or tabs between the cells; with the two latter numbers may have a
/// decimal comma. Lines without a reading are left out, and a row of the worksheet may come several times. Throws
/// InputError "FILE:LINE: ..." for any other.
std::vector<StudentReading> read_reading_list(std::string_view bytes, const std::string& file);
/// An empty list of readings with a line for every row of the worksheet.
std::string reading_list(const Words& words);

/// The statistics of a series of readings, by the usual formulas of a first-year laboratory. The theory has no free number,
/// so there are as many degrees of freedom as readings.
struct ReadingStatistics {
    long count = 0;
    double mean = 0; ///< of reading minus theory
    double spread = 0; ///< standard deviation of one reading minus theory (of a sample); 0 for one
    double standard_error = 0; ///< spread over the root of the count; 0 for one
    double chi_square = 0; ///< sum of the squared deviations in uncertainties
    double probability = 1; ///< of a chi-square at least as large by chance alone
    std::vector<long> outliers; ///< lines of readings further than outlier_sigmas from the theory
};
constexpr double outlier_sigmas = 3;
ReadingStatistics statistics_of(std::span<const StudentReading> readings);

/// The probability that a sum of `degrees` squared standard normal numbers is at least chi_square: the regularized upper
/// incomplete gamma function Q(degrees/2, chi_square/2) [Abramowitz and Stegun, 26.4.4 and 26.4.5]. degrees: from 1.
double chi_square_probability(double chi_square, long degrees);

} // namespace starbow
