#pragma once
#include <filesystem>
#include <string>

namespace starbow {

/// Writes a page (HTML) as a PDF file for paper, by the program weasyprint: the whole file or nothing. Throws InputError,
/// one sentence, where it can't.
void write_pdf(const std::filesystem::path& file, const std::string& page);

} // namespace starbow
