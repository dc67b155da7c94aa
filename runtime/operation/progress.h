#pragma once
#include <chrono>
#include <string>

namespace starbow {

/// Lines on standard error that show a person how far long work is, and about how long the rest may take. At a terminal one
/// line replaces itself, and is cleared with the object. Elsewhere work of more than two seconds has a line, and another one
/// each minute.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// part: the part of all the work that is done, 0 to 1. The first call's part is taken as done earlier, by a run that
    /// was interrupted. A call is left out that comes within a fifth of a second and less than a hundredth further.
    void show(const std::string& text, double part);
    void clear(); ///< the line at a terminal, before other words are printed there

private:
    using Clock = std::chrono::steady_clock;
    bool terminal_, shown_ = false;
    double first_part_ = -1, last_part_ = 0;
    Clock::time_point began_{}, last_{}, made_ = Clock::now();
};

/// "about 40 s left", in minutes from 90 seconds on.
std::string time_left(double seconds);

} // namespace starbow
