#include "lab_sheet.h"
#include "config/markup/html.h"
#include "config/markup/svg.h"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace starbow {
namespace {

std::string head(SheetFor reader, const Words& words)
{
    std::string names = "<tr>";
    const auto add = [&](Key name) { names += "<th>" + escaped_html(words(name)) + "</th>"; };
    for (const Key name : {"lab.no"_key, "lab.start"_key, "lab.keys"_key, "lab.points"_key, "class.quantity"_key})
        add(name);
    if (reader == SheetFor::teacher)
        add("lab.theory"), add("lab.error");
    else
        add("lab.reading"), add("lab.uncertainty");
    return names + "</tr>\n";
}

std::string row_of(const LabRow& row, SheetFor reader, const Words& words)
{
    std::string html = "<tr>";
    const auto add = [&](const std::string& text) { html += "<td>" + escaped_html(text) + "</td>"; };
    add(std::string(row.no)), add(std::string(row.shot)), add(std::string(row.keys));
    add(row.points.empty() ? words(row.when) : std::string(row.points)), add(words(entry_of(row.of).says));
    if (reader == SheetFor::teacher) {
        const int decimals = 1 + std::max(0, int(std::ceil(-std::log10(row.error)))); // one more than the error's first
        const std::string theory = words.number(shortest(std::abs(row.theory), decimals));
        add((row.theory < 0 ? "−" : "") + theory), add(words.number(shortest(row.error, 4)));
    } else {
        html += "<td class=\"blank\"></td><td class=\"blank\"></td>";
    }
    html += "</tr>\n";
    if (const bool by_eye = reader == SheetFor::student; has_still(row, by_eye))
        html += "<tr class=\"still\"><td></td><td colspan=\"6\"><code>" + escaped_html(still_command(row, by_eye))
            + "</code></td></tr>\n";
    return html;
}

} // namespace

std::string lab_sheet(SheetFor reader, const Words& words)
{
    const std::string title = words(reader == SheetFor::teacher ? "lab.sheet_teacher"_key : "lab.sheet_student"_key);
    std::ostringstream out;
    out << page_begin(words.language, title,
        "table{width:100%;table-layout:fixed;font-size:.9em}th:nth-child(1){width:2.2em}th:nth-child(2){width:8em}"
        "th:nth-child(3){width:3.5em}th:nth-child(5){width:11em}th:nth-child(n+6){width:7.5em}td,th{text-align:left;padding:"
        "."
        "25rem .5rem}tr.still td{padding-top:0}"
        "tr:not(.still) td{border-bottom:none}code{font-size:.75em}.blank{border:1px solid #333!important;min-width:5em}"
        "section{margin-top:1.5rem}h2,tr:has(+.still){break-after:avoid}tr{break-inside:avoid}"
        "@page{margin:15mm}@media print{body{font-size:11px;margin:0;max-width:none}}")
        << "<h1>" << escaped_html(title) << "</h1>\n<p>" << escaped_html(words("lab.sheet_begin")) << "</p>\n<p>"
        << escaped_html(words(reader == SheetFor::teacher ? "lab.sheet_for_teacher"_key : "lab.sheet_for_student"_key))
        << "</p>\n";
    const LabSection* open = nullptr;
    for (const LabRow& row : lab_rows()) {
        const LabSection& section = section_of(row);
        if (&section != open) {
            out << (open ? "</table></section>\n" : "") << "<section><h2>" << escaped_html(words(section.says)) << "</h2>\n";
            if (reader == SheetFor::teacher)
                out << "<p>" << escaped_html(words(section.formula)) << "</p>\n";
            out << "<table>\n" << head(reader, words);
            open = &section;
        }
        out << row_of(row, reader, words);
    }
    out << "</table></section>\n</body></html>\n";
    return out.str();
}

} // namespace starbow
