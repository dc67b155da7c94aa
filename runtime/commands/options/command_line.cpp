#include "command_line.h"
#include "config/json/error.h"
#include <CLI/CLI.hpp>
#include <charconv>

namespace starbow {
namespace {

/// Names joined for a sentence: "a, b and c are".
std::string there_are(const std::vector<std::string>& names)
{
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return list + (names.size() == 1 ? " is" : " are");
}

/// The first unknown option or command, with the known ones, or "". It is reported before a missing argument: most often
/// the unknown one is the missing one misspelt.
std::string unknown(const CLI::App& app)
{
    const std::vector<std::string> left = app.remaining();
    const std::vector<CLI::App*> taken = app.get_subcommands();
    if (left.empty())
        return taken.empty() ? "" : unknown(*taken.back());
    std::string whole_name = "starbow"; // the command's name with its parents'
    for (const CLI::App* at = &app; at->get_parent(); at = at->get_parent())
        whole_name.insert(7, " " + at->get_name());
    std::vector<std::string> names;
    if (left[0].starts_with("-")) {
        for (const CLI::Option* option : app.get_options())
            if (option->nonpositional())
                names.push_back("--" + option->get_lnames().at(0));
        return left[0] + " is not an option of '" + whole_name + "'; " + there_are(names);
    }
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return left[0]
        + (names.empty() ? " is one argument too many for '" + whole_name + "'" : " is not a command; " + there_are(names));
}

} // namespace

OptionRule whole_number(long low, long high)
{
    return [=](CLI::Option& option) {
        const std::string from = std::to_string(low), to = std::to_string(high);
        const auto problem = [=](const std::string& text) -> std::string {
            long value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool whole = error == std::errc() && end == text.data() + text.size();
            if (whole && value >= low && value <= high)
                return "";
            return text + " is not a whole number" + (whole ? " that fits" : "") + "; one from " + from + " to " + to
                + " is right";
        };
        option.check(problem, "from " + from + " to " + to);
    };
}

OptionRule number_between(double low, double high)
{
    return [=](CLI::Option& option) { option.check(CLI::Range(low, high)); };
}

OptionRule one_of(std::vector<std::string> choices)
{
    return [choices = std::move(choices)](CLI::Option& option) { option.check(CLI::IsMember(choices)); };
}

Option* Option::check(const OptionRule& rule) { return rule(*option_), this; }
Option* Option::needs(const Option* other) { return option_->needs(other->option_), this; }
Option* Option::excludes(const Option* other) { return option_->excludes(other->option_), this; }
Option* Option::excludes(const char* name) { return option_->excludes(name), this; }
Option* Option::required() { return option_->required(), this; }
Option* Option::expected(int least, int most) { return option_->expected(least, most), this; }
Option* Option::type_name(const char* name) { return option_->type_name(name), this; }
Option* Option::capture_default_str() { return option_->capture_default_str(), this; }
std::size_t Option::count() const { return option_->count(); }

Subcommand* Subcommand::add_subcommand(const std::string& name, const std::string& help)
{
    return &commands_.emplace_back(app_->add_subcommand(name, help));
}
void Subcommand::require_subcommand() { app_->require_subcommand(1); }
Option* Subcommand::add_option(const std::string& name, std::string& value, const std::string& help)
{
    return &options_.emplace_back(app_->add_option(name, value, help));
}
Option* Subcommand::add_option(const std::string& name, long& value, const std::string& help)
{
    return &options_.emplace_back(app_->add_option(name, value, help));
}
Option* Subcommand::add_option(const std::string& name, int& value, const std::string& help)
{
    return &options_.emplace_back(app_->add_option(name, value, help));
}
Option* Subcommand::add_option(const std::string& name, double& value, const std::string& help)
{
    return &options_.emplace_back(app_->add_option(name, value, help));
}
Option* Subcommand::add_option(const std::string& name, std::filesystem::path& value, const std::string& help)
{
    return &options_.emplace_back(app_->add_option(name, value, help));
}
Option* Subcommand::add_option(const std::string& name, std::vector<std::string>& values, const std::string& help)
{
    return &options_.emplace_back(app_->add_option(name, values, help));
}
Option* Subcommand::add_flag(const std::string& name, bool& value, const std::string& help)
{
    return &options_.emplace_back(app_->add_flag(name, value, help));
}
void Subcommand::pass_arguments_on()
{
    app_->prefix_command();
    app_->set_help_flag();
}
std::vector<std::string> Subcommand::passed_on() const { return app_->remaining(); }
void Subcommand::footer(const std::string& text) { app_->footer(text); }
void Subcommand::callback(std::function<void()> call) { app_->callback(std::move(call)); }
bool Subcommand::given_besides(const Option* option) const
{
    for (const Option& other : options_)
        if (&other != option && other.count() > 0)
            return true;
    return false;
}

void require_one_of(const std::string& names) { throw CLI::RequiredError(names); }

bool parse_command_line(int count, char** arguments, const std::string& version, const std::function<void(Subcommand&)>& add)
{
    CLI::App app("Starbow: fly near the speed of light and see what physics says you would see.");
    app.require_subcommand(1);
    app.set_version_flag("--version", version);
    app.footer("Examples:\n  starbow run --layout dome\n  starbow render --layout dome --shot avenue-gamma4 --out out/dome\n"
               "  starbow check my/wall.json --svg out/wall.svg\n  starbow COMMAND --help");
    Subcommand commands(&app);
    add(commands);
    try {
        app.parse(count, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app.exit(error); // prints the help, or the version
            return false;
        }
        const std::string what = unknown(app);
        throw InputError((what.empty() ? error.what() : what) + "; 'starbow --help' lists commands and options");
    }
    return true;
}

} // namespace starbow
