#pragma once
#include "runtime/flight/menu.h"
#include "runtime/hud/caption.h"
#include "session.h"

namespace starbow {

/// The visitors' menu in the session's language: worlds, tours, what to show, how to fly, languages. Its commands are those
/// of a docent.
std::vector<MenuPage> menu_of(const Session& session);

/// The open menu's page as a caption, with the names of the controls at hand.
Caption caption_of(const MenuState& menu, std::span<const MenuPage> pages, const Words& words,
    const InputCapabilities& capabilities, bool with_one_button);

/// The choices of one-button flying as a caption, with the time that is left.
Caption caption_of(const Scan& scan, const OneButton& rules, const Words& words);

} // namespace starbow
