// The page's files, logins and metrics: one answer a request.
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "messages.h"
#include "runtime/operation/exposition.h"
#include "runtime/operation/log.h"
#include "server.h"
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <netinet/in.h>
#include <sys/socket.h>

namespace starbow {
namespace {

/// One connection's request: its path, the body that has arrived, and the body that is sent to it.
struct Visit {
    std::string path, received, sends;
};

constexpr std::string_view thumbnails = "/thumbnail/";

/// libwebsockets gives a visit the room of one pointer, zero at first.
Visit*& visit_at(void* room) { return *static_cast<Visit**>(room); }

std::string header(lws* wsi, lws_token_indexes which)
{
    std::array<char, 1024> text{};
    const int length = lws_hdr_copy(wsi, text.data(), int(text.size()), which);
    return length > 0 ? std::string(text.data(), std::size_t(length)) : "";
}

std::string peer_of(lws* wsi)
{
    std::array<char, 64> text{};
    lws_get_peer_simple(wsi, text.data(), text.size());
    return text.data();
}

/// The address of one end of a connection. which: getpeername or getsockname.
std::string end_of(int connection, int (*which)(int, sockaddr*, socklen_t*))
{
    sockaddr_storage end{};
    socklen_t size = sizeof end;
    if (which(connection, reinterpret_cast<sockaddr*>(&end), &size) != 0)
        return "";
    std::array<char, INET6_ADDRSTRLEN> text{};
    const void* address = end.ss_family == AF_INET6
        ? static_cast<const void*>(&reinterpret_cast<sockaddr_in6&>(end).sin6_addr)
        : &reinterpret_cast<sockaddr_in&>(end).sin_addr;
    inet_ntop(end.ss_family, address, text.data(), text.size());
    return plain_address(text.data());
}

/// A connection from this machine has the machine's own address at both ends.
Origin origin_of(int connection)
{
    const std::string peer = end_of(connection, getpeername);
    return {counted_address(peer), !peer.empty() && peer == end_of(connection, getsockname)};
}

bool add_header(lws* wsi, const char* name, const std::string& value, unsigned char*& at, unsigned char* end)
{
    return lws_add_http_header_by_name(wsi, reinterpret_cast<const unsigned char*>(name),
               reinterpret_cast<const unsigned char*>(value.data()), int(value.size()), &at, end)
        == 0;
}

/// Sends an answer's headers; its body follows when the connection is ready for it. Returns what the callback returns.
int begin(lws* wsi, Visit& visit, HttpAnswer answer)
{
    std::array<unsigned char, LWS_PRE + 2048> headers;
    unsigned char *const first = &headers[LWS_PRE], *at = first, *const end = headers.data() + headers.size();
    if (lws_add_http_header_status(wsi, answer.status, &at, end) != 0
        || !add_header(wsi, "content-type:", answer.type, at, end)
        || (!answer.cookie.empty() && !add_header(wsi, "set-cookie:", answer.cookie, at, end))
        || lws_add_http_header_content_length(wsi, answer.body.size(), &at, end) != 0
        || lws_finalize_write_http_header(wsi, first, &at, end) != 0)
        return -1;
    visit.sends.assign(LWS_PRE, '\0');
    visit.sends += answer.body;
    lws_callback_on_writable(wsi);
    return 0;
}

int send_body(lws* wsi, Visit& visit)
{
    const std::size_t size = visit.sends.size() - LWS_PRE;
    auto* bytes = reinterpret_cast<unsigned char*>(visit.sends.data()) + LWS_PRE;
    if (lws_write(wsi, bytes, size, LWS_WRITE_HTTP_FINAL) < int(size))
        return -1;
    visit = {};
    return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

} // namespace

std::optional<Role> Server::role(lws* wsi)
{
    const std::string cookies = header(wsi, WSI_TOKEN_HTTP_COOKIE);
    return logins_.role_of(token_of(cookies), std::chrono::steady_clock::now());
}

/// The answer to a request that comes from another page, or under another name: a stranger's page can make a visitor's
/// browser send one.
std::optional<HttpAnswer> Server::refused(lws* wsi, bool changes) const
{
    const std::string host = header(wsi, WSI_TOKEN_HOST), origin = header(wsi, WSI_TOKEN_ORIGIN);
    if (!host_is_listed(host, options_.settings))
        return HttpAnswer{.status = 421, .body = "This name is not on the list of hosts in the exhibit's file.\n"};
    if ((changes || !origin.empty()) && !origin_is_of(origin, host, !options_.settings.certificate.empty()))
        return HttpAnswer{.status = 403, .body = "The request comes from another page.\n"};
    return std::nullopt;
}

HttpAnswer Server::get(lws* wsi, const std::string& path)
{
    if (const auto file = files_.find(path); file != files_.end())
        return file->second;
    const std::optional<Role> role = this->role(wsi);
    if (path == "/lists" && role)
        return {.type = "application/json",
            .body = lists_text(options_.patterns, *role >= Role::docent ? options_.programme : std::nullopt)};
    if (path == "/metrics") {
        const std::string peer = plain_address(peer_of(wsi));
        if (peer.starts_with("127.") || peer == "::1" || role == Role::engineer)
            return {.type = "text/plain; version=0.0.4; charset=utf-8", .body = metrics()};
    }
    if (path.starts_with(thumbnails) && role)
        return thumbnail(path.substr(thumbnails.size()));
    if (path == "/lists" || path == "/metrics" || path.starts_with(thumbnails))
        return {.status = role ? 403u : 401u, .body = "A login is missing, or it is for another role.\n"};
    return {.status = 404, .body = "There is no such page.\n"};
}

/// The small picture of such a name; the file may have come since the start.
HttpAnswer Server::thumbnail(const std::string& name) const
{
    constexpr std::size_t most_bytes = 1 << 18;
    try {
        if (const auto file = options_.thumbnails.find(name); file != options_.thumbnails.end())
            return {.type = "image/png", .body = read_whole(file->second, most_bytes, "a small picture")};
    } catch (const InputError&) { // none is drawn yet
    }
    return {.status = 404, .body = "There is no such picture; starbow render --thumbnails draws all.\n"};
}

HttpAnswer Server::log_in(lws* wsi, const std::string& body)
{
    const std::string peer = plain_address(peer_of(wsi));
    const Logins::Time now = std::chrono::steady_clock::now();
    try {
        const Logins::Attempt attempt = logins_.attempt(origin_of(lws_get_socket_fd(wsi)), pin_of(body), now);
        log_lock(attempt, peer);
        if (attempt.answer == Logins::Answer::right) {
            write_log(LogKind::login, std::string(role_names[std::size_t(attempt.role)]) + " logs in at " + peer);
            logins_.keep(kept_, now);
            const bool tls = !options_.settings.certificate.empty();
            return {.type = "application/json",
                .body = std::string("{\"role\":\"") + role_names[std::size_t(attempt.role)] + "\"}",
                .cookie = "starbow=" + attempt.token + "; Path=/; Max-Age=43200; HttpOnly; SameSite=Strict"
                    + (tls ? "; Secure" : "")};
        }
        ++wrong_pins_;
        if (attempt.answer == Logins::Answer::wrong)
            return {.status = 401, .type = "application/json", .body = "{\"wrong\":true}"};
        return {.status = 429,
            .type = "application/json",
            .body = "{\"locked_s\":" + std::to_string(attempt.left.count()) + "}"};
    } catch (const InputError& error) {
        return {.status = 400, .body = std::string(error.what()) + "\n"};
    }
}

void Server::log_lock(const Logins::Attempt& attempt, const std::string& peer)
{
    const std::string time
        = std::to_string(std::chrono::duration_cast<std::chrono::minutes>(attempt.length).count()) + " minutes";
    if (attempt.begins == Logins::Lock::address)
        write_log(LogKind::login_locked, "five wrong PINs at " + peer + ": logins from there are refused for " + time);
    if (attempt.begins == Logins::Lock::strangers)
        write_log(LogKind::login_locked,
            "wrong PINs at " + std::to_string(Logins::most_doubtful) + " addresses, the last of them " + peer + ": for "
                + time + " logins are refused but from this machine and from addresses that have logged in within a day");
}

/// This machine's own connections are counted by themselves: neither its programs nor anybody else can shut the other out.
/// Of the others some are left for those that have logged in lately, whoever else comes.
bool Server::is_full(const Origin& from) const
{
    const auto count = [&](const auto& counts) { return std::size_t(std::ranges::count_if(connections_, counts)); };
    const std::size_t here = count([](const auto& one) { return one.second.here; });
    if (from.here)
        return here >= most_connections_here;
    constexpr std::size_t kept = 32, most_of_one = 32;
    const std::size_t others = connections_.size() - here,
                      of_one = count([&](const auto&one) { return one.second.address == from.address; });
    const bool trusted = others < most_connections - kept || logins_.trusts(from, std::chrono::steady_clock::now());
    return others >= most_connections || of_one >= most_of_one || !trusted;
}

HttpAnswer Server::log_out(lws* wsi)
{
    const std::string token(token_of(header(wsi, WSI_TOKEN_HTTP_COOKIE)));
    logins_.log_out(token);
    logins_.keep(kept_, std::chrono::steady_clock::now());
    for (Client& client : clients_)
        if (client.token == token)
            end(client);
    return {.body = "Logged out.\n", .cookie = "starbow=; Path=/; Max-Age=0; HttpOnly; SameSite=Strict"};
}

std::string Server::metrics()
{
    exchange_.conditions.refresh();
    Exposition out(exchange_.conditions.newest().metrics);
    out.one("remote_connections", "gauge", "Open connections of the remote.", double(connections_.size()));
    out.one("remote_pages", "gauge", "Open pages that are logged in.", double(clients_.size()));
    out.one("remote_commands_total", "counter", "Commands that were handed to the exhibit.", double(last_number_));
    out.one("remote_refused_commands_total", "counter", "Commands for which the exhibit had no room.",
        double(refused_commands_));
    out.one("remote_refused_datagrams_total", "counter", "OSC datagrams that were damaged, unknown or from a stranger.",
        double(refused_datagrams_));
    out.one("remote_wrong_pins_total", "counter", "Wrong or locked PINs.", double(wrong_pins_));
    return out.text;
}

int Server::http(lws* wsi, lws_callback_reasons reason, void* room, void* in, std::size_t size)
{
    switch (reason) {
    case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
        return is_full(origin_of(int(reinterpret_cast<std::intptr_t>(in)))) ? 1 : 0;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
        connections_[wsi] = origin_of(lws_get_socket_fd(wsi));
        return 0;
    case LWS_CALLBACK_WSI_DESTROY:
        connections_.erase(wsi);
        return 0;
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE: {
        const std::optional<HttpAnswer> no = refused(wsi, true);
        if (!no && role(wsi))
            return 0;
        return lws_return_http_status(wsi, no ? no->status : 401, "No.") != 0 ? -1 : 1;
    }
    case LWS_CALLBACK_HTTP: {
        if (!visit_at(room))
            visit_at(room) = new Visit;
        Visit& visit = *visit_at(room);
        visit = {.path = std::string(static_cast<const char*>(in), size)};
        const bool gets = lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) > 0;
        const bool posts = lws_hdr_total_length(wsi, WSI_TOKEN_POST_URI) > 0;
        if (const auto no = refused(wsi, posts))
            return begin(wsi, visit, *no);
        if (gets)
            return begin(wsi, visit, get(wsi, visit.path));
        if (posts && visit.path == "/logout")
            return begin(wsi, visit, log_out(wsi));
        return posts && visit.path == "/login" ? 0 : begin(wsi, visit, {.status = 405, .body = "No.\n"});
    }
    case LWS_CALLBACK_HTTP_BODY:
        if (!visit_at(room) || visit_at(room)->received.size() + size > most_message_bytes)
            return -1;
        visit_at(room)->received.append(static_cast<const char*>(in), size);
        return 0;
    case LWS_CALLBACK_HTTP_BODY_COMPLETION:
        if (!visit_at(room) || visit_at(room)->path != "/login" || !visit_at(room)->sends.empty())
            return visit_at(room) ? 0 : -1;
        return begin(wsi, *visit_at(room), log_in(wsi, visit_at(room)->received));
    case LWS_CALLBACK_HTTP_WRITEABLE:
        return !visit_at(room) || visit_at(room)->sends.empty() ? 0 : send_body(wsi, *visit_at(room));
    case LWS_CALLBACK_HTTP_DROP_PROTOCOL:
    case LWS_CALLBACK_CLOSED_HTTP:
        if (room)
            delete std::exchange(visit_at(room), nullptr);
        return 0;
    default:
        return 0;
    }
}

} // namespace starbow
