// The pages' WebSockets: commands come in, statuses, answers, log and pictures go out.
#include "config/json/error.h"
#include "messages.h"
#include "runtime/operation/log.h"
#include "server.h"
#include <array>

namespace starbow {
namespace {

constexpr double most_messages_per_s = 20;
constexpr std::size_t most_answers = 64; ///< that a page may leave unread

Client*& client_at(void* room) { return *static_cast<Client**>(room); }

/// Ends a connection with a code of RFC 6455 (7.4.1). Returns what the callback returns.
int close_with(lws* wsi, lws_close_status why)
{
    lws_close_reason(wsi, why, nullptr, 0);
    return -1;
}

} // namespace

void Server::say(Client& client, const std::string& text)
{
    if (client.answers.size() == most_answers) {
        end(client);
        return;
    }
    client.answers.push_back(std::string(LWS_PRE, '\0') + text);
    lws_callback_on_writable(client.wsi);
}

void Server::end(Client& client)
{
    client.closes = true;
    lws_callback_on_writable(client.wsi);
}

Server::DueBroadcast Server::due(Client& client)
{
    const bool engineer = client.role == Role::engineer;
    const Broadcast& status = engineer ? engineer_status_ : status_;
    if (client.status != status.serial())
        return {&status, &client.status};
    if (engineer && client.log != log_.serial())
        return {&log_, &client.log};
    if (client.picture && client.picture_sent != picture_.serial())
        return {&picture_, &client.picture_sent, LWS_WRITE_BINARY};
    return {};
}

/// Sends one message, the answers first.
int Server::send_next(Client& client)
{
    if (client.closes)
        return close_with(client.wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION);
    const auto send = [&](std::string_view message, lws_write_protocol kind) {
        // libwebsockets writes its header into the room before the message.
        auto* bytes = reinterpret_cast<unsigned char*>(const_cast<char*>(message.data()));
        const int sent = lws_write(client.wsi, bytes, message.size(), kind);
        if (!client.answers.empty() || due(client))
            lws_callback_on_writable(client.wsi);
        return sent < int(message.size()) ? -1 : 0;
    };
    if (!client.answers.empty()) {
        const std::string message = std::move(client.answers.front());
        client.answers.pop_front();
        return send(std::string_view(message).substr(LWS_PRE), LWS_WRITE_TEXT);
    }
    if (const DueBroadcast next = due(client)) {
        *next.sent = next.broadcast->serial();
        return send(next.broadcast->message(), next.kind);
    }
    return 0;
}

void Server::handle(Client& client, std::string_view message)
{
    int id = id_of(message);
    try {
        const Request request = request_of(message);
        if (request.picture) {
            client.picture = *request.picture && client.role >= Role::docent;
            say(client, answer_text(id, ""));
        } else if (const std::string no = put(*request.command, client.role, client.address, &client, id); !no.empty()) {
            say(client, answer_text(id, no));
        }
    } catch (const InputError& error) {
        say(client, answer_text(id, error.what()));
    }
}

int Server::receive(Client& client, std::string_view part, bool whole)
{
    if (client.partial.size() + part.size() > most_message_bytes)
        return close_with(client.wsi, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE);
    client.partial += part;
    if (!whole)
        return 0;
    if (!client.rate.take(std::chrono::steady_clock::now()))
        return close_with(client.wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION);
    handle(client, std::exchange(client.partial, {}));
    return 0;
}

int Server::socket(lws* wsi, lws_callback_reasons reason, void* room, void* in, std::size_t size)
{
    switch (reason) {
    case LWS_CALLBACK_ESTABLISHED: {
        std::array<char, 1024> cookies{};
        std::array<char, 64> peer{};
        lws_hdr_copy(wsi, cookies.data(), int(cookies.size()), WSI_TOKEN_HTTP_COOKIE);
        lws_get_peer_simple(wsi, peer.data(), peer.size());
        const std::string token(token_of(cookies.data()));
        const std::optional<Role> role = logins_.role_of(token, std::chrono::steady_clock::now());
        if (!role)
            return -1;
        clients_.push_back({wsi, token, plain_address(peer.data()), *role, Rate(most_messages_per_s)});
        client_at(room) = &clients_.back();
        take_news();
        say(clients_.back(), hello_text(*role, options_.version));
        return 0;
    }
    case LWS_CALLBACK_RECEIVE:
        if (!client_at(room))
            return -1;
        return receive(*client_at(room), {static_cast<const char*>(in), size},
            lws_is_final_fragment(wsi) && lws_remaining_packet_payload(wsi) == 0);
    case LWS_CALLBACK_SERVER_WRITEABLE:
        return client_at(room) ? send_next(*client_at(room)) : -1;
    case LWS_CALLBACK_CLOSED:
        if (Client* client = room ? std::exchange(client_at(room), nullptr) : nullptr) {
            for (auto& [number, pending] : pending_)
                if (pending.client == client)
                    pending.client = nullptr;
            clients_.remove_if([&](const Client& one) { return &one == client; });
        }
        return 0;
    default:
        return 0;
    }
}

} // namespace starbow
