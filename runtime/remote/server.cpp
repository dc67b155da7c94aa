// The sockets' set-up, and the clock that looks at what the frame thread has published. http.cpp and pages.cpp are the rest.
#include "server.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "live_picture.h"
#include "messages.h"
#include "runtime/operation/log.h"
#include "runtime/operation/state_folder.h"
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace starbow {
namespace {

constexpr lws_usec_t tick_us = 100000; ///< of the status: ten a second
constexpr unsigned ticks_of_login = 50; ///< between two looks whether a page's token is still valid
constexpr std::chrono::seconds most_wait{120}; ///< for an answer of the frame thread
constexpr std::size_t most_page_bytes = 1 << 20; ///< of each file of the page, and of a certificate
/// Descriptors of the context: the connections, and the server's own.
constexpr unsigned most_files = most_connections + most_connections_here + 44;

/// The last error that libwebsockets spoke of, for the message of a start that fails. Its own lines are for debugging: a
/// stranger's damaged requests must not fill the log.
std::string last_library_error;

void library_speaks(int level, const char* line)
{
    std::string text = line;
    while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
        text.pop_back();
    if (level == LLL_ERR)
        last_library_error = text;
    write_log(LogKind::remote_library, text);
}

Server& server_of(lws* wsi) { return *static_cast<Server*>(lws_context_user(lws_get_context(wsi))); }

int on_http(lws* wsi, lws_callback_reasons reason, void* visit, void* in, std::size_t size)
{
    return server_of(wsi).http(wsi, reason, visit, in, size);
}
int on_socket(lws* wsi, lws_callback_reasons reason, void* client, void* in, std::size_t size)
{
    return server_of(wsi).socket(wsi, reason, client, in, size);
}
int on_datagrams(lws* wsi, lws_callback_reasons reason, void*, void*, std::size_t)
{
    return server_of(wsi).datagrams(reason);
}

constexpr std::size_t pointer = sizeof(void*);
const std::array protocols{lws_protocols{"http", on_http, pointer, most_message_bytes, 0, nullptr, 0},
    lws_protocols{"starbow", on_socket, pointer, most_message_bytes, 0, nullptr, 0},
    lws_protocols{"osc", on_datagrams, 0, 0, 0, nullptr, 0}, lws_protocols{}};

/// Headers of every answer, a list whose entries name the next one. The page's own files alone are loaded, and no other page
/// may show or read them.
using Header = lws_protocol_vhost_options;
const Header no_store{nullptr, nullptr, "cache-control:", "no-store"},
    own_opener{&no_store, nullptr, "cross-origin-opener-policy:", "same-origin"},
    own_resources{&own_opener, nullptr, "cross-origin-resource-policy:", "same-origin"},
    no_referrer{&own_resources, nullptr, "referrer-policy:", "no-referrer"},
    named_types{&no_referrer, nullptr, "x-content-type-options:", "nosniff"},
    safe_headers{&named_types, nullptr, "content-security-policy:",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; form-action 'none'; "
        "frame-ancestors 'none'; base-uri 'none'"};

/// A page that does not answer for half a minute has gone.
const lws_retry_bo_t idle{.secs_since_valid_ping = 15, .secs_since_valid_hangup = 30};

bool is_loopback(const std::string& address) { return address.starts_with("127.") || address == "::1"; }
bool is_any(const std::string& address) { return address == "0.0.0.0" || address == "::"; }

bool is_v6(const std::string& address) { return address.find(':') != std::string::npos; }

/// A socket that is bound to a port of an address; -1 if that is not possible, with errno.
int bound_socket(const std::string& address, int port, int type)
{
    const bool v6 = is_v6(address);
    sockaddr_in6 six{};
    sockaddr_in four{};
    six.sin6_family = AF_INET6, four.sin_family = AF_INET;
    six.sin6_port = four.sin_port = htons(std::uint16_t(port));
    inet_pton(AF_INET6, address.c_str(), &six.sin6_addr);
    inet_pton(AF_INET, address.c_str(), &four.sin_addr);
    const int made = ::socket(v6 ? AF_INET6 : AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (made < 0)
        return -1;
    const int on = 1;
    if (type == SOCK_STREAM) // as libwebsockets does: connections of a server before may still be ending
        setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const int bound = v6 ? bind(made, reinterpret_cast<sockaddr*>(&six), sizeof six)
                         : bind(made, reinterpret_cast<sockaddr*>(&four), sizeof four);
    if (bound == 0)
        return made;
    const int why = errno;
    close(made);
    errno = why;
    return -1;
}

/// True where a port of an address can be listened to; false with errno. libwebsockets 4.3 tries without end to open a port
/// of an address that the machine does not have, so this comes before it.
bool can_listen(const std::string& address, int port)
{
    const int probe = bound_socket(address, port, SOCK_STREAM);
    if (probe < 0)
        return false;
    const bool listens = listen(probe, 1) == 0;
    const int why = errno;
    close(probe);
    errno = why;
    return listens;
}

/// Logs a key that others than its user and group may read. The remote opens all the same: its PINs still go encrypted over
/// the network, and a museum that has had such a key for years must not be without its remote after an update.
void warn_of_open_key(const std::filesystem::path& key)
{
    struct stat about { };
    if (key.empty() || stat(key.c_str(), &about) != 0 || !(about.st_mode & 07))
        return;
    std::array<char, 16> rights{};
    std::snprintf(rights.data(), rights.size(), "%o", unsigned(about.st_mode & 0777));
    write_log(LogKind::remote_key_open,
        key.string() + " has the rights " + rights.data()
            + ", which let every user of this machine read the key; 640 is right");
}

/// A place for the log.
std::string place_of(const char* what, int port, const std::string& address)
{
    return what + std::to_string(port) + " of " + address;
}

void require_readable(const std::filesystem::path& file)
{
    if (!file.empty())
        read_whole(file, most_page_bytes, "a PEM file that the exhibit's user may read");
}

} // namespace

void Broadcast::set(std::string_view text)
{
    if (serial_ > 0 && text == message())
        return;
    padded_.assign(LWS_PRE, '\0');
    padded_ += text;
    ++serial_;
}

Server::Server(const RemoteOptions& options, const Pins& pins, Exchange& exchange)
    : options_(options)
    , exchange_(exchange)
    , logins_(pins)
    , page_port_(place_of("the remote's port ", options.settings.port, options.settings.address), write_log)
    , osc_port_(place_of("OSC's UDP port ", options.settings.osc.port, options.settings.address), write_log)
{
    const RemoteSettings& settings = options_.settings;
    load_files();
    if (const std::filesystem::path folder = state_folder(); !folder.empty())
        kept_ = folder / "remote-logins";
    logins_.restore(kept_, std::chrono::steady_clock::now());

    require_readable(settings.certificate);
    require_readable(settings.key);
    warn_of_open_key(settings.key);
    lws_set_log_level(LLL_ERR | LLL_WARN, library_speaks);
    lws_context_creation_info info{};
    const bool tls = !settings.certificate.empty(), v6 = is_v6(settings.address);
    info.user = this;
    info.fd_limit_per_thread = most_files;
    info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | (tls ? LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT : 0)
        | (v6 ? 0 : LWS_SERVER_OPTION_DISABLE_IPV6);
    last_library_error.clear();
    context_ = lws_create_context(&info);
    vhost_ = context_ ? make_vhost(CONTEXT_PORT_NO_LISTEN_SERVER, nullptr) : nullptr; // reads the certificate, too
    if (!vhost_) {
        if (context_)
            lws_context_destroy(context_);
        throw InputError("The remote can't be opened at port " + std::to_string(settings.port) + " of " + settings.address
            + " (" + last_library_error + "); a certificate with its key, if they are named, is right");
    }
    page_ = (tls ? "https://" : "http://")
        + (!settings.hosts.empty()         ? settings.hosts[0]
                : is_any(settings.address) ? "localhost"
                : v6                       ? "[" + settings.address + "]"
                                           : settings.address)
        + ":" + std::to_string(settings.port) + "/";
    if (!tls && !is_loopback(settings.address))
        write_log(LogKind::remote_unencrypted,
            "PINs and commands go over the network unencrypted at port " + std::to_string(settings.port) + " of "
                + settings.address + "; a certificate and key in the exhibit's file makes the page https");
    open();
    tick_.server = this;
    schedule();
}

/// port: a port of the remote's address, or none. Returns null where libwebsockets refuses.
lws_vhost* Server::make_vhost(int port, const char* interface)
{
    const RemoteSettings& settings = options_.settings;
    const std::string certificate = settings.certificate.string(), key = settings.key.string();
    const bool tls = !certificate.empty();
    lws_context_creation_info info{};
    info.vhost_name = port > 0 ? "page" : "own";
    info.port = port;
    info.iface = interface;
    info.protocols = protocols.data();
    info.headers = &safe_headers;
    info.server_string = "starbow";
    info.alpn = "http/1.1";
    info.keepalive_timeout = 5;
    info.timeout_secs = 10;
    info.retry_and_idle_policy = &idle;
    info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME
        | LWS_SERVER_OPTION_VALIDATE_UTF8 | (is_v6(settings.address) ? 0 : LWS_SERVER_OPTION_DISABLE_IPV6)
        | (tls ? LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT | LWS_SERVER_OPTION_DISABLE_OS_CA_CERTS : 0);
    if (tls) {
        info.ssl_cert_filepath = certificate.c_str();
        info.ssl_private_key_filepath = key.c_str();
    }
    return lws_create_vhost(context_, &info);
}

Server::~Server() { lws_context_destroy(context_); }

void Server::load_files()
{
    const std::filesystem::path folder = home() / "config" / "remote";
    for (const auto& [path, file, type] :
        {std::tuple{"/", "page.html", "text/html; charset=utf-8"}, {"/page.css", "page.css", "text/css; charset=utf-8"},
            {"/page.js", "page.js", "text/javascript; charset=utf-8"}, {"/icon.svg", "icon.svg", "image/svg+xml"}}) {
        files_[path] = {.type = type, .body = read_whole(folder / file, most_page_bytes, "the file of the package starbow")};
    }
    files_["/words"] = {.type = "application/json", .body = words_text()};
}

void Server::open()
{
    const Logins::Time now = std::chrono::steady_clock::now();
    if (page_port_.is_due(now))
        open_page(now);
    if (options_.settings.osc.port != 0 && osc_port_.is_due(now))
        open_osc(now);
    const std::string& lack = page_port_.lack().empty() ? osc_port_.lack() : page_port_.lack();
    if (std::exchange(lack_, lack) == lack)
        return;
    exchange_.lacks.next() = lack;
    exchange_.lacks.publish();
}

void Server::open_page(Logins::Time now)
{
    const RemoteSettings& settings = options_.settings;
    const char* interface = is_any(settings.address) ? nullptr : settings.address.c_str();
    last_library_error.clear();
    if (!can_listen(settings.address, settings.port))
        page_port_.fails(std::strerror(errno), now);
    else if (!make_vhost(settings.port, interface))
        page_port_.fails(last_library_error, now);
    else
        page_port_.comes();
}

void Server::open_osc(Logins::Time now)
{
    osc_ = bound_socket(options_.settings.address, options_.settings.osc.port, SOCK_DGRAM);
    if (osc_ < 0)
        return osc_port_.fails(std::strerror(errno), now);
    lws_sock_file_fd_type descriptor{};
    descriptor.filefd = osc_;
    if (lws_adopt_descriptor_vhost(vhost_, LWS_ADOPT_RAW_FILE_DESC, descriptor, "osc", nullptr))
        return osc_port_.comes();
    close(osc_);
    osc_port_.fails("the server is full", now);
}

void Server::schedule()
{
    lws_sul_schedule(
        context_, 0, &tick_.list, [](lws_sorted_usec_list_t* list) { reinterpret_cast<Tick*>(list)->server->tick(); },
        tick_us);
}

void Server::serve()
{
    while (!exchange_.ends && lws_service(context_, 0) >= 0) { }
}

void Server::wake() { lws_cancel_service(context_); }

void Server::tick()
{
    schedule();
    open();
    const Logins::Time now = std::chrono::steady_clock::now();
    hand_out_replies();
    if (!clients_.empty())
        take_news();
    const bool watched = std::ranges::any_of(clients_, &Client::picture);
    exchange_.picture_wanted.store(watched, std::memory_order_relaxed);
    if (watched && exchange_.pictures.refresh()) {
        const std::vector<unsigned char> jpeg = jpeg_of(exchange_.pictures.newest());
        if (!jpeg.empty())
            picture_.set({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
    }
    const bool checks = ++ticks_ % ticks_of_login == 0;
    for (Client& client : clients_) {
        if (checks && !logins_.role_of(client.token, now))
            client.closes = true;
        if (client.closes || due(client))
            lws_callback_on_writable(client.wsi);
    }
}

/// Takes the newest state and log. Without pages nobody takes them, so a page that comes needs them before its first
/// message.
void Server::take_news()
{
    if (exchange_.snapshots.refresh()) {
        status_.set(status_text(exchange_.snapshots.newest(), false));
        engineer_status_.set(status_text(exchange_.snapshots.newest(), true));
    }
    if (exchange_.conditions.refresh())
        log_.set(condition_text(exchange_.conditions.newest()));
}

void Server::hand_out_replies()
{
    for (Reply reply; exchange_.replies.take(reply);) {
        const auto found = pending_.find(reply.number);
        if (found == pending_.end())
            continue;
        if (!reply.refusal.empty())
            write_log(LogKind::command_refused, found->second.words + " is refused: " + reply.refusal);
        if (found->second.client)
            say(*found->second.client, answer_text(found->second.id, reply.refusal));
        pending_.erase(found);
    }
    const Logins::Time now = std::chrono::steady_clock::now();
    std::erase_if(pending_, [&](const auto& one) {
        const bool late = now - one.second.since > most_wait;
        if (late && one.second.client)
            say(*one.second.client, answer_text(one.second.id, "The exhibit has not answered for two minutes"));
        return late;
    });
}

std::string Server::put(const Command& command, Role role, const std::string& who, Client* client, int id)
{
    const CommandRule& rule = rule_of(command);
    if (role < rule.role)
        return "the command " + std::string(rule.name) + " is not for the role " + role_names[std::size_t(role)]
            + "; the role " + role_names[std::size_t(rule.role)] + " is right";
    const std::string words = text_of(command);
    if (!exchange_.commands.put({last_number_ + 1, command})) {
        ++refused_commands_;
        return "the exhibit has many commands to do already; the same one a little later is right";
    }
    pending_[++last_number_] = {client, id, words, std::chrono::steady_clock::now()};
    if (rule.value != CommandValue::place) // ten a second while a finger moves
        write_log(LogKind::command_taken, std::string(role_names[std::size_t(role)]) + " at " + who + ": " + words);
    return "";
}

void Server::refuse_osc(const std::string& who, const std::string& why)
{
    constexpr std::chrono::seconds between_lines{10};
    ++refused_datagrams_;
    const Logins::Time now = std::chrono::steady_clock::now();
    if (osc_said_ != Logins::Time{} && now - osc_said_ < between_lines) {
        ++osc_unsaid_;
        return;
    }
    osc_said_ = now;
    const std::uint64_t unsaid = std::exchange(osc_unsaid_, 0);
    write_log(LogKind::osc_refused,
        "OSC from " + who + ": " + why + (unsaid > 0 ? " (" + std::to_string(unsaid) + " before were refused, too)" : ""));
}

int Server::datagrams(lws_callback_reasons reason)
{
    if (reason != LWS_CALLBACK_RAW_RX_FILE)
        return 0;
    std::array<unsigned char, most_message_bytes + 1> bytes;
    for (int i = 0; i < 64; ++i) { // then the pages have their turn
        sockaddr_storage from{};
        socklen_t length = sizeof from;
        const ssize_t size = recvfrom(osc_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
        if (size < 0)
            return 0;
        std::array<char, INET6_ADDRSTRLEN> text{};
        const void* address = from.ss_family == AF_INET6
            ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6&>(from).sin6_addr)
            : &reinterpret_cast<const sockaddr_in&>(from).sin_addr;
        inet_ntop(from.ss_family, address, text.data(), text.size());
        const std::string who = plain_address(text.data());
        const OscSettings& osc = options_.settings.osc;
        if (std::ranges::find(osc.from, who) == osc.from.end()) {
            refuse_osc(who, "this address is not in \"from\" of the exhibit's file");
            continue;
        }
        try {
            if (std::size_t(size) > most_message_bytes)
                throw InputError(
                    "a datagram has more than " + std::to_string(most_message_bytes) + " bytes; fewer are right");
            for (const Command& command : commands_of_osc({bytes.data(), std::size_t(size)}))
                if (const std::string no = put(command, osc.engineer ? Role::engineer : Role::docent, who, nullptr, 0);
                    !no.empty())
                    throw InputError(no);
        } catch (const InputError& error) {
            refuse_osc(who, error.what());
        }
    }
    return 0;
}

} // namespace starbow
