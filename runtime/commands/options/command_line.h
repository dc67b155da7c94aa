#pragma once
#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}

namespace starbow {

/// The command line, without the header of the library that parses it: that one takes ten seconds in each file.
/// command_line.cpp alone includes it.

/// Limits an option's values; whole_number, number_between and one_of make rules.
using OptionRule = std::function<void(CLI::Option&)>;

/// Accepts only whole numbers from low to high.
OptionRule whole_number(long low, long high);
/// Accepts only numbers from low to high.
OptionRule number_between(double low, double high);
/// Accepts only these texts.
OptionRule one_of(std::vector<std::string> choices);

/// An option or an argument of a command. Each function but count returns the option itself.
class Option {
public:
    explicit Option(CLI::Option* option)
        : option_(option)
    {
    }
    Option* check(const OptionRule& rule);
    Option* needs(const Option* other);
    Option* excludes(const Option* other);
    Option* excludes(const char* name);
    Option* required();
    Option* expected(int least, int most); ///< the number of its values
    Option* type_name(const char* name); ///< the value's name in the help
    Option* capture_default_str(); ///< shows the variable's present value in the help
    std::size_t count() const; ///< how often it is given

private:
    CLI::Option* option_;
};

/// A subcommand. Its options and commands stay where they are. A name without dashes is an argument's.
class Subcommand {
public:
    explicit Subcommand(CLI::App* app)
        : app_(app)
    {
    }
    Subcommand* add_subcommand(const std::string& name, const std::string& help);
    void require_subcommand();
    Option* add_option(const std::string& name, std::string& value, const std::string& help);
    Option* add_option(const std::string& name, long& value, const std::string& help);
    Option* add_option(const std::string& name, int& value, const std::string& help);
    Option* add_option(const std::string& name, double& value, const std::string& help);
    Option* add_option(const std::string& name, std::filesystem::path& value, const std::string& help);
    Option* add_option(const std::string& name, std::vector<std::string>& values, const std::string& help);
    Option* add_flag(const std::string& name, bool& value, const std::string& help);
    void footer(const std::string& text);
    /// All that follows the command is left for another program.
    void pass_arguments_on();
    std::vector<std::string> passed_on() const;
    /// Calls after parsing, where the command is given.
    void callback(std::function<void()> call);
    /// True if an option other than this one is given.
    bool given_besides(const Option* option) const;

private:
    CLI::App* app_;
    std::deque<Option> options_;
    std::deque<Subcommand> commands_;
};

/// Ends parsing with "NAMES is required".
[[noreturn]] void require_one_of(const std::string& names);

/// Reads the program's arguments; `add` adds the subcommands. Returns true if one is given, and false after the help or the
/// version is printed. Throws InputError for arguments that are not right; it names those that are known.
bool parse_command_line(int count, char** arguments, const std::string& version, const std::function<void(Subcommand&)>& add);

} // namespace starbow
