#pragma once
#include "session.h"

namespace starbow {

/// Carries out a command that needs no device: it changes the session, or presses a switch of the frame's controls, which
/// the session then steps by. Call it for each command of the frame, recorded or not, before the step. Throws InputError
/// with the reason where the command makes no sense now; then nothing has changed. scene, shot, tour, reset, layout and
/// quality, which need the device, belong to FrameLoop.
void obey(Session& session, const Command& command, Controls& controls);

/// The programme that a command leads to: scene, shot, tour, or reset to the exhibit's own. Throws InputError.
Programme programme_after(const Session& session, const Command& command);

/// Begins a visit of a programme, at its start.
void begin_visit(Session& session, Programme programme);

/// Everything as the exhibit's file says, but for the programme and the layout.
void forget_directions(Session& session);

} // namespace starbow
