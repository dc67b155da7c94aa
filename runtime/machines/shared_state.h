#pragma once
#include "config/model/adjust.h"
#include "picture_state.h"
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace starbow {

/// The master's message about a frame: the state of its pictures, and the parts of the exhibit that change.
struct SharedState {
    std::string scene; ///< the scene's file, as the master's command line or a remote's names it
    std::string coming; ///< the scene that the master reads meanwhile, so that all read it at once; empty: none
    std::string layout; ///< the layout's file, as `scene`
    std::uint64_t layout_digest = 0; ///< of its files
    std::vector<TurnedNumber> turned{}; ///< the builder's changes that the layout's file lacks
    std::string language; ///< of the visitors' words
    std::string quality; ///< a quality file's name; empty: `level` counts
    std::int32_t level = -1; ///< of the governor's ladder; -1: none
    PictureState picture;
};

/// The most numbers of a builder's that a state has room for beside everything else.
constexpr std::size_t most_turned = 48;
/// A builder's changes of a layout for the other machines. Throws InputError where they are too many.
std::vector<TurnedNumber> turned_for_machines(const Layout& kept, const Layout& now);

/// The bytes of a state, the same on each machine: numbers as they are in memory, the lowest byte first. Of the
/// instruments' panel only the number is in them: the picture is a page's. Throws InputError where they are more than
/// most_state_bytes.
std::vector<std::uint8_t> bytes_of(const SharedState& shared);

/// The state of such bytes. Throws InputError for bytes that are none: cut off, too many, or with numbers that no state
/// has.
SharedState shared_state_of(std::span<const std::uint8_t> bytes);

/// A digest of such bytes.
std::uint64_t digest_of_state(std::span<const std::uint8_t> bytes);

} // namespace starbow
