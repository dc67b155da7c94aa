#pragma once
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// The displays of information, in the order of the key that steps through them. visitor: speed, two clocks and one plain
/// sentence, without a formula. guide: the same with the numbers that a guide speaks of. laboratory: every figure and
/// switch.
enum class Information { visitor, guide, laboratory };
constexpr std::array<std::string_view, 3> information_names{"visitor", "guide", "laboratory"};
inline const std::vector<std::pair<std::string_view, Information>> informations{{information_names[0], Information::visitor},
    {information_names[1], Information::guide}, {information_names[2], Information::laboratory}};
inline std::string_view name_of(Information information) { return information_names[std::size_t(information)]; }
/// Throws InputError for a name that no display has.
Information information_named(std::string_view name);
inline Information after(Information information) { return Information((int(information) + 1) % 3); }

} // namespace starbow
