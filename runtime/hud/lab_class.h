#pragma once
#include "lab_plot.h"
#include <functional>

namespace starbow {

/// One group's log in a class's picture.
struct LabGroup {
    std::string name;
    long lines = 0; ///< of measurements
    std::array<std::vector<PlotPoint>, plot_names.size()> points; ///< of each plot
};

/// A class's logs: the groups, and all their lines as one CSV text (RFC 4180), whose first column is the group.
struct LabClass {
    std::vector<LabGroup> groups;
    std::string csv;
};

/// The most groups whose colours and marks differ.
constexpr std::size_t most_groups = 56;

/// The CSV's first line, without its end.
std::string class_header();

/// Adds a log's bytes as the next group. file: for messages. progress: gets the part of the bytes that is read, now and
/// then. Throws InputError as read_lab_lines does, and for a log without a line of measurements; the class is then as it
/// was.
void add_group(LabClass& all, const std::string& name, std::string_view bytes, const std::string& file,
    const std::function<void(double)>& progress = {});

/// A page (HTML with SVG) in the words' language: each plot with every group's points in a colour and a mark of its own, the
/// theory's curves, and a table of each group's mean deviation and its spread.
std::string class_page(const LabClass& all, const Words& words);

} // namespace starbow
