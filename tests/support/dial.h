#pragma once
#include "shaders/shared_structs.h"
#include <string>

namespace starbow::testing {

/// Decodes a dial's figures from the bits of its entry.
inline std::string dial_text(const shared::TimeEntry& entry)
{
    std::string out;
    const int count = int(entry.digits.z);
    for (int k = 0; k < count; ++k) {
        if (k == count - 1)
            out += '.';
        const int figure = int(k < 6 ? entry.digits.x : entry.digits.y) >> 4 * (k % 6) & 15;
        out += figure == 10 ? '-' : char('0' + figure);
    }
    return out;
}

} // namespace starbow::testing
