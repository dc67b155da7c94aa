#include "runtime/remote/tell.h"
#include "commands.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "input/command.h"
#include "options/command_line.h"
#include "runtime/remote/auth.h"
#include <cstdio>

namespace starbow {
namespace {

struct ParsedArguments {
    TellOptions options;
    std::string pin_file;
    std::vector<std::string> words;
};

/// The PIN with most rights in a file such as the exhibit's own.
std::string best_pin(const std::filesystem::path& file)
{
    const Pins pins = read_pins(file);
    for (std::size_t i = pins.size(); i-- > 0;)
        if (!pins[i].empty())
            return pins[i];
    return "";
}

int run_tell(ParsedArguments given)
{
    const bool asks = given.words == std::vector<std::string>{"status"};
    if (!asks)
        command_of(given.words); // a wrong word is the fault that the user can mend, before a PIN that is missing
    if (given.options.pin.empty()) {
        const std::filesystem::path file = !given.pin_file.empty() ? std::filesystem::path(given.pin_file)
            : site().empty()                                       ? "/etc/starbow/pins"
                                                                   : site() / "pins";
        given.options.pin = best_pin(file);
    }
    if (asks) {
        std::fputs(state_of_exhibit(given.options).c_str(), stdout);
        return 0;
    }
    tell(given.options, given.words);
    std::string line;
    for (const std::string& word : given.words)
        line += (line.empty() ? "" : " ") + word;
    std::printf("applied: %s\n", line.c_str());
    return 0;
}

std::string command_list()
{
    std::string list = "Commands:\n  status";
    for (const CommandRule& rule : command_rules())
        list += "\n  " + std::string(rule.name)
            + (rule.value == CommandValue::none          ? ""
                    : rule.value == CommandValue::on     ? " on|off"
                    : rule.value == CommandValue::number ? " NUMBER"
                    : rule.value == CommandValue::place  ? " NUMBER NUMBER"
                    : rule.value == CommandValue::name   ? " NAME"
                                                         : " TEXT");
    return list;
}

} // namespace

static void add_tell(Subcommand& app, std::function<int()>& chosen)
{
    Subcommand* command = app.add_subcommand("tell", "Give a running exhibit a command, or print its state.");
    command->footer(command_list()
        + "\n\nExamples:\n  starbow tell status\n  starbow tell pointer 30 20\n  starbow tell scene twins\n"
          "  starbow tell --host starbow.local --pin-file docent.pin caption \"Closed at six\"");
    static ParsedArguments given;
    command->add_option("COMMAND", given.words, "the command and its values, or status")->required()->expected(1, 3);
    command->add_option("--host", given.options.host, "the exhibit's machine; a name on its list")->capture_default_str();
    command->add_option("--port", given.options.port, "the port of \"remote\" in the exhibit's file")
        ->capture_default_str()
        ->check(whole_number(1, 65535));
    command->add_option(
        "--pin-file", given.pin_file, "a file of PINs; that of the role with most rights is used [/etc/starbow/pins]");
    command->add_option(
        "--pin", given.options.pin, "a PIN; other users of this machine can see it in the list of processes");
    command->add_option("--certificate", given.options.certificate, "the exhibit's certificate, where its page is https");
    command->add_option("--wait", given.options.wait_s, "seconds until the command must be applied")
        ->capture_default_str()
        ->check(whole_number(1, 3600));
    command->callback([&chosen] { chosen = [] { return run_tell(given); }; });
}

static const Registered tell_command{14, add_tell};

} // namespace starbow
