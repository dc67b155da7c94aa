#pragma once
// The rows of docs/lab.md's tables, and the theory of each by formulas that share no code with shaders/physics.
#include "config/model/angles.h"
#include "tests/support/files.h"
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace starbow::testing {

struct DocumentRow {
    std::vector<std::string> cells;
    const std::string& no() const { return cells[0]; }
};

/// The rows of the document's tables that begin with a letter and a number.
inline std::vector<DocumentRow> lab_rows_of_the_document()
{
    std::ifstream stream(source_dir() / "docs/lab.md");
    std::vector<DocumentRow> rows;
    for (std::string line; std::getline(stream, line);) {
        if (line.size() < 6 || line[0] != '|' || !std::isupper(line[2]) || !std::isdigit(line[3]))
            continue;
        DocumentRow row;
        std::stringstream cells(line.substr(1));
        for (std::string cell; std::getline(cells, cell, '|');) {
            const auto from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
            row.cells.push_back(from == cell.npos ? "" : cell.substr(from, to - from + 1));
        }
        if (row.cells.size() >= 5) // the legend has fewer cells
            rows.push_back(row);
    }
    return rows;
}

/// By school mathematics, from cosines and a speed.
inline double school_doppler(double beta, double theta_deg)
{
    return std::sqrt(1 - beta * beta) / (1 - beta * std::cos(theta_deg * degree));
}
inline double school_seen_deg(double beta, double theta_deg)
{
    const double c = std::cos(theta_deg * degree);
    return std::acos((c + beta) / (1 + beta * c)) / degree;
}

/// The theoretical value of each measurement.
inline std::map<std::string, double> lab_theory()
{
    const double b4 = std::sqrt(15.0) / 4, half = std::atan(10.0 / 31) / degree;
    // The ship is at (17.897.., 0, 31) 35.79.. s after the clock at x showed 0.
    const double past = 31 / std::sqrt(3.0), now = 2 * past;
    const auto reading = [&](double x) { return now - std::hypot(past - x, 31.0); };
    const auto world_deg = [&](double x) { return std::atan2(31.0, x - past) / degree; };
    const auto rest_reading = [](double x) { return 31 - std::hypot(x, 31.0); };
    const auto seen_at = [&](double x) { return school_seen_deg(0.5, world_deg(x)); };
    const double D60 = school_doppler(b4, 60), off = std::acos(std::cos(15 * degree) * std::cos(5 * degree)) / degree;
    const double way = ((4 + 0.25) / 2 - 1) / 0.5, angle = std::atan2(5, 31 - way);
    const double at_4 = 2 * std::atan(std::tan(angle / 2) / 4) / degree;
    return {{"A1", 2 * half}, {"A2", seen_at(-10) - seen_at(10)}, {"A3", world_deg(-10) - world_deg(10)}, {"A4", 90},
        {"A5", 120}, {"A6", 90}, {"D1", 4 + std::sqrt(15.0)}, {"D2", 0.25}, {"D3", 4 - std::sqrt(15.0)}, {"D4", 1},
        {"D5", std::acos((1 - 0.25) / b4) / degree}, {"D6", std::acos((1 - std::sqrt(0.75)) / 0.5) / degree},
        {"D7", std::sqrt(0.75)}, {"D8", 550 / std::sqrt(0.75)}, {"C1", rest_reading(-10)}, {"C2", rest_reading(5)},
        {"C3", reading(-10)}, {"C4", reading(-5)}, {"C5", reading(5)}, {"C6", reading(10)},
        {"C7", reading(10) - reading(-10)}, {"C8", reading(10) - reading(-10)}, {"C9", 0}, {"T1", now}, {"T2", 31},
        {"T3", 0}, {"T4", 31}, {"L1", 31 * (std::tan((seen_at(-10) - 90) * degree) + std::tan((90 - seen_at(10)) * degree))},
        {"L2", 20 * std::sqrt(0.75)}, {"L3", 20}, {"H1", D60 * D60 * D60}, {"H2", std::pow(4 + std::sqrt(15.0), 3)},
        {"H3", std::pow(school_doppler(b4, off), 3)}, {"S1", 1 + 0.5 * 31}, {"S2", 2 / (2 + 0.5 * 31)}, {"S3", at_4}};
}

} // namespace starbow::testing
