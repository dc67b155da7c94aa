#pragma once
#include "session.h"

namespace starbow {

/// Carries out a command that needs no device: it changes the session, or makes a request that the frame's flight follows.
/// Call it for each command of the frame, recorded or not, before the step. Throws InputError with the reason where the
/// command makes no sense now; then nothing has changed. scene, shot, tour, reset, layout and quality, which need the
/// device, belong to FrameLoop.
void apply_command(Session& session, const Command& command, Requests& requests);

/// True if the programme has an item of this number, the first one 1.
bool is_item(const std::optional<Programme>& programme, double number);

/// The content that a command leads to: scene, shot, tour, or reset to the exhibit's own. Throws InputError.
SessionContent content_after(const Session& session, const Command& command);

/// Shows the content from its start. visitors: false where nobody is there to fly, and to answer a tour's questions.
void begin_content(Session& session, SessionContent content, bool visitors = true);

/// Gives the builder's keys back for ten minutes, and says so.
void unlock_builders_keys(Session& session);

/// Another visitor's hands come: what the last ones have left tilted, open or held counts once it has reported again.
void forget_hands(Session& session);

/// Everything that a visitor can change, but for the content and the instruments, is as the exhibit's file says.
void forget_visitor(Session& session);

/// The same of all that a docent can change, but for the layout. Show content afterwards.
void forget_directions(Session& session);

} // namespace starbow
