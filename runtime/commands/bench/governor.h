#pragma once
#include <string>

namespace starbow {

/// Frames of the avenue in flight, off-screen, under a load that doubles and halves every five seconds: how many are late
/// although the governor moves along the ladder, and how often it moves. frame_budget_ms 0: what the ladder's middle level
/// takes here, and a half more. Returns the exit status: 1 where more than one in a hundred is late by more than half a
/// frame.
int bench_governor(const std::string& ladder, double frame_budget_ms, int seconds);

} // namespace starbow
