#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "options/language.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/hud/challenge_sheet.h"
#include "runtime/operation/progress.h"
#include <cstdio>
#include <memory>

namespace starbow {
namespace {

struct ChallengeOptions {
    std::string name, log, sheet, language = "en";
    int hints = 0;
};

const Challenge& challenge_named(const std::string& name)
{
    std::string known;
    for (const Challenge& challenge : challenges()) {
        if (challenge.name == name)
            return challenge;
        known += (known.empty() ? "" : ", ") + std::string(challenge.name);
    }
    throw InputError("\"" + one_line(name) + "\" is not a challenge; there are: " + known);
}

/// Reads a log line by line, with the progress of a long one.
std::vector<LabLine> read_log(const std::string& file)
{
    const std::string bytes = read_whole(file, most_lab_bytes, "a log that starbow run --log has written");
    std::vector<LabLine> lines;
    Progress progress;
    for (const auto& [line, text] : lab_texts(bytes, file)) {
        lines.push_back(read_lab_line(text, file, line));
        if (line % 4096 == 0)
            progress.show(file, double(text.data() - bytes.data()) / double(bytes.size()));
    }
    return lines;
}

int show(const ChallengeOptions& options)
{
    const Words words = words_in(options.language);
    if (!options.sheet.empty()) {
        const std::filesystem::path file = options.sheet;
        make_folder_of(file);
        write_whole(file, challenge_sheet(words));
        std::printf("%s\n", file.c_str());
        return 0;
    }
    const Challenge* only = options.name.empty() ? nullptr : &challenge_named(options.name);
    if (options.log.empty()) {
        if (only)
            std::printf("%s", challenge_text(*only, options.hints, words).c_str());
        else
            for (const Challenge& challenge : challenges())
                std::printf("%-13s %s\n", challenge.name, words(challenge.ask).c_str());
        return 0;
    }
    const std::vector<LabLine> lines = read_log(options.log);
    for (const Challenge& challenge : challenges())
        if (!only || only == &challenge)
            std::printf("%-13s %s\n", challenge.name, said_of(challenge, challenge.look(lines), words).c_str());
    return 0;
}

} // namespace

static void add_challenges(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<ChallengeOptions>();
    Subcommand* command = app.add_subcommand("challenges",
        "The laboratory's open questions: list them, show one with as many hints as you like, or check a log for answers.");
    Option* name = command->add_option("name", options->name, "One question, by its name in the list [all]");
    Option* hints = command->add_option("--hints", options->hints, "Show this many of its hints, from 0 to 3")
                        ->check(whole_number(0, 3))
                        ->needs(name);
    Option* check
        = command->add_option("--check", options->log, "Look for answers in this log, which starbow run --log has written")
              ->excludes(hints);
    command->add_option("--sheet", options->sheet, "Write all questions into this HTML page, with hints to open")
        ->excludes(name)
        ->excludes(check);
    add_language(*command, options->language);
    command->footer(
        "Examples:\n  starbow challenges\n  starbow challenges slow-clock --hints 1\n  starbow challenges --check "
        "GROUP1.csv\n  starbow challenges --sheet out/questions.html --language de");
    command->callback([options, &chosen] { chosen = [options] { return show(*options); }; });
}

static const Registered challenges_command{16, add_challenges};

} // namespace starbow
