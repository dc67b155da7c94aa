#pragma once
#include "auth.h"
#include "config/model/awaited.h"
#include "exchange.h"
#include <deque>
#include <libwebsockets.h>
#include <list>
#include <map>
#include <memory>

namespace starbow {

/// The most connections at a time, from other machines and from this one.
constexpr std::size_t most_connections = 256, most_connections_here = 255;

/// The answer to one request of a browser.
struct HttpAnswer {
    unsigned status = 200;
    const char* type = "text/plain; charset=utf-8";
    std::string body{};
    std::string cookie{}; ///< of a Set-Cookie header; empty: none
};

/// One open page, or one `starbow tell`.
struct Client {
    lws* wsi;
    std::string token, address;
    Role role;
    Rate rate;
    std::string partial{}; ///< the message that is still arriving
    std::deque<std::string> answers{};
    bool picture = false, closes = false;
    // The serial numbers of what was sent last.
    std::uint64_t status = 0, log = 0, picture_sent = 0;
};

/// One message to many pages, with room before it for what libwebsockets writes there.
class Broadcast {
public:
    void set(std::string_view message); ///< a new message, with the next serial, unless it is the same
    std::uint64_t serial() const { return serial_; }
    std::string_view message() const { return std::string_view(padded_).substr(padded_.empty() ? 0 : LWS_PRE); }

private:
    std::string padded_;
    std::uint64_t serial_ = 0;
};

/// The remote's sockets and all that is behind them, on the thread that calls serve().
class Server {
public:
    /// Opens the sockets, or waits for their addresses and ports. Throws InputError for a wrong file.
    Server(const RemoteOptions& options, const Pins& pins, Exchange& exchange);
    ~Server();
    Server(const Server&) = delete;

    void serve(); ///< until exchange.ends
    void wake(); ///< makes serve() look at exchange.ends; from any thread
    const std::string& page() const { return page_; }

    // Called by libwebsockets.
    int http(lws* wsi, lws_callback_reasons reason, void* visit, void* in, std::size_t size);
    int socket(lws* wsi, lws_callback_reasons reason, void* visit, void* in, std::size_t size);
    int datagrams(lws_callback_reasons reason);
    void tick();

private:
    struct Tick {
        lws_sorted_usec_list_t list;
        Server* server;
    };
    struct Pending {
        Client* client; ///< null: OSC, or the page has gone
        int id;
        std::string words;
        Logins::Time since;
    };

    void load_files();
    lws_vhost* make_vhost(int port, const char* interface);
    /// Tries what is not open yet.
    void open();
    void open_page(Logins::Time now);
    void open_osc(Logins::Time now);
    /// Counts a datagram that is left out; one line in a while says why.
    void refuse_osc(const std::string& who, const std::string& why);
    std::optional<HttpAnswer> refused(lws* wsi, bool socket) const;
    HttpAnswer get(lws* wsi, const std::string& path);
    HttpAnswer thumbnail(const std::string& name) const;
    HttpAnswer log_in(lws* wsi, const std::string& body);
    HttpAnswer log_out(lws* wsi);
    std::string metrics();
    std::optional<Role> role(lws* wsi);
    /// True where one more connection from there is too many.
    bool is_full(const Origin& from) const;
    void log_lock(const Logins::Attempt& attempt, const std::string& peer);
    int receive(Client& client, std::string_view part, bool whole);
    void handle(Client& client, std::string_view message);
    /// Puts a command into the mailbox. Returns a refusal, or "".
    std::string put(const Command& command, Role role, const std::string& who, Client* client, int id);
    /// The most urgent broadcast that a page has not got yet, and where its serial is noted; null: none.
    struct DueBroadcast {
        const Broadcast* broadcast = nullptr;
        std::uint64_t* sent = nullptr;
        lws_write_protocol kind = LWS_WRITE_TEXT;
        explicit operator bool() const { return broadcast; }
    };
    DueBroadcast due(Client& client);
    int send_next(Client& client);
    void say(Client& client, const std::string& text);
    void hand_out_replies();
    void end(Client& client);
    void schedule();
    void take_news();

    RemoteOptions options_;
    Exchange& exchange_;
    Logins logins_;
    std::filesystem::path kept_; ///< the file of tokens; empty: none
    std::string page_;
    std::map<std::string, HttpAnswer> files_; ///< by path
    lws_context* context_ = nullptr;
    lws_vhost* vhost_ = nullptr; ///< that listens to nothing: of the descriptors of OSC
    Awaited page_port_, osc_port_;
    std::string lack_; ///< as published
    Tick tick_{};
    int osc_ = -1;
    std::map<lws*, Origin> connections_;
    std::list<Client> clients_;
    std::map<std::uint64_t, Pending> pending_; ///< by the command's number
    std::uint64_t last_number_ = 0, ticks_ = 0;
    Logins::Time osc_said_{}; ///< the last line about a refused datagram
    std::uint64_t osc_unsaid_ = 0; ///< those since
    std::uint64_t refused_commands_ = 0, refused_datagrams_ = 0, wrong_pins_ = 0; // for metrics
    Broadcast status_, engineer_status_, log_, picture_;
};

} // namespace starbow
