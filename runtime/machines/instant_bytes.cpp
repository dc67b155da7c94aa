#include "instant_bytes.h"
#include "bus.h"
#include "config/json/error.h"
#include "runtime/flight/record.h"
#include "sound.h"
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace starbow {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Another order or kind of the fields below is another version.
constexpr std::uint32_t version = 4;

/// Counts and lengths above these belong to no instant.
constexpr std::uint32_t most_letters = 3000, most_things = 256;

struct Writer {
    static constexpr bool reads = false;
    std::vector<std::uint8_t> bytes{};

    void raw(const void* from, std::size_t size)
    {
        const auto* first = static_cast<const std::uint8_t*>(from);
        bytes.insert(bytes.end(), first, first + size);
    }
};

struct Reader {
    static constexpr bool reads = true;
    std::span<const std::uint8_t> bytes;

    void raw(void* to, std::size_t size)
    {
        if (size > bytes.size())
            throw InputError("a state of the exhibit's machines ends too early");
        std::memcpy(to, bytes.data(), size);
        bytes = bytes.subspan(size);
    }
};

template <class Part> std::uint32_t length(Part& part, std::size_t of, std::uint32_t most)
{
    auto count = std::uint32_t(of);
    part.raw(&count, sizeof count);
    if (Part::reads && count > most)
        throw InputError("a state of the exhibit's machines has a part of " + std::to_string(count) + "; at most "
            + std::to_string(most) + " is right");
    return count;
}

template <class Part, class Number>
requires std::is_arithmetic_v<Number>
void take(Part& part, Number& number)
{
    if constexpr (std::is_same_v<Number, bool>) {
        std::uint8_t byte = number;
        part.raw(&byte, 1);
        if constexpr (Part::reads)
            number = byte != 0;
    } else {
        part.raw(&number, sizeof number);
        if constexpr (Part::reads && std::is_floating_point_v<Number>)
            if (!std::isfinite(number))
                throw InputError("a state of the exhibit's machines has a number that is none");
    }
}

/// A choice among `count`.
template <class Part, class Choice> void take_choice(Part& part, Choice& choice, std::size_t count)
{
    auto number = std::uint8_t(choice);
    take(part, number);
    if constexpr (Part::reads) {
        if (number >= count)
            throw InputError(
                "a state of the exhibit's machines has choice " + std::to_string(number) + " of " + std::to_string(count));
        choice = Choice(number);
    }
}

template <class Part> void take(Part& part, std::string& text)
{
    const std::uint32_t count = length(part, text.size(), most_letters);
    if constexpr (Part::reads)
        text.resize(count);
    part.raw(text.data(), count);
}

template <class Part> void take(Part& part, glm::dvec3& v) { take(part, v.x), take(part, v.y), take(part, v.z); }
template <class Part> void take(Part& part, glm::dquat& q)
{
    take(part, q.w), take(part, q.x), take(part, q.y), take(part, q.z);
}

template <class Part, class Thing> void take(Part& part, std::vector<Thing>& list)
{
    const std::uint32_t count = length(part, list.size(), most_things);
    if constexpr (Part::reads)
        list.resize(count);
    for (Thing& thing : list)
        take(part, thing);
}

template <class Part, class Thing> void take(Part& part, std::optional<Thing>& thing)
{
    bool there = thing.has_value();
    take(part, there);
    if constexpr (Part::reads) {
        thing.reset();
        if (there)
            thing.emplace();
    }
    if (there)
        take(part, *thing);
}

template <class Part> void take(Part& part, Effects& effects)
{
    for (const EffectEntry& one : all_effects) {
        bool on = effects[one.which];
        take(part, on);
        effects.on.set(one.which, on);
    }
    take_choice(part, effects.comparison, comparison_names.size());
}

template <class Part> void take(Part& part, Shot& shot)
{
    take(part, shot.scene), take(part, shot.time), take(part, shot.position), take(part, shot.u);
    take(part, shot.ship_from_cockpit), take(part, shot.effects), take(part, shot.exposure_ev);
}

template <class Part> void take(Part& part, RangeCurve& curve)
{
    for (double& knot : curve.shown)
        take(part, knot);
    take(part, curve.low), take(part, curve.high);
}

template <class Part> void take(Part& part, Caption& caption)
{
    take(part, caption.text), take(part, caption.choices);
    take(part, caption.chosen), take(part, caption.right);
    take(part, caption.aside), take(part, caption.flying), take(part, caption.menu);
}

template <class Part> void take(Part& part, Readings::Range& range) { take(part, range.stops), take(part, range.shown); }

template <class Part> void take(Part& part, Readings& shown)
{
    take(part, shown.beta_deficit), take(part, shown.gamma), take(part, shown.doppler_ahead);
    take(part, shown.looked_cosine);
    take(part, shown.ship_s), take(part, shown.world_s), take(part, shown.distance_m);
    take(part, shown.light_speed_m_s), take(part, shown.frames_per_s), take(part, shown.effects);
    take_choice(part, shown.mode, flight_modes.size());
    take(part, shown.frozen), take(part, shown.exposure_ev), take(part, shown.exposure_locked);
    take(part, shown.range), take(part, shown.lever), take(part, shown.prompt), take(part, shown.caption);
    take(part, shown.notice);
    take_choice(part, shown.information, informations.size());
}

template <class Part> void take(Part& part, Written& written) { take(part, written.number), take(part, written.readings); }
template <class Part> void take(Part& part, ShownSign& sign) { take(part, sign.lines), take(part, sign.towards); }

template <class Part> void take(Part& part, SmallPicture& picture)
{
    take_choice(part, picture.kind, beside_names.size());
    take(part, picture.start_ev), take(part, picture.fov_deg), take(part, picture.name);
}

template <class Part> void take(Part& part, Spot& spot)
{
    take(part, spot.at), take(part, spot.frame), take(part, spot.sky);
    std::optional<std::uint64_t> clock = spot.clock;
    take(part, clock);
    if constexpr (Part::reads)
        spot.clock = clock;
}

template <class Part> void take(Part& part, OverlayScale& scale)
{
    take(part, scale.nearest_s), take(part, scale.farthest_s), take(part, scale.emission_step_s);
}

template <class Part> void take(Part& part, Instruments& on)
{
    take_choice(part, on.overlay, overlay_names.size());
    for (std::optional<Spot>& mark : on.marks)
        take(part, mark);
    take(part, on.scale), take(part, on.panel_number);
    for (int i = 0; i < 4; ++i)
        take(part, on.scale_place[i]);
}

template <class Part> void take(Part& part, Instant& now)
{
    take(part, now.shot);
    take(part, now.head.moved_m), take(part, now.head.turned);
    take(part, now.range), take(part, now.meters), take(part, now.bloom), take(part, now.black);
    take(part, now.vignette.elevation_deg), take(part, now.vignette.clear_deg);
    take(part, now.vignette.soft_deg), take(part, now.vignette.darkness), take(part, now.vignette_part);
    take_choice(part, now.pattern, pattern_names.size());
    take(part, now.hud), take(part, now.sign), take(part, now.small_picture), take(part, now.instruments);
}

template <class Part> void take(Part& part, TurnedNumber& number) { take(part, number.place), take(part, number.value); }

template <class Part> void take(Part& part, SharedInstant& shared)
{
    take(part, shared.scene), take(part, shared.coming);
    take(part, shared.layout), take(part, shared.layout_digest), take(part, shared.turned);
    take(part, shared.language), take(part, shared.quality), take(part, shared.level);
    take(part, shared.instant);
}

} // namespace

std::vector<std::uint8_t> bytes_of(const SharedInstant& instant)
{
    Writer writer;
    SharedInstant copy = instant; // one list of fields serves both ways
    std::uint32_t number = version;
    take(writer, number), take(writer, copy);
    if (writer.bytes.size() > most_state_bytes)
        throw InputError("the state of a frame takes " + std::to_string(writer.bytes.size()) + " bytes; at most "
            + std::to_string(most_state_bytes) + " are sent, so shorter captions are right");
    return std::move(writer.bytes);
}

SharedInstant instant_of(std::span<const std::uint8_t> bytes)
{
    Reader reader{bytes};
    std::uint32_t number = 0;
    take(reader, number);
    if (number != version)
        throw InputError("a state of the exhibit's machines has version " + std::to_string(number)
            + "; the same program, with version " + std::to_string(version) + ", on all machines is right");
    SharedInstant shared;
    take(reader, shared);
    if (!reader.bytes.empty())
        throw InputError("a state of the exhibit's machines has " + std::to_string(reader.bytes.size()) + " bytes too many");
    if (const std::string fault = fault_of(shared); !fault.empty())
        throw InputError("a state of the exhibit's machines " + fault);
    return shared;
}

std::uint64_t digest_of_instant(std::span<const std::uint8_t> bytes)
{
    return digest(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

} // namespace starbow
