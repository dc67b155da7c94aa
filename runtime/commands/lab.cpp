#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "options/language.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/hud/lab_readings.h"
#include "runtime/hud/lab_sheet.h"
#include "runtime/images/pdf.h"
#include <cstdio>
#include <memory>

namespace starbow {
namespace {

struct LabOptions {
    std::string sheet, out = "out/sheet.html", readings, language = "en";
};

/// A group's numbers are not replaced by an empty list.
void check_new(const std::filesystem::path& list)
{
    if (list.extension() != ".csv")
        throw InputError("--readings " + one_line(list.string()) + " does not end in .csv; a name that does is right");
    if (std::error_code ignored; std::filesystem::exists(list, ignored))
        throw InputError("--readings " + one_line(list.string()) + " is there already; a new name is right");
}

/// text: of a list, or a page, of which a PDF file is made where the file's name ends so.
void write_file(const std::filesystem::path& file, const std::string& text)
{
    make_folder_of(file);
    if (file.extension() == ".pdf")
        write_pdf(file, text);
    else
        write_whole(file, text);
    std::printf("%s\n", file.c_str());
}

int write_papers(const LabOptions& options)
{
    if (options.sheet.empty() && options.readings.empty())
        throw InputError("neither --sheet nor --readings is given; one of them is right");
    const std::filesystem::path sheet = options.out;
    if (!options.sheet.empty() && sheet.extension() != ".pdf" && sheet.extension() != ".html")
        throw InputError("--out " + one_line(sheet.string()) + " ends in neither .html nor .pdf; one of them is right");
    const Words words = words_in(options.language);
    if (!options.readings.empty()) {
        check_new(options.readings);
        write_file(options.readings, reading_list(words));
    }
    if (!options.sheet.empty())
        write_file(sheet, lab_sheet(options.sheet == "teacher" ? SheetFor::teacher : SheetFor::student, words));
    return 0;
}

} // namespace

static void add_lab(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<LabOptions>();
    Subcommand* command = app.add_subcommand("lab",
        "The laboratory's papers: the worksheet for students, the same with the theory for their teacher, and an empty list "
        "of readings for a spreadsheet.");
    Option* sheet
        = command->add_option("--sheet", options->sheet, "Write the worksheet for a student or a teacher as a page to print")
              ->check(one_of({"student", "teacher"}));
    command->add_option("--out", options->out, "The worksheet's file: a page (.html), or a PDF file by weasyprint")
        ->capture_default_str()
        ->needs(sheet);
    command->add_option("--readings", options->readings,
        "Write an empty list of readings, with a line for each row of the worksheet; starbow class reads it when it is "
        "filled");
    add_language(*command, options->language);
    command->footer(
        "Examples:\n  starbow lab --sheet student --out out/sheet.html\n  starbow lab --sheet teacher --language "
        "de --out out/lehrer.pdf\n  starbow lab --readings GROUP1.csv");
    command->callback([options, &chosen] { chosen = [options] { return write_papers(*options); }; });
}

static const Registered lab_command{15, add_lab};

} // namespace starbow
