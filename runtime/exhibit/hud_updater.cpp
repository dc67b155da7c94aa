#include "hud_updater.h"

namespace starbow {

const Panel* HudUpdater::update(const Session& session, const SceneFile& scene, double exposure_ev, int width)
{
    const Clock::time_point now = Clock::now();
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    ++frames_;
    if (const double passed = seconds(now - since_); passed > 0.5) {
        rate_ = frames_ / passed;
        frames_ = 0, since_ = now;
    }
    if (panel_.size.x != width || seconds(now - drawn_) > 0.1) {
        panel_ = typesetter.draw(readings_of(session, scene, exposure_ev), session.words, width);
        drawn_ = now;
    }
    const bool covers_pattern
        = session.alignment.pattern() != Pattern::none && session.alignment.says().empty() && !shows_pins(session);
    return session.flight.hud && !covers_pattern ? &panel_ : nullptr;
}

Readings HudUpdater::readings_of(const Session& session, const SceneFile& scene, double exposure_ev) const
{
    const Words& words = session.words;
    const InputCapabilities capabilities = session.hid.capabilities();
    Readings shown = readings(session.flight.ship, scene, session.flight.effects);
    shown.frames_per_s = rate_;
    shown.mode = session.flight.mode, shown.frozen = session.flight.frozen, shown.lever = session.flight.lever;
    if (session.guide) {
        shown.prompt = session.guide->prompt(words);
        shown.caption = session.guide->caption(words, capabilities);
    } else if (session.options.tutorial)
        shown.prompt = prompt(session.tutorial, capabilities, words);
    if (shows_pins(session))
        shown.caption = Caption{.text = session.pins};
    else if (!session.directions.caption.empty())
        shown.caption = Caption{.text = session.directions.caption, .flying = !session.guide || session.guide->flies()};
    if (shown.caption && !shown.caption->flying)
        shown.lever.reset();
    shown.exposure_ev = exposure_ev, shown.exposure_locked = session.exposure.locked;
    shown.notice = notice_of(session);
    return shown;
}

} // namespace starbow
