#pragma once
#include "files.h"
#include <random>
#include <string>

namespace starbow::testing {

/// Calls check(damaged bytes, words for the message) with each damage of a file: every bit flipped, every shorter length and
/// some longer ones. Of a file of more than 20 kB without STARBOW_ALL_CASES: every bit and length of its first bytes, and a
/// sample of the others.
template <class Check> void for_each_damage(const std::string& whole, const Check& check)
{
    constexpr std::size_t first = 128, sample = 500;
    std::vector<std::size_t> bytes;
    std::mt19937 random(11);
    const bool every = all_cases() || whole.size() <= 20'000;
    for (std::size_t at = 0; at < (every ? whole.size() : first); ++at)
        bytes.push_back(at);
    for (std::size_t n = 0; !every && n < sample; ++n)
        bytes.push_back(first + random() % (whole.size() - first));
    for (const std::size_t at : bytes) {
        for (int bit = 0; bit < 8; ++bit)
            if (std::string damaged = whole; every || at < first || int(random() % 8) == bit) {
                damaged[at] ^= char(1 << bit);
                check(damaged, "bit " + std::to_string(bit) + " of byte " + std::to_string(at));
            }
        check(whole.substr(0, at), "its first " + std::to_string(at) + " bytes");
    }
    for (const std::string& more :
        {std::string(1, '\0'), std::string("0"), std::string(8, '\0'), std::string(5000, 'x'), whole})
        check(whole + more, std::to_string(more.size()) + " bytes more");
}

} // namespace starbow::testing
