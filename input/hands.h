#pragma once
#include "calm.h"
#include "presence.h"
#include "requests.h"
#include "scan.h"
#include <array>
#include <string_view>

namespace starbow {

/// The choices that one-button flying shows in turn where it is used.
struct OneButtonPlace {
    enum class Kind : std::uint8_t { flight, list, tour } kind = Kind::flight;
    std::size_t page = 0, items = 0; ///< of a list: a menu's page, or a question's answers
};

/// An exhibit's rules of the hands.
struct HandsRules {
    bool locks = false; ///< a builder's and a student's switches, as visitors press every key there is
    bool laboratory = false; ///< its seconds are the ship's: there is no slow motion
    bool calm = false;
    bool turns_by_steps = false; ///< the ship does
    OneButton one_button{};
};

/// Everything that decides about a frame's controls.
struct HandsFrame {
    Controls devices{}; ///< as keyboard, sticks and head tracker give them
    std::int64_t dt_ns = 0;
    bool in_hand = true; ///< a visitor's controls have an effect
    bool held = false; ///< a docent holds the exhibit
    std::optional<OneButtonPlace> one_button{}; ///< none: the visitor flies with all controls
    Requests requests{}; ///< of the exhibit and its docent
};

/// The way of a visitor's hands from the devices to the flight.
class Hands {
public:
    explicit Hands(const HandsRules& rules)
        : rules_(rules)
    {
    }

    /// A writer of the controls. Nobody else writes them.
    struct Writer {
        std::string_view name;
        void (Hands::*write)(Controls& controls, const HandsFrame& frame);
    };
    /// All writers, in the order in which they act: a lock acts before a press counts as that of the one button; a hold
    /// before calm hands keep a press for later; and requests come after calm hands, which would hold them back.
    static const std::array<Writer, 5> writers;

    /// The controls of the visitor's hands: of all writers but the last one.
    Controls advance(const HandsFrame& frame);
    /// The controls that fly: those of the hands, or of a replay, with the last writer's requests.
    Controls finish(Controls controls, const Requests& requests);

    bool somebody() const { return somebody_; } ///< has touched a control in the last frame
    const Scan& scan() const { return scan_; } ///< of the one button
    /// Another visitor's hands, or another way to fly: the one button begins anew.
    void forget() { scan_ = {}; }
    /// Gives a builder's switches back for ten minutes.
    void unlock();

private:
    void take_devices(Controls& controls, const HandsFrame& frame);
    void lock(Controls& controls, const HandsFrame& frame);
    void hold(Controls& controls, const HandsFrame& frame);
    void calm(Controls& controls, const HandsFrame& frame);
    void request(Controls& controls, const HandsFrame& frame);
    void scan(Controls& controls, const OneButtonPlace& place, std::int64_t dt_ns);

    HandsRules rules_;
    Presence presence_;
    bool somebody_ = false;
    std::int64_t unlocked_ns_ = 0; ///< left
    Scan scan_;
    FlashLimiter calm_;
};

} // namespace starbow
