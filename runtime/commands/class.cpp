#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "options/language.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/hud/lab_class_marks.h"
#include "runtime/hud/lab_class_readings.h"
#include "runtime/operation/progress.h"
#include <algorithm>
#include <cstdio>
#include <memory>

namespace starbow {
namespace {

struct ClassOptions {
    std::vector<std::string> logs;
    std::string out = "out/class.html", language = "en";
};

/// The groups' names: the files', without folder and end where these differ.
std::vector<std::string> names_of(const std::vector<std::string>& logs)
{
    std::vector<std::string> names;
    for (const std::string& log : logs)
        names.push_back(plain_text(std::filesystem::path(log).stem().string()));
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (std::filesystem::path(logs[i]).stem() == std::filesystem::path(logs[j]).stem())
                names[i] = plain_text(logs[i]), names[j] = plain_text(logs[j]);
    return names;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b)
{
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

struct ClassFiles {
    std::filesystem::path page, csv, readings;
};
ClassFiles files_of(const std::filesystem::path& page)
{
    std::filesystem::path readings = page;
    readings.replace_filename(page.stem().string() + "-readings.csv");
    return {page, std::filesystem::path(page).replace_extension(".csv"), readings};
}

/// Refuses outputs that would replace something else: a log that is read, and a CSV file that no class has written.
void check_outputs(const std::vector<std::string>& logs, const ClassFiles& files)
{
    const std::filesystem::path& page = files.page;
    if (page.extension() != ".html")
        throw InputError("--out " + one_line(page.string()) + " does not end in .html; a name that does is right");
    for (const std::string& log : logs)
        for (const std::filesystem::path& out : {page, files.csv, files.readings})
            if (same_file(log, out))
                throw InputError("--out " + one_line(page.string()) + " would replace " + one_line(log)
                    + ", which is read; another name is right");
    for (const std::filesystem::path& csv : {files.csv, files.readings}) {
        RegularFile there(csv);
        std::string begin(class_csv_begin.size(), '\0');
        begin.resize(there.read(begin));
        if (std::error_code ignored; std::filesystem::exists(csv, ignored) && begin != class_csv_begin)
            throw InputError("--out " + one_line(page.string()) + " would replace " + one_line(csv.string())
                + ", which is not a class's file; another name is right");
    }
}

int gather(const ClassOptions& options)
{
    const ClassFiles files = files_of(options.out);
    if (options.logs.size() > most_groups)
        throw InputError(std::to_string(options.logs.size()) + " logs are too many; at most " + std::to_string(most_groups)
            + " are right, which colours and marks tell apart");
    for (std::size_t i = 0; i < options.logs.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (same_file(options.logs[i], options.logs[j]))
                throw InputError(one_line(options.logs[i]) + " is given twice; each group's log once is right");
    const Words words = words_in(options.language);
    check_outputs(options.logs, files);
    const std::vector<std::string> names = names_of(options.logs);
    LabClass all;
    Progress progress;
    for (std::size_t i = 0; i < options.logs.size(); ++i) {
        const std::string& log = options.logs[i];
        const std::string bytes
            = read_whole(log, most_lab_bytes, "a log that starbow run --log has written, or a list of readings");
        if (is_reading_list(bytes))
            add_readings(all, names[i], bytes, log);
        else
            add_group(all, names[i], bytes, log,
                [&](double part) { progress.show(log, (double(i) + part) / double(options.logs.size())); });
    }
    const std::string text = class_page(all, words);
    make_folder_of(files.page);
    write_whole(files.page, text);
    long lines = 0;
    std::size_t readings = 0;
    for (const LabGroup& group : all.groups)
        lines += group.lines, readings += group.readings.size();
    std::printf("%zu groups, %ld lines: the page is %s", all.groups.size(), lines, files.page.c_str());
    if (!all.csv.empty()) {
        write_whole(files.csv, all.csv);
        std::printf(", all lines are in %s", files.csv.c_str());
    }
    if (readings > 0) {
        write_whole(files.readings, readings_csv(all.groups));
        std::printf(", %zu readings are in %s", readings, files.readings.c_str());
    }
    std::printf("\n");
    return 0;
}

} // namespace

static void add_class(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<ClassOptions>();
    Subcommand* command = app.add_subcommand("class",
        "Gather several groups' logs and lists of readings into one page: each group's readings with their statistics, and "
        "the logs' points beside the theory; and into CSV files beside the page, with a column for the group.");
    command
        ->add_option("logs", options->logs,
            "The groups' logs, which starbow run --log has written, or their lists of readings, of which starbow lab "
            "--readings writes an empty one; a group is called as its file")
        ->required();
    command
        ->add_option("--out", options->out,
            "The page to write; the CSV files have the same name with .csv and -readings.csv at its end")
        ->capture_default_str();
    add_language(*command, options->language);
    command->footer(
        "Examples:\n  starbow class GROUP1.csv GROUP2.csv GROUP3.csv --out class.html\n  starbow class logs/*.csv "
        "--language de --out out/class.html");
    command->callback([options, &chosen] { chosen = [options] { return gather(*options); }; });
}

static const Registered class_command{17, add_class};

} // namespace starbow
