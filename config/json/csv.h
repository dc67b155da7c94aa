#pragma once
#include <string>
#include <string_view>

namespace starbow {

/// A cell of a CSV file (RFC 4180) with a text from elsewhere, such as a file's name. A text that a spreadsheet would take
/// for a formula and carry out begins with an apostrophe, as OWASP advises ("CSV Injection"); numbers of our own go in as
/// they are.
inline std::string csv_cell(std::string_view text)
{
    constexpr std::string_view formulas = "=+-@\t\r\n";
    std::string cell;
    if (!text.empty() && formulas.find(text.front()) != formulas.npos)
        cell = "'";
    cell += text;
    if (cell.find_first_of(",;\"\t\r\n") == cell.npos)
        return cell;
    std::string quoted = "\"";
    for (const char c : cell)
        quoted.append(c == '"' ? 2 : 1, c);
    return quoted + '"';
}

} // namespace starbow
