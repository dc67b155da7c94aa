#pragma once
#include "bus.h"
#include "shared_state.h"

namespace starbow {

// Whether a message can be one of this program's: each number within its range, each list no longer than it gets, each part
// suiting the others. All return a phrase about the first fault, such as "has the frame -1"; empty: there is none.

std::string fault_of(const StateMessage& state);
std::string fault_of(const ReadyMessage& ready);
std::string fault_of(const GoMessage& go);
std::string fault_of(const ConfigMessage& config);
std::string fault_of(const PageMessage& page);
std::string fault_of(const SharedState& shared);

} // namespace starbow
