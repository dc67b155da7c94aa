#pragma once
#include <string>
#include <vector>

namespace starbow {

/// The rules of visits to an exhibit that nobody attends to.
struct Visiting {
    double idle_s = 90; ///< time without a touch after which the exhibit asks for the visitor
    double ask_s = 15; ///< time for which the question is shown; 0: none
    double longest_s = 0; ///< the length of the longest visit; 0: as long as somebody flies
    double fade_s = 1; ///< through black, from one state of the exhibit to the next
    std::string unlock{}; ///< typed on the keyboard, it gives a builder's keys back for a while; empty: nothing does
    std::vector<std::string> attract{}; ///< tours and records (.jsonl) that are shown in turn while nobody is there, paths
                                        ///< or names of shipped ones; none: the start of the exhibit's flight
};

} // namespace starbow
