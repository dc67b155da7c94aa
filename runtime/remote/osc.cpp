// Messages of Open Sound Control 1.0, which liblo reads.
#include "config/json/error.h"
#include "config/json/reader.h"
#include "messages.h"
#include <array>
#include <charconv>
#include <cstring>
#include <lo/lo_lowlevel.h>
#include <memory>
#include <optional>

namespace starbow {
namespace {

constexpr std::string_view bundle_start("#bundle\0", 8), prefix = "/starbow/";
constexpr std::size_t most_in_bundle = 64;

/// liblo's handle of a message: void* up to release 0.31, a type of its own since.
struct FreeMessage {
    using pointer = lo_message;
    void operator()(lo_message message) const { lo_message_free(message); }
};

/// What the value of a button means: true and every number above 0 act, false and 0 do not. Consoles send 1, 1.0, 127 of a
/// MIDI note, T, or the impulse I, and 0 or F when a button is let go. Throws InputError where it is none of these.
bool acts(lo_type type, lo_arg* value)
{
    if (lo_is_numerical_type(type))
        if (const double number = double(lo_hires_val(type, value)); number >= 0)
            return number > 0;
    const bool is_text = type == LO_STRING || type == LO_SYMBOL;
    const std::string text = is_text ? reinterpret_cast<const char*>(value) : ""; // the union may lie at any multiple of 4
    if (type == LO_TRUE || type == LO_INFINITUM || text == "on" || text == "true" || text == "1")
        return true;
    if (type == LO_FALSE || text == "off" || text == "false" || text == "0")
        return false;
    throw InputError(
        "an OSC message has a value that is neither on nor off; true, a number of at least 0, on or off is right");
}

/// One argument as a word of a command with a name, a text or a number.
std::string word_of(lo_type type, lo_arg* value)
{
    if (type == LO_STRING || type == LO_SYMBOL)
        return reinterpret_cast<const char*>(value);
    if (!lo_is_numerical_type(type))
        throw InputError("an OSC message has a value of type " + one_line(std::string(1, char(type)))
            + "; a number or a text is right here");
    std::array<char, 64> digits;
    const auto [end, error] = std::to_chars(digits.begin(), digits.end(), double(lo_hires_val(type, value)));
    return {digits.begin(), end};
}

/// None: a button that acts when it is pressed was let go.
std::optional<Command> command_of_message(std::span<const unsigned char> bytes)
{
    // liblo reads 4 bytes at a time.
    std::vector<std::uint32_t> aligned((bytes.size() + 3) / 4 + 1);
    std::memcpy(aligned.data(), bytes.data(), bytes.size());
    int result = 0;
    const std::unique_ptr<lo_message, FreeMessage> message(lo_message_deserialise(aligned.data(), bytes.size(), &result));
    if (!message)
        throw InputError("a datagram is not an OSC message; one such as /starbow/scene avenue is right");
    const std::string path = reinterpret_cast<const char*>(bytes.data()); // deserialise has found its end
    if (!path.starts_with(prefix))
        throw InputError("the OSC address " + one_line(path, 60) + " is not known; one such as /starbow/stop is right");
    const std::string name = path.substr(prefix.size());
    const auto rules = command_rules();
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const CommandRule& one) { return one.name == name; });
    const CommandValue kind = rule != rules.end() ? rule->value : CommandValue::text;
    std::vector<std::string> words{name};
    const int count = lo_message_get_argc(message.get());
    const char* types = lo_message_get_types(message.get());
    lo_arg** values = lo_message_get_argv(message.get());
    if (kind == CommandValue::none && count == 1) {
        if (!acts(lo_type(types[0]), values[0]))
            return {};
    } else if (kind == CommandValue::on && count == 1) {
        words.emplace_back(acts(lo_type(types[0]), values[0]) ? "on" : "off");
    } else {
        for (int i = 0; i < count && words.size() < 3; ++i)
            words.push_back(word_of(lo_type(types[i]), values[i]));
    }
    return command_of(words);
}

std::uint32_t big_endian(const unsigned char* bytes)
{
    return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 | std::uint32_t(bytes[2]) << 8 | bytes[3];
}

bool starts_bundle(std::span<const unsigned char> part)
{
    return part.size() >= bundle_start.size() && std::memcmp(part.data(), bundle_start.data(), bundle_start.size()) == 0;
}

/// Adds the commands of a message or of a bundle, which may hold bundles.
void add_commands(std::span<const unsigned char> bytes, int depth, std::size_t& messages, std::vector<Command>& commands)
{
    constexpr int most_depth = 8;
    if (!starts_bundle(bytes)) {
        if (++messages > most_in_bundle)
            throw InputError("an OSC bundle has more than 64 messages; fewer are right");
        if (std::optional<Command> command = command_of_message(bytes))
            commands.push_back(*std::move(command));
        return;
    }
    if (depth > most_depth)
        throw InputError("an OSC bundle holds bundles within bundles; at most 8 of them are right");
    // Eight bytes of time follow, which is not looked at: all is done at once.
    for (std::size_t at = 16; at < bytes.size();) {
        const std::size_t left = bytes.size() - at, size = left > 4 ? big_endian(&bytes[at]) : 0;
        if (size == 0 || size > left - 4)
            throw InputError("an OSC bundle is cut off; a whole one is right");
        add_commands(bytes.subspan(at + 4, size), depth + 1, messages, commands);
        at += 4 + size;
    }
}

} // namespace

std::vector<Command> commands_of_osc(std::span<const unsigned char> bytes)
{
    std::vector<Command> commands;
    std::size_t messages = 0;
    add_commands(bytes, 1, messages, commands);
    return commands;
}

} // namespace starbow
