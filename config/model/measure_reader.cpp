#include "measure_reader.h"

namespace starbow {

Measure read_measure(const Place& place)
{
    constexpr Range any_place{-1e15, 1e15};
    reject_unknown_members(place, {"quantity", "at", "relative_to", "over"});
    Measure measure;
    measure.quantity = chosen(member(place, "quantity"), measures);
    const auto at = find_member(place, "at"), relative_to = find_member(place, "relative_to");
    if (has_place(measure.quantity))
        measure.at = vec3(member(place, "at"), any_place);
    else if (at || relative_to)
        complain(at ? *at : *relative_to, "is a place too many: this is measured on the ship alone; none is right");
    if (relative_to)
        measure.relative_to = vec3(*relative_to, any_place);
    take(place, "over", measure.over, {0, 1e15, true});
    return measure;
}

} // namespace starbow
