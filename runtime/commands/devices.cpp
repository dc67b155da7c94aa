#include "commands.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "input/hid.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/operation/log.h"
#include <cctype>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

namespace starbow {
namespace {

struct DevicesOptions {
    std::string describe;
    double seconds = 0;
};

constexpr std::size_t most_bytes = 1 << 20;

/// Parses pairs of hexadecimal digits, with or without 0x, blanks and commas. Comments run from # or // to the line's
/// end.
std::optional<std::vector<std::uint8_t>> from_hex(const std::string& text)
{
    std::string digits;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '#' || (c == '/' && i + 1 < text.size() && text[i + 1] == '/')) {
            while (i < text.size() && text[i] != '\n')
                ++i;
        } else if (c == '0' && i + 1 < text.size() && (text[i + 1] == 'x' || text[i + 1] == 'X')) {
            ++i;
        } else if (std::isxdigit(static_cast<unsigned char>(c))) {
            digits += c;
        } else if (!std::isspace(static_cast<unsigned char>(c)) && c != ',' && c != ';' && c != '{' && c != '}') {
            return {};
        }
    }
    if (digits.empty() || digits.size() % 2 != 0)
        return {};
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes.push_back(std::uint8_t(std::stoul(digits.substr(i, 2), nullptr, 16)));
    return bytes;
}

/// Reads a descriptor: raw bytes, hexadecimal text, or JSON with a member "descriptor_hex". Throws InputError.
std::vector<std::uint8_t> descriptor_in(const std::string& file)
{
    const std::string text = read_whole(file, most_bytes, "a file with a report descriptor");
    if (text.empty())
        throw InputError(file, "", "is empty; a report descriptor is right");
    if (const auto first = text.find_first_not_of(" \t\r\n");
        first != text.npos && text[first] == '{' && text.find('"') != text.npos) {
        const Document document = parse_document(file, text);
        const Place hex = member(root(document), "descriptor_hex");
        if (const auto bytes = from_hex(starbow::text(hex)))
            return *bytes;
        fail_at(hex, "is not a hexadecimal text; two digits for each byte are right");
    }
    if (const auto bytes = from_hex(text))
        return *bytes;
    return {text.begin(), text.end()};
}

nlohmann::json json_of(const Field& field)
{
    nlohmann::json out = {{"report_id", field.report_id}, {"usage_page", field.usage.page}, {"usage", field.usage.id},
        {"bit_offset", field.bit_offset}, {"bits", field.bits}, {"logical_min", field.logical_min},
        {"logical_max", field.logical_max}, {"signed", field.is_signed}, {"null_state", field.null_state}};
    if (field.relative)
        out["relative"] = true;
    if (field.repeated)
        out["repeated_usage"] = true;
    if (!field.array.empty()) {
        out["array"] = true;
        out["usage_max"] = field.array.back().last;
        for (const UsageRange& range : field.array)
            out["array_usages"].push_back({range.page, range.first, range.last});
    }
    return out;
}

int print_descriptor(const std::string& file)
{
    const Descriptor found = parse_descriptor(descriptor_in(file));
    if (found.fields.empty() && found.report_bits.empty())
        throw InputError(file, "",
            "declares no input" + (found.stopped.empty() ? "" : " (" + found.stopped + ")")
                + "; a HID report descriptor is right");
    nlohmann::json out = {{"uses_report_ids", found.uses_report_ids}, {"application_usages", nlohmann::json::array()},
        {"input_report_bits", nlohmann::json::object()}, {"fields", nlohmann::json::array()}};
    for (const Usage& usage : found.applications)
        out["application_usages"].push_back({usage.page, usage.id});
    for (const auto& [id, bits] : found.report_bits)
        out["input_report_bits"][std::to_string(id)] = bits;
    for (const Field& field : found.fields)
        out["fields"].push_back(json_of(field));
    if (!found.stopped.empty())
        out["stopped"] = found.stopped;
    std::printf("%s\n", out.dump(2).c_str());
    return 0;
}

/// Draws a device's axes as bars, one on each line.
void draw_controls(const Hid::Connected& device)
{
    std::printf("%s, %s, profile: %s\n", describe(device.info).c_str(), device.info.path.c_str(), device.profile.c_str());
    std::string buttons;
    for (std::size_t i = 0; i < device.descriptor.fields.size(); ++i) {
        const Field& field = device.descriptor.fields[i];
        const std::optional<std::int64_t> raw = device.state.raw.at(i);
        if (is_button(field)) {
            if (raw.value_or(0))
                buttons += " " + std::to_string(field.usage.id);
        } else if (field.bits > 1 && field.usage.page <= 2 && field.array.empty()) {
            std::string bar(41, '.');
            bar[20] = '|';
            if (raw)
                bar[std::size_t(20.5 + 20 * centred(field, *raw))] = '#';
            std::printf("  %-9s %u/%-3u %s %s\n", name_of(field.usage).c_str(), field.usage.page, field.usage.id,
                bar.c_str(), raw ? std::to_string(*raw).c_str() : "no value yet");
        }
    }
    std::printf("  buttons:%s\n", buttons.empty() ? " none" : buttons.c_str());
}

int devices(const DevicesOptions& options)
{
    if (!options.describe.empty())
        return print_descriptor(options.describe);
    Hid hid(known_profiles(), write_log);
    const bool live = options.seconds > 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(live ? options.seconds : 0.5);
    for (;;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(live ? 100 : 500));
        if (live && isatty(1))
            std::printf("\033[H\033[2J");
        const auto all = hid.devices();
        for (const Hid::Connected& device : all)
            draw_controls(device);
        if (all.empty())
            std::printf("no stick, throttle, pad or space mouse that this user can read is plugged in\n");
        std::fflush(stdout);
        if (std::chrono::steady_clock::now() >= end)
            return 0;
    }
}

} // namespace

static void add_devices(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<DevicesOptions>();
    Subcommand* command
        = app.add_subcommand("devices", "List sticks, throttles, pads and space mice, with their axes and buttons.");
    command->add_option("--seconds", options->seconds, "Show them live for this many seconds")
        ->check(number_between(0.0, 1e9));
    command->add_option("--describe", options->describe,
        "Instead: print a report descriptor's declarations as JSON. A file of raw bytes, of hexadecimal text, or JSON with "
        "\"descriptor_hex\"");
    command->footer("Examples:\n  starbow devices --seconds 60\n  starbow devices --describe "
                    "/sys/class/hidraw/hidraw0/device/report_descriptor");
    command->callback([options, &chosen] { chosen = [options] { return devices(*options); }; });
}

static const Registered devices_command{6, add_devices};

} // namespace starbow
