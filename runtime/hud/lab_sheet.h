#pragma once
#include "lab_rows.h"

namespace starbow {

/// The reader of a worksheet. A teacher's has the theory's values, their errors and the commands that print them.
enum class SheetFor { student, teacher };

/// The worksheet as a page (HTML) for paper or a screen, in the words' language.
std::string lab_sheet(SheetFor reader, const Words& words);

} // namespace starbow
