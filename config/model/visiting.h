#pragma once
#include <string>
#include <vector>

namespace starbow {

/// The rules of visits to an exhibit that nobody attends to.
struct Visiting {
    double idle_s = 90; ///< after so long without a touch, a visitor is asked whether somebody is there
    double ask_s = 15; ///< how long the question is shown; 0: it is not asked
    double longest_s = 0; ///< the length of the longest visit; 0: as long as somebody flies
    double fade_s = 1; ///< through black, from one state of the exhibit to the next
    std::string unlock{}; ///< typed on the keyboard, it gives a builder's keys back for a while; empty: nothing does
    std::vector<std::string> attract{}; ///< tours that are shown in turn while nobody is there, paths or names of shipped
                                        ///< ones; none: the start of the exhibit's flight
};

} // namespace starbow
