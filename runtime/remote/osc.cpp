// Messages of Open Sound Control 1.0, which liblo reads.
#include "config/json/error.h"
#include "config/json/reader.h"
#include "messages.h"
#include <array>
#include <charconv>
#include <cstring>
#include <lo/lo_lowlevel.h>
#include <memory>

namespace starbow {
namespace {

constexpr std::string_view bundle_start("#bundle\0", 8), prefix = "/starbow/";
constexpr std::size_t most_in_bundle = 64;

/// liblo's handle of a message: void* up to release 0.31, a type of its own since.
struct FreeMessage {
    using pointer = lo_message;
    void operator()(lo_message message) const { lo_message_free(message); }
};

/// One argument as a word of a command: 1 and T are on, 0 and F off, where the command is a switch.
std::string word_of(lo_type type, lo_arg* value, bool is_switch)
{
    if (!lo_is_numerical_type(type)) {
        switch (type) {
        case LO_STRING:
        case LO_SYMBOL:
            return reinterpret_cast<const char*>(value); // the union itself may lie at any multiple of 4 bytes
        case LO_TRUE:
            return "on";
        case LO_FALSE:
            return "off";
        default:
            throw InputError("an OSC message has a value of type " + one_line(std::string(1, char(type)))
                + "; a number, a text, true or false is right");
        }
    }
    const double number = double(lo_hires_val(type, value));
    if (is_switch && (number == 0 || number == 1))
        return number == 1 ? "on" : "off";
    std::array<char, 64> digits;
    const auto [end, error] = std::to_chars(digits.begin(), digits.end(), number);
    return {digits.begin(), end};
}

Command command_of_message(std::span<const unsigned char> bytes)
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
    const bool is_switch = rule != rules.end() && rule->value == CommandValue::on;
    std::vector<std::string> words{name};
    const int count = lo_message_get_argc(message.get());
    const char* types = lo_message_get_types(message.get());
    lo_arg** values = lo_message_get_argv(message.get());
    for (int i = 0; i < count && words.size() < 3; ++i)
        words.push_back(word_of(lo_type(types[i]), values[i], is_switch));
    // A button of a control surface sends 1 when it is pressed, and 0 when it is let go.
    if (rule != rules.end() && rule->value == CommandValue::none && words.size() == 2 && words[1] == "1")
        words.pop_back();
    return command_of(words);
}

std::uint32_t big_endian(const unsigned char* bytes)
{
    return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 | std::uint32_t(bytes[2]) << 8 | bytes[3];
}

} // namespace

std::vector<Command> commands_of_osc(std::span<const unsigned char> bytes)
{
    const auto starts_bundle = [](std::span<const unsigned char> part) {
        return part.size() >= bundle_start.size() && std::memcmp(part.data(), bundle_start.data(), bundle_start.size()) == 0;
    };
    if (!starts_bundle(bytes))
        return {command_of_message(bytes)};
    std::vector<Command> commands;
    // Eight bytes of time follow, which is not looked at: all is done at once.
    for (std::size_t at = 16; at < bytes.size();) {
        const std::size_t left = bytes.size() - at, size = left > 4 ? big_endian(&bytes[at]) : 0;
        if (size == 0 || size > left - 4 || commands.size() == most_in_bundle)
            throw InputError("an OSC bundle is cut off or has more than 64 messages; a whole one is right");
        const std::span<const unsigned char> part = bytes.subspan(at + 4, size);
        if (starts_bundle(part))
            throw InputError("an OSC bundle holds another one; messages alone are right");
        commands.push_back(command_of_message(part));
        at += 4 + size;
    }
    return commands;
}

} // namespace starbow
