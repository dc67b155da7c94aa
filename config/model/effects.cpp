#include "effects.h"
#include "config/json/reader.h"

namespace starbow {

EffectSet effects_named(std::string_view list)
{
    EffectSet on;
    if (list == "none")
        return on;
    std::vector<std::string_view> names;
    for (const EffectEntry& one : all_effects)
        names.push_back(one.name);
    for (std::size_t from = 0; from <= list.size();) {
        const std::size_t to = std::min(list.find(',', from), list.size());
        on.set(Effect(index_named(list.substr(from, to - from), names, "effect")));
        from = to + 1;
    }
    return on;
}

Comparison comparison_named(std::string_view name)
{
    return Comparison(index_named(name, {comparison_names.begin(), comparison_names.end()}, "comparison"));
}

} // namespace starbow
