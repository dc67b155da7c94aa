#include "tell.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "input/command.h"
#include "messages.h"
#include <array>
#include <libwebsockets.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace starbow {
namespace {

using ordered_json = nlohmann::ordered_json;

constexpr std::size_t most_received = 1 << 20;
constexpr double connect_s = 10; ///< for a connection and a login

/// One connection after the other: POST /login, then the WebSocket.
struct Telling {
    const TellOptions& options;
    std::string sends; ///< the message to the exhibit; empty: its state is wanted
    std::string body, partial{}, cookie{};
    unsigned login = 0; ///< the login's status; 0: none yet
    bool login_ended = false, closed = false, opened = false, sent = false;
    std::string failure{};
    std::optional<ordered_json> answer{}, status{};
};

std::string authority(const TellOptions& options)
{
    return (options.host.find(':') == std::string::npos ? options.host : "[" + options.host + "]") + ":"
        + std::to_string(options.port);
}

/// Adds Origin and one header more to a request that libwebsockets writes at `at`, with `room` left. Its own Origin says
/// http where it is https.
int add_lines(const TellOptions& options, void* at, std::size_t room, const std::string& header)
{
    const std::string line = "origin: " + std::string(options.certificate.empty() ? "http://" : "https://")
        + authority(options) + "\r\n" + header + "\r\n";
    auto** to = static_cast<char**>(at);
    if (line.size() >= room)
        return -1;
    *to = std::copy(line.begin(), line.end(), *to);
    return 0;
}

int write(lws* wsi, const std::string& text, lws_write_protocol kind)
{
    std::string padded(LWS_PRE, '\0');
    padded += text;
    return lws_write(wsi, reinterpret_cast<unsigned char*>(padded.data()) + LWS_PRE, text.size(), kind) < int(text.size())
        ? -1
        : 0;
}

Telling& telling_of(lws* wsi) { return *static_cast<Telling*>(lws_context_user(lws_get_context(wsi))); }

int on_login(lws* wsi, lws_callback_reasons reason, void*, void* in, std::size_t size)
{
    switch (reason) {
    case LWS_CALLBACK_CLIENT_APPEND_HANDSHAKE_HEADER: {
        Telling& telling = telling_of(wsi);
        lws_client_http_body_pending(wsi, 1);
        lws_callback_on_writable(wsi);
        return add_lines(telling.options, in, size, "content-length: " + std::to_string(telling.body.size()));
    }
    case LWS_CALLBACK_CLIENT_HTTP_WRITEABLE:
        lws_client_http_body_pending(wsi, 0);
        return write(wsi, telling_of(wsi).body, LWS_WRITE_HTTP_FINAL);
    case LWS_CALLBACK_ESTABLISHED_CLIENT_HTTP: {
        std::array<char, 512> cookie{};
        telling_of(wsi).login = lws_http_client_http_response(wsi);
        if (lws_hdr_copy(wsi, cookie.data(), int(cookie.size()), WSI_TOKEN_HTTP_SET_COOKIE) > 0)
            telling_of(wsi).cookie = std::string(cookie.data()).substr(0, std::string_view(cookie.data()).find(';'));
        return 0;
    }
    case LWS_CALLBACK_RECEIVE_CLIENT_HTTP: {
        std::array<char, LWS_PRE + 1024> bytes;
        char* at = bytes.data() + LWS_PRE;
        int room = 1024;
        return lws_http_client_read(wsi, &at, &room) < 0 ? -1 : 0;
    }
    case LWS_CALLBACK_RECEIVE_CLIENT_HTTP_READ:
        if (telling_of(wsi).partial.size() + size < most_received)
            telling_of(wsi).partial.append(static_cast<const char*>(in), size);
        return 0;
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
        telling_of(wsi).failure = in ? std::string(static_cast<const char*>(in), size) : "no connection";
        return 0;
    case LWS_CALLBACK_COMPLETED_CLIENT_HTTP:
    case LWS_CALLBACK_CLOSED_CLIENT_HTTP:
        telling_of(wsi).login_ended = true;
        return 0;
    default:
        return 0;
    }
}

void read_message(Telling& telling)
{
    const ordered_json message = ordered_json::parse(telling.partial, nullptr, false);
    telling.partial.clear();
    if (message.is_object() && message.contains("answer"))
        telling.answer = message["answer"];
    if (message.is_object() && message.contains("status"))
        telling.status = message["status"];
}

int on_socket_of_tell(lws* wsi, lws_callback_reasons reason, void*, void* in, std::size_t size)
{
    switch (reason) {
    case LWS_CALLBACK_CLIENT_APPEND_HANDSHAKE_HEADER:
        return add_lines(telling_of(wsi).options, in, size, "cookie: " + telling_of(wsi).cookie);
    case LWS_CALLBACK_CLIENT_ESTABLISHED:
        telling_of(wsi).opened = true;
        lws_callback_on_writable(wsi);
        return 0;
    case LWS_CALLBACK_CLIENT_WRITEABLE: {
        Telling& telling = telling_of(wsi);
        if (telling.sends.empty() || std::exchange(telling.sent, true))
            return 0;
        return write(wsi, telling.sends, LWS_WRITE_TEXT);
    }
    case LWS_CALLBACK_CLIENT_RECEIVE: {
        Telling& telling = telling_of(wsi);
        telling.partial.append(static_cast<const char*>(in), size);
        if (telling.partial.size() > most_received)
            return -1;
        if (lws_is_final_fragment(wsi) && lws_remaining_packet_payload(wsi) == 0)
            read_message(telling);
        return 0;
    }
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
        telling_of(wsi).failure = in ? std::string(static_cast<const char*>(in), size) : "no connection";
        return 0;
    case LWS_CALLBACK_CLIENT_CLOSED:
        telling_of(wsi).closed = true;
        return 0;
    default:
        return 0;
    }
}

struct FreeContext {
    void operator()(lws_context* context) const { lws_context_destroy(context); }
};
using Context = std::unique_ptr<lws_context, FreeContext>;

Context open_context(Telling& telling)
{
    static const std::array protocols{lws_protocols{"login", on_login, 0, 4096, 0, nullptr, 0},
        lws_protocols{"starbow", on_socket_of_tell, 0, 4096, 0, nullptr, 0}, lws_protocols{}};
    lws_set_log_level(0, nullptr);
    lws_context_creation_info info{};
    const std::string certificate = telling.options.certificate.string();
    info.port = CONTEXT_PORT_NO_LISTEN;
    info.protocols = protocols.data();
    info.user = &telling;
    info.fd_limit_per_thread = 32;
    info.alpn = "http/1.1";
    if (!certificate.empty()) {
        info.options = LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT | LWS_SERVER_OPTION_DISABLE_OS_CA_CERTS;
        info.client_ssl_ca_filepath = certificate.c_str();
    }
    Context context(lws_create_context(&info));
    if (!context)
        throw InputError((certificate.empty() ? "the network" : certificate)
            + " can't be used; a PEM file of the exhibit's "
              "certificate is right");
    return context;
}

/// Begins a connection; method: null for the WebSocket.
void connect(const Context& context, const Telling& telling, const char* method)
{
    const std::string host = authority(telling.options);
    lws_client_connect_info info{};
    info.context = context.get();
    info.address = telling.options.host.c_str();
    info.port = telling.options.port;
    info.host = host.c_str();
    info.path = method ? "/login" : "/";
    info.method = method;
    info.alpn = "http/1.1";
    info.protocol = method ? nullptr : "starbow";
    info.local_protocol_name = method ? "login" : "starbow";
    // The one certificate that is trusted is the exhibit's own, whatever name it is reached by.
    info.ssl_connection = LCCSCF_HTTP_NO_FOLLOW_REDIRECT
        | (telling.options.certificate.empty() ? 0 : LCCSCF_USE_SSL | LCCSCF_SKIP_SERVER_CERT_HOSTNAME_CHECK);
    if (!lws_client_connect_via_info(&info))
        throw InputError("no exhibit answers at " + host + "; the port of \"remote\" in the exhibit's file is right");
}

/// Serves until `done`, a failure or the time's end.
template <class Done> bool serve_until(const Context& context, Telling& telling, double seconds, Done done)
{
    lws_sorted_usec_list_t end{};
    bool late = false;
    struct End {
        lws_sorted_usec_list_t list;
        bool* late;
    } timer{end, &late};
    lws_sul_schedule(
        context.get(), 0, &timer.list, [](lws_sorted_usec_list_t* list) { *reinterpret_cast<End*>(list)->late = true; },
        lws_usec_t(seconds * 1e6));
    while (!late && !done() && telling.failure.empty() && lws_service(context.get(), 0) >= 0) { }
    lws_sul_cancel(&timer.list);
    return done();
}

void log_in(const Context& context, Telling& telling)
{
    connect(context, telling, "POST");
    serve_until(context, telling, connect_s, [&] { return telling.login && telling.login_ended; });
    const std::string where = authority(telling.options);
    if (telling.login == 429)
        throw InputError("the exhibit at " + where + " refuses logins after wrong PINs; one in five minutes is right");
    if (telling.login == 401)
        throw InputError("the PIN is wrong at " + where + "; one of the exhibit's file of PINs is right");
    if (telling.login == 421)
        throw InputError(
            "the exhibit does not know the name " + telling.options.host + "; one of \"hosts\" in its file is right");
    if (telling.login != 200 || telling.cookie.empty())
        throw InputError("no exhibit answers at " + where
            + (telling.login                  ? " (HTTP status " + std::to_string(telling.login) + ")"
                    : telling.failure.empty() ? ""
                                              : " (" + one_line(telling.failure) + ")")
            + "; its host, its port and, where it has one, its certificate is right");
    telling.partial.clear();
}

void converse(Telling& telling)
{
    const Context context = open_context(telling);
    telling.body = ordered_json{{"pin", telling.options.pin}}.dump();
    log_in(context, telling);
    connect(context, telling, nullptr);
    serve_until(context, telling, telling.options.wait_s,
        [&] { return telling.closed || (telling.sends.empty() ? bool(telling.status) : bool(telling.answer)); });
}

} // namespace

void tell(const TellOptions& options, const std::vector<std::string>& words)
{
    const Command command = command_of(words);
    Telling telling{.options = options, .sends = ordered_json{{"id", 1}, {"command", words_of(command)}}.dump(), .body = {}};
    converse(telling);
    const bool ends
        = command.kind == CommandKind::restart && telling.sent && telling.closed; // the exhibit has gone to restart
    if (!telling.answer && !ends)
        throw InputError(telling.closed ? "the exhibit has ended the connection before its answer; a running one is right"
                : !telling.opened       ? "the exhibit refuses the connection (" + one_line(telling.failure)
                    + "); a name of its list of hosts is right"
                                  : "the exhibit has not applied the command within " + shown(options.wait_s)
                    + " s; a longer --wait is right where it loads a large world");
    if (telling.answer && !telling.answer->value("applied", false))
        throw InputError(
            "the exhibit refuses the command: " + one_line(telling.answer->value("refused", "without a reason")));
}

std::string state_of_exhibit(const TellOptions& options)
{
    Telling telling{.options = options, .sends = {}, .body = {}};
    converse(telling);
    if (!telling.status || !telling.status->is_object())
        throw InputError("the exhibit shows no state; one that draws pictures is right");
    std::string lines;
    for (const auto& [name, value] : telling.status->items()) {
        const std::string text = value.is_boolean() ? (value.get<bool>() ? "on" : "off")
            : value.is_string()                     ? value.get<std::string>()
            : value.is_number_float()               ? shown(value.get<double>())
                                                    : value.dump();
        lines += one_line(name, 40) + ": " + one_line(text.empty() ? "-" : text) + "\n";
    }
    return lines;
}

} // namespace starbow
