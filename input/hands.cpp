#include "hands.h"

namespace starbow {
namespace {

/// Nothing of a visitor's hands acts; the head is followed as always. taken: the docent has the stick, and the ship comes to
/// coasting.
void let_go(Controls& controls, bool taken)
{
    static_cast<Steering&>(controls) = {.lever = controls.lever, .taken = taken};
    const Head head = controls.head;
    static_cast<Looking&>(controls) = {};
    controls.head = head;
    static_cast<Switches&>(controls)
        = controls - switches_of(Presser::pilot) - switches_of(Presser::visitor) - switches_of(Presser::student);
}

} // namespace

constinit const std::array<Hands::Writer, 5> Hands::writers{{{"devices", &Hands::take_devices}, {"lock", &Hands::lock},
    {"hold", &Hands::hold}, {"calm", &Hands::calm}, {"requests", &Hands::request}}};

Controls Hands::advance(const HandsFrame& frame)
{
    Controls controls;
    for (const Writer& writer : std::span(writers).first(writers.size() - 1))
        (this->*writer.write)(controls, frame);
    return controls;
}

Controls Hands::finish(Controls controls, const Requests& requests)
{
    (this->*writers.back().write)(controls, {.requests = requests});
    return controls;
}

void Hands::unlock()
{
    constexpr std::int64_t ten_minutes_ns = 600'000'000'000;
    unlocked_ns_ = ten_minutes_ns;
}

void Hands::take_devices(Controls& controls, const HandsFrame& frame)
{
    controls = frame.devices;
    somebody_ = presence_.take(controls, 1e-9 * double(frame.dt_ns));
    if (rules_.laboratory)
        controls.set(Switch::slow_motion, false);
}

void Hands::lock(Controls& controls, const HandsFrame& frame)
{
    unlocked_ns_ = std::max<std::int64_t>(unlocked_ns_ - frame.dt_ns, 0);
    if (!rules_.locks || unlocked_ns_ > 0)
        return;
    static_cast<AlignmentSteps&>(controls) = {};
    static_cast<Switches&>(controls) = controls - switches_of(Presser::builder) - switches_of(Presser::student);
}

void Hands::hold(Controls& controls, const HandsFrame& frame)
{
    if (frame.held || !frame.in_hand)
        let_go(controls, frame.held);
    else if (frame.one_button)
        scan(controls, *frame.one_button, frame.dt_ns);
}

/// The steering of a visitor with one button, which is any but those of the window and of builders.
void Hands::scan(Controls& controls, const OneButtonPlace& place, std::int64_t dt_ns)
{
    const bool other = (controls & switches_of(Presser::builder)).any() || controls.choose != 0 || controls.turn_by != 0;
    const AnyButton button{.pressed = controls.pressed && !other, .held = controls.held};
    let_go(controls, false);
    controls.lever.reset();
    ScannedHands hands;
    switch (place.kind) {
    case OneButtonPlace::Kind::flight:
        hands = starbow::advance(scan_, rules_.one_button, button, dt_ns);
        break;
    case OneButtonPlace::Kind::list:
        hands = advance_in_menu(scan_, rules_.one_button, button, place.page, place.items, dt_ns);
        break;
    case OneButtonPlace::Kind::tour:
        scan_ = {};
        hands.set(Switch::home, button.pressed); // its next step
        break;
    }
    static_cast<Steering&>(controls) = hands;
    static_cast<Switches&>(controls) = (controls & switches_of(Presser::builder)) | hands;
}

void Hands::calm(Controls& controls, const HandsFrame& frame)
{
    if (rules_.calm)
        controls = calm_.let_through(controls, 1e-9 * double(frame.dt_ns), rules_.turns_by_steps);
}

void Hands::request(Controls& controls, const HandsFrame& frame) { controls = requested(controls, frame.requests); }

} // namespace starbow
