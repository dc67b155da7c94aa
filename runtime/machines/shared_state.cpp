#include "shared_state.h"
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

/// Counts and lengths above these belong to no state.
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

/// Reads a state in which every list and every optional has something, and notes the kinds of its numbers in order.
struct Shape {
    static constexpr bool reads = true;
    std::uint64_t kinds = digest(std::string_view());

    void note(bool is_float) { kinds = digest(is_float ? "f" : "i", kinds); }
    void raw(void* to, std::size_t size)
    {
        std::memset(to, 1, size);
        kinds = digest(std::to_string(size), kinds);
    }
};

template <class Part> std::uint32_t length(Part& part, std::size_t of, std::uint32_t most)
{
    auto count = std::uint32_t(of);
    part.raw(&count, sizeof count);
    if (std::is_same_v<Part, Shape>)
        return 1;
    if (Part::reads && count > most)
        throw InputError("a state of the exhibit's machines has a part of " + std::to_string(count) + "; at most "
            + std::to_string(most) + " is right");
    return count;
}

template <class Part, class Number>
requires std::is_arithmetic_v<Number>
void transfer(Part& part, Number& number)
{
    if constexpr (std::is_same_v<Number, bool>) {
        std::uint8_t byte = number;
        part.raw(&byte, 1);
        if constexpr (Part::reads)
            number = byte != 0;
    } else {
        if constexpr (std::is_same_v<Part, Shape>)
            part.note(std::is_floating_point_v<Number>);
        part.raw(&number, sizeof number);
        if constexpr (Part::reads && std::is_floating_point_v<Number>)
            if (!std::isfinite(number))
                throw InputError("a state of the exhibit's machines has a number that is none");
    }
}

/// The counts of the choices. Another enum does not compile.
constexpr std::size_t count_of(Comparison) { return comparison_names.size(); }
constexpr std::size_t count_of(FlightMode) { return flight_mode_names.size(); }
constexpr std::size_t count_of(Information) { return information_names.size(); }
constexpr std::size_t count_of(InsetView) { return inset_view_names.size(); }
constexpr std::size_t count_of(Overlay) { return overlay_names.size(); }
constexpr std::size_t count_of(Pattern) { return pattern_names.size(); }

template <class Part, class Choice>
requires std::is_enum_v<Choice>
void transfer(Part& part, Choice& choice)
{
    auto number = std::uint8_t(choice);
    transfer(part, number);
    if constexpr (Part::reads) {
        const std::size_t count = count_of(choice);
        if (number >= count)
            throw InputError(
                "a state of the exhibit's machines has choice " + std::to_string(number) + " of " + std::to_string(count));
        choice = Choice(number);
    }
}

template <class Part> void transfer(Part& part, std::string& text)
{
    const std::uint32_t count = length(part, text.size(), most_letters);
    if constexpr (Part::reads)
        text.resize(count);
    part.raw(text.data(), count);
}

template <class Part> void transfer(Part& part, EffectSet& on)
{
    for (const EffectEntry& one : all_effects) {
        bool is = on[one.which];
        transfer(part, is);
        on.set(one.which, is);
    }
}

template <class Part> void transfer(Part& part, glm::vec4& v)
{
    transfer(part, v.x), transfer(part, v.y), transfer(part, v.z), transfer(part, v.w);
}
template <class Part> void transfer(Part& part, glm::dvec3& v)
{
    transfer(part, v.x), transfer(part, v.y), transfer(part, v.z);
}
template <class Part> void transfer(Part& part, glm::dquat& q)
{
    transfer(part, q.w), transfer(part, q.x), transfer(part, q.y), transfer(part, q.z);
}

template <class Part, class Thing> void transfer(Part& part, std::vector<Thing>& list)
{
    const std::uint32_t count = length(part, list.size(), most_things);
    if constexpr (Part::reads)
        list.resize(count);
    for (Thing& thing : list)
        transfer(part, thing);
}

template <class Part, class Thing, std::size_t count> void transfer(Part& part, std::array<Thing, count>& list)
{
    for (Thing& thing : list)
        transfer(part, thing);
}

template <class Part, class Thing> void transfer(Part& part, std::optional<Thing>& thing)
{
    bool there = thing.has_value();
    transfer(part, there);
    if constexpr (Part::reads) {
        thing.reset();
        if (there)
            thing.emplace();
    }
    if (there)
        transfer(part, *thing);
}

// One list of a struct's members serves both directions. A binding names them all, so that a new member does not compile.

template <class Part, class... Members> void transfer_all(Part& part, Members&... members)
{
    (transfer(part, members), ...);
}

template <class Part> void transfer(Part& part, Effects& effects)
{
    auto& [on, comparison] = effects;
    transfer_all(part, on, comparison);
}

template <class Part> void transfer(Part& part, Shot& shot)
{
    auto& [scene, time, position, u, ship_from_cockpit, effects, exposure_ev] = shot;
    transfer_all(part, scene, time, position, u, ship_from_cockpit, effects, exposure_ev);
}

template <class Part> void transfer(Part& part, Head& head)
{
    auto& [moved_m, turned] = head;
    transfer_all(part, moved_m, turned);
}

template <class Part> void transfer(Part& part, RangeCurve& curve)
{
    auto& [shown, low, high] = curve;
    transfer_all(part, shown, low, high);
}

template <class Part> void transfer(Part& part, Vignette& vignette)
{
    auto& [elevation_deg, clear_deg, soft_deg, darkness] = vignette;
    transfer_all(part, elevation_deg, clear_deg, soft_deg, darkness);
}

template <class Part> void transfer(Part& part, Caption& caption)
{
    auto& [text, choices, chosen, right, aside, flying, menu, picture] = caption;
    transfer_all(part, text, choices, chosen, right, aside, flying, menu, picture);
}

template <class Part> void transfer(Part& part, Readings::Range& range)
{
    auto& [stops, shown] = range;
    transfer_all(part, stops, shown);
}

template <class Part> void transfer(Part& part, Readings& readings)
{
    auto& [beta_deficit, gamma, doppler_ahead, looked_cosine, ship_s, world_s, distance_m, light_speed_m_s, frames_per_s,
        effects, mode, frozen, exposure_ev, exposure_locked, filtered, range, lever, prompt, caption, notice, information]
        = readings;
    transfer_all(part, beta_deficit, gamma, doppler_ahead, looked_cosine, ship_s, world_s, distance_m, light_speed_m_s,
        frames_per_s, effects, mode, frozen, exposure_ev, exposure_locked, filtered, range, lever, prompt, caption, notice,
        information);
}

template <class Part> void transfer(Part& part, HudText& written)
{
    auto& [number, readings] = written;
    transfer_all(part, number, readings);
}

template <class Part> void transfer(Part& part, ShownSign& sign)
{
    auto& [lines, towards] = sign;
    transfer_all(part, lines, towards);
}

template <class Part> void transfer(Part& part, ShownHighlight& highlight)
{
    auto& [name, towards, radius, enlarged_deg] = highlight;
    transfer_all(part, name, towards, radius, enlarged_deg);
}

template <class Part> void transfer(Part& part, SkyLabel& label)
{
    auto& [name, towards] = label;
    transfer_all(part, name, towards);
}

template <class Part> void transfer(Part& part, ShownPointer& pointer)
{
    auto& [towards, strength] = pointer;
    transfer_all(part, towards, strength);
}

template <class Part> void transfer(Part& part, InsetPicture& picture)
{
    auto& [kind, start_ev, fov_deg, name] = picture;
    transfer_all(part, kind, start_ev, fov_deg, name);
}

template <class Part> void transfer(Part& part, Spot& spot)
{
    auto& [at, frame, sky, clock] = spot;
    transfer_all(part, at, frame, sky, clock);
}

template <class Part> void transfer(Part& part, OverlayScale& scale)
{
    auto& [nearest_s, farthest_s, emission_step_s] = scale;
    transfer_all(part, nearest_s, farthest_s, emission_step_s);
}

template <class Part> void transfer(Part& part, Instruments& on)
{
    auto& [overlay, marks, scale, panel, panel_number, scale_place] = on; // the panel's picture is a page's
    transfer_all(part, overlay, marks, scale, panel_number, scale_place);
}

template <class Part> void transfer(Part& part, PictureState& now)
{
    auto& [shot, head, range, meters, bloom, fade, vignette, vignette_part, pattern, hud, title, sign, highlights, figures,
        sky_labels, pointer, inset, instruments]
        = now;
    transfer_all(part, shot, head, range, meters, bloom, fade, vignette, vignette_part, pattern, hud, title, sign,
        highlights, figures, sky_labels, pointer, inset, instruments);
}

template <class Part> void transfer(Part& part, TurnedNumber& number)
{
    auto& [place, value] = number;
    transfer_all(part, place, value);
}

template <class Part> void transfer(Part& part, SharedState& shared)
{
    auto& [scene, coming, layout, layout_digest, turned, language, quality, level, picture] = shared;
    transfer_all(part, scene, coming, layout, layout_digest, turned, language, quality, level, picture);
}

/// Another order or kind of the fields is another version.
std::uint32_t version()
{
    static const std::uint32_t number = [] {
        Shape shape;
        SharedState all;
        transfer(shape, all);
        return std::uint32_t(shape.kinds ^ (shape.kinds >> 32));
    }();
    return number;
}

} // namespace

std::vector<TurnedNumber> turned_for_machines(const Layout& kept, const Layout& now)
{
    std::vector<TurnedNumber> numbers = turned_numbers(kept, now);
    if (numbers.size() > most_turned)
        throw InputError("is one number more than several machines take before the layout is saved, "
            + std::to_string(most_turned) + "; saving it first (F5) is right");
    return numbers;
}

std::vector<std::uint8_t> bytes_of(const SharedState& shared)
{
    Writer writer;
    SharedState copy = shared; // one list of fields serves both ways
    std::uint32_t number = version();
    transfer(writer, number), transfer(writer, copy);
    if (writer.bytes.size() > most_state_bytes)
        throw InputError("the state of a frame takes " + std::to_string(writer.bytes.size()) + " bytes; at most "
            + std::to_string(most_state_bytes) + " are sent, so shorter captions are right");
    return std::move(writer.bytes);
}

SharedState shared_state_of(std::span<const std::uint8_t> bytes)
{
    Reader reader{bytes};
    std::uint32_t number = 0;
    transfer(reader, number);
    if (number != version())
        throw InputError("a state of the exhibit's machines has version " + std::to_string(number)
            + "; the same program, with version " + std::to_string(version()) + ", on all machines is right");
    SharedState shared;
    transfer(reader, shared);
    if (!reader.bytes.empty())
        throw InputError("a state of the exhibit's machines has " + std::to_string(reader.bytes.size()) + " bytes too many");
    if (const std::string fault = fault_of(shared); !fault.empty())
        throw InputError("a state of the exhibit's machines " + fault);
    return shared;
}

std::uint64_t digest_of_state(std::span<const std::uint8_t> bytes)
{
    return digest(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

} // namespace starbow
