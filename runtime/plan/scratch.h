#pragma once
#include <vector>

namespace starbow {

/// Reserves twice the room in a list that is filled anew in each frame, so that a flight soon allocates no more memory.
template <class T> void reserve_headroom(std::vector<T>& list)
{
    if (2 * list.capacity() < 3 * list.size())
        list.reserve(2 * list.size());
}

} // namespace starbow
