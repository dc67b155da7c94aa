#pragma once
#include <stdexcept>
#include <string>

namespace starbow {

/// An error that the user can mend: a wrong file or argument, a missing package. what() is the one line that the program
/// prints before it exits with 2: the place, the problem, and what would be right.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
    InputError(const std::string& file, const std::string& place, const std::string& problem)
        : std::runtime_error(file + (place.empty() ? "" : ": " + place) + ": " + problem)
    {
    }
};

} // namespace starbow
