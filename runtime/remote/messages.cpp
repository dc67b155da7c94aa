#include "messages.h"
#include "auth.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/quality.h"
#include "config/model/shipped.h"
#include "runtime/operation/log.h"
#include <algorithm>
#include <arpa/inet.h>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

using json = nlohmann::ordered_json;

constexpr int greatest_id = 1000000000;

/// The object that a message is.
json object_of(std::string_view text)
{
    if (text.size() > most_message_bytes)
        throw InputError("a message has " + std::to_string(text.size()) + " bytes; at most "
            + std::to_string(most_message_bytes) + " are right");
    json message = json::parse(text.begin(), text.end(), nullptr, false);
    if (!message.is_object())
        throw InputError("a message is not a JSON object; {\"id\": 1, \"command\": [\"stop\"]} is right");
    return message;
}

int id_in(const json& message)
{
    const auto id = message.find("id");
    if (id == message.end() || !id->is_number_unsigned() || id->get<std::uint64_t>() > std::uint64_t(greatest_id))
        return 0;
    return id->get<int>();
}

std::string dump(const json& message) { return message.dump(-1, ' ', false, json::error_handler_t::replace); }

/// Ladders lie in the same folder.
bool is_quality(const std::string& name)
{
    try {
        load_quality(shipped_file("qualities", name));
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Each item's kind and name, as a command gives them, its planned minutes, and its notes by language.
json items_of(const Programme& programme)
{
    json all = json::array();
    for (const ProgrammeItem& item : programme.items) {
        const auto& [kind, name] = shown_by(item);
        all.push_back({{"kind", kind}, {"name", name}, {"minutes", item.minutes}, {"notes", item.notes.texts}});
    }
    return all;
}

/// A finite number for JSON, which has no infinity.
double finite(double number) { return std::isfinite(number) ? number : 0; }

} // namespace

Request request_of(std::string_view text)
{
    const json message = object_of(text);
    Request request{.id = id_in(message), .command = {}, .picture = {}};
    if (request.id == 0)
        throw InputError("a message has no id; a whole number from 1 to 1000000000 is right");
    const auto command = message.find("command"), picture = message.find("picture");
    if (message.size() != 2 || (command == message.end()) == (picture == message.end()))
        throw InputError("a message has other members than id and command, or id and picture; one of these pairs is right");
    if (picture != message.end()) {
        if (!picture->is_boolean())
            throw InputError("a message's picture is neither true nor false; one of them is right");
        request.picture = picture->get<bool>();
        return request;
    }
    if (!command->is_array() || command->size() > 3)
        throw InputError("a message's command is not a list of one to three texts; [\"stop\"] is right");
    std::vector<std::string> words;
    for (const json& word : *command) {
        if (!word.is_string())
            throw InputError("a message's command is not a list of one to three texts; [\"stop\"] is right");
        words.push_back(word.get<std::string>());
    }
    request.command = command_of(words);
    return request;
}

int id_of(std::string_view text)
{
    try {
        return id_in(object_of(text));
    } catch (const InputError&) {
        return 0;
    }
}

std::string pin_of(std::string_view text)
{
    const json message = object_of(text);
    const auto pin = message.find("pin");
    if (pin == message.end() || !pin->is_string())
        throw InputError("a login has no PIN; {\"pin\": \"123456\"} is right");
    return pin->get<std::string>();
}

std::string_view token_of(std::string_view cookies)
{
    constexpr std::string_view name = "starbow=";
    while (!cookies.empty()) {
        const std::size_t end = std::min(cookies.find(';'), cookies.size());
        std::string_view one = cookies.substr(0, end);
        cookies.remove_prefix(std::min(end + 1, cookies.size()));
        while (one.starts_with(' '))
            one.remove_prefix(1);
        if (one.starts_with(name))
            return one.substr(name.size());
    }
    return {};
}

bool host_is_listed(std::string_view host, const RemoteSettings& settings)
{
    std::string name(host);
    std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    const std::size_t colon = name.rfind(':');
    const bool has_port = colon != name.npos && name.find(']', colon) == name.npos;
    const std::string port = has_port ? name.substr(colon + 1) : settings.certificate.empty() ? "80" : "443";
    if (port != std::to_string(settings.port))
        return false;
    name.resize(has_port ? colon : name.size());
    const bool v6 = settings.address.find(':') != settings.address.npos;
    return name == "localhost" || name == "127.0.0.1" || name == "[::1]"
        || name == (v6 ? "[" + settings.address + "]" : settings.address)
        || std::ranges::find(settings.hosts, name) != settings.hosts.end();
}

bool origin_is_of(std::string_view origin, std::string_view host, bool tls)
{
    const std::string right = (tls ? "https://" : "http://") + std::string(host);
    return std::ranges::equal(origin, right, [](char a, char b) {
        const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; };
        return lower(a) == lower(b);
    });
}

std::string plain_address(std::string_view address)
{
    constexpr std::string_view mapped = "::ffff:";
    const bool v4 = address.starts_with(mapped) && address.find('.') != address.npos;
    return std::string(v4 ? address.substr(mapped.size()) : address);
}

std::string counted_address(std::string_view address)
{
    const std::string plain = plain_address(address);
    in6_addr bytes{};
    if (inet_pton(AF_INET6, plain.c_str(), &bytes) != 1)
        return plain;
    std::fill(bytes.s6_addr + 8, bytes.s6_addr + 16, std::uint8_t(0));
    std::array<char, INET6_ADDRSTRLEN> text{};
    return inet_ntop(AF_INET6, &bytes, text.data(), text.size()) ? text.data() : plain;
}

std::string status_text(const Snapshot& now, bool engineer)
{
    json status{{"scene", now.scene}, {"shot", now.shot}, {"tour", now.tour}, {"step", now.step}, {"steps", now.steps},
        {"language", now.language}, {"information", name_of(now.information)},
        {"comparison", comparison_names[std::size_t(now.effects.comparison)]}, {"speed", finite(now.speed)},
        {"gamma", finite(now.gamma)}, {"max-gamma", finite(now.max_gamma)}, {"max-speed", finite(speed_of(now.max_gamma))},
        {"exposure", finite(now.exposure_ev)}, {"doing", doing_names[std::size_t(now.doing)]},
        {"left-s", std::ceil(finite(now.left_s))}, {"calm", now.calm},
        {"next-caption", std::map(now.next_caption.begin(), now.next_caption.end())}, {"item", now.item},
        {"items", now.items}, {"item-s", std::floor(finite(now.item_s))}, {"coming", now.coming}, {"visit", now.visit},
        {"caption", now.caption}, {"frames-per-s", std::round(finite(now.frames_per_s) * 10) / 10},
        {"frame-ms", std::round(finite(now.frame_ms) * 10) / 10}, {"uptime-s", std::floor(finite(now.uptime_s))}};
    for (const EffectEntry& one : all_effects)
        status[dashed(one.name)] = now.effects[one.which];
    for (const SwitchedState& one : switched_states)
        status[one.name] = now.*one.member;
    if (engineer) {
        status["layout"] = now.layout;
        status["pattern"] = now.pattern.empty() ? "none" : now.pattern;
        status["quality"] = now.quality;
        status["grip"] = now.grip;
        status["grip-says"] = now.grip_says;
        status["error"] = now.error;
        status["machines"] = now.machines;
    }
    return dump({{"status", status}});
}

std::string answer_text(int id, const std::string& refusal)
{
    json answer{{"id", id}, {"applied", refusal.empty()}};
    if (!refusal.empty())
        answer["refused"] = refusal;
    return dump({{"answer", answer}});
}

std::string condition_text(const Condition& condition)
{
    return dump({{"log", condition.log}, {"grips", condition.grips}, {"unkept", condition.unkept}});
}

std::string hello_text(Role role, const std::string& version)
{
    return dump({{"hello", {{"role", role_names[std::size_t(role)]}, {"version", version}}}});
}

std::string lists_text(const std::vector<std::string>& patterns, const std::optional<Programme>& programme)
{
    constexpr std::array<const char*, 6> values{"none", "on", "number", "name", "text", "place"};
    json commands = json::object();
    for (const bool effects : {true, false}) // the page shows switches in this order
        for (const CommandRule& rule : command_rules())
            if (effects == (rule.kind == CommandKind::effect))
                commands[std::string(rule.name)]
                    = {{"role", role_names[std::size_t(rule.role)]}, {"value", values[std::size_t(rule.value)]}};
    json names = json::object();
    for (const auto& [command, folder] : {std::pair{"tour", "tours"}, {"scene", "scenes"}, {"shot", "shots"},
             {"layout", "layouts"}, {"quality", "qualities"}, {"language", "words"}})
        names[command] = shipped_names(folder);
    std::erase_if(names["quality"].get_ref<json::array_t&>(), [](const json& name) { return !is_quality(name); });
    names["comparison"] = comparison_names;
    names["information"] = names_of(informations);
    names["pattern"] = patterns;
    return dump({{"commands", commands}, {"names", names}, {"speed-limits", offered_limits},
        {"programme", programme ? items_of(*programme) : json::array()}});
}

std::string words_text()
{
    constexpr std::array<std::string_view, 3> prefixes{"remote.", "does.", "name."};
    json all = json::object();
    for (const std::string& language : shipped_names("words"))
        try {
            const Words words = words_in(language);
            json& texts = all[language] = json::object();
            for (const auto& [key, text] : words.texts)
                if (std::ranges::any_of(prefixes, [&](std::string_view prefix) { return key.starts_with(prefix); }))
                    texts[key] = text;
        } catch (const InputError& error) {
            write_log(LogKind::words_unreadable, std::string(error.what()) + "; the page leaves this language out");
            all.erase(language);
        }
    return dump(all);
}

} // namespace starbow
