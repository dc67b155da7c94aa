#pragma once
#include "lab_plot.h"
#include "lab_readings.h"
#include <functional>

namespace starbow {

/// One group's log in a class's picture.
struct LabGroup {
    std::string name;
    long lines = 0; ///< of its file
    std::array<std::vector<PlotPoint>, plot_names.size()> points{}; ///< of each plot
    std::vector<StudentReading> readings{};
};

/// A class's logs and lists of readings: the groups, and all lines of the logs as one CSV text (RFC 4180), whose first
/// column is the group; empty without logs.
struct LabClass {
    std::vector<LabGroup> groups;
    std::string csv;
};

/// The CSV's first line, without its end.
std::string class_header();

/// Adds a log's bytes as the next group. file: for messages. progress: gets the part of the bytes that is read, now and
/// then. Throws InputError as read_lab_lines does, and for a log without a line of measurements; the class is then as it
/// was.
void add_group(LabClass& all, const std::string& name, std::string_view bytes, const std::string& file,
    const std::function<void(double)>& progress = {});

/// Adds a list of readings as the next group. Throws InputError as read_reading_list does, and for a list without a reading;
/// the class is then as it was.
void add_readings(LabClass& all, const std::string& name, std::string_view bytes, const std::string& file);

/// A page (HTML with SVG) in the words' language: the groups' readings with their statistics; then each plot of the logs
/// with every group's points in a colour and a mark of its own, the theory's curves, and a table of each group's mean
/// deviation and spread of what was seen.
std::string class_page(const LabClass& all, const Words& words);

} // namespace starbow
