#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "options/language.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/hud/lab_class.h"
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

/// Refuses outputs that would replace something else: a log that is read, and a CSV file that no class has written.
void check_outputs(const std::vector<std::string>& logs, const std::filesystem::path& page, const std::filesystem::path& csv)
{
    if (page.extension() != ".html")
        throw InputError("--out " + one_line(page.string()) + " does not end in .html; a name that does is right");
    for (const std::string& log : logs)
        for (const std::filesystem::path& out : {page, csv})
            if (same_file(log, out))
                throw InputError("--out " + one_line(page.string()) + " would replace " + one_line(log)
                    + ", which is read; another name is right");
    RegularFile there(csv);
    std::string begin(6, '\0');
    begin.resize(there.read(begin));
    if (std::error_code ignored; std::filesystem::exists(csv, ignored) && begin != "group,")
        throw InputError("--out " + one_line(page.string()) + " would replace " + one_line(csv.string())
            + ", which is not a class's file; another name is right");
}

int gather(const ClassOptions& options)
{
    const std::filesystem::path page = options.out, csv = std::filesystem::path(page).replace_extension(".csv");
    if (options.logs.size() > most_groups)
        throw InputError(std::to_string(options.logs.size()) + " logs are too many; at most " + std::to_string(most_groups)
            + " are right, which colours and marks tell apart");
    for (std::size_t i = 0; i < options.logs.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (same_file(options.logs[i], options.logs[j]))
                throw InputError(one_line(options.logs[i]) + " is given twice; each group's log once is right");
    const Words words = words_in(options.language);
    check_outputs(options.logs, page, csv);
    const std::vector<std::string> names = names_of(options.logs);
    LabClass all;
    Progress progress;
    for (std::size_t i = 0; i < options.logs.size(); ++i) {
        const std::string& log = options.logs[i];
        const std::string bytes = read_whole(log, most_lab_bytes, "a log that starbow run --log has written");
        add_group(all, names[i], bytes, log,
            [&](double part) { progress.show(log, (double(i) + part) / double(options.logs.size())); });
    }
    const std::string text = class_page(all, words);
    make_folder_of(page);
    write_whole(csv, all.csv);
    write_whole(page, text);
    long lines = 0;
    for (const LabGroup& group : all.groups)
        lines += group.lines;
    std::printf(
        "%zu groups, %ld lines: the page is %s, all lines are in %s\n", all.groups.size(), lines, page.c_str(), csv.c_str());
    return 0;
}

} // namespace

static void add_class(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<ClassOptions>();
    Subcommand* command = app.add_subcommand("class",
        "Gather several groups' logs of the laboratory into one page: every group's points beside the theory, and how far "
        "they are from it; and into one CSV file beside the page, with a column for the group.");
    command
        ->add_option(
            "logs", options->logs, "The groups' logs, which starbow run --log has written; a group is called as its file")
        ->required();
    command->add_option("--out", options->out, "The page to write; the CSV file has the same name with .csv at its end")
        ->capture_default_str();
    add_language(*command, options->language);
    command->footer(
        "Examples:\n  starbow class GROUP1.csv GROUP2.csv GROUP3.csv --out class.html\n  starbow class logs/*.csv "
        "--language de --out out/class.html");
    command->callback([options, &chosen] { chosen = [options] { return gather(*options); }; });
}

static const Registered class_command{16, add_class};

} // namespace starbow
