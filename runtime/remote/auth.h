#pragma once
#include "config/model/remote_file.h"
#include "input/command.h"
#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// The PINs of look, docent and engineer; empty: nobody may log in for this role.
using Pins = std::array<std::string, 3>;

constexpr std::array<const char*, 3> role_names = {"look", "docent", "engineer"};

/// Reads lines such as "docent 123456"; # begins a comment. Throws InputError, also where others than the file's user and
/// group may read it, or where two roles have one PIN.
Pins read_pins(const std::filesystem::path& file);
/// Three different PINs of the system's random numbers.
Pins draw_pins();

/// Compares in a time that depends on the lengths alone.
bool same_secret(std::string_view a, std::string_view b);

/// Where a PIN was typed.
struct Origin {
    std::string address; ///< as it is counted
    bool here = false; ///< at this machine itself
};

/// Who is logged in. Times are arguments, so that a test has its own clock.
class Logins {
public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr int most_wrong = 5; ///< PINs from one address
    static constexpr std::chrono::minutes lock{5}; ///< the first one; each further one within a day is twice as long
    static constexpr int most_doublings = 6;
    static constexpr std::chrono::hours memory{24}; ///< of locks, and of addresses that have logged in
    static constexpr std::size_t most_doubtful = 16; ///< addresses with wrong PINs; beyond, all strangers are locked out
    static constexpr std::size_t most_known = 256; ///< addresses that are remembered
    static constexpr std::size_t most_tokens = 256;
    static constexpr std::chrono::hours lifetime{12}; ///< of a token that is not used

    explicit Logins(Pins pins)
        : pins_(std::move(pins))
    {
    }

    enum class Answer { right, wrong, locked };
    /// Whom a lock that begins with an attempt shuts out.
    enum class Lock { none, address, strangers };
    struct Attempt {
        Answer answer = Answer::wrong;
        Role role = Role::look;
        std::string token; ///< 32 hexadecimal digits, 128 bits of the system's random numbers
        std::chrono::seconds left{0}; ///< of the lock
        Lock begins = Lock::none;
        std::chrono::seconds length{0}; ///< of the lock that begins
    };
    /// One PIN typed at an address. While an address is locked no PIN is right there. Many addresses with wrong PINs lock
    /// out strangers, but neither this machine nor addresses that have logged in within a day.
    Attempt attempt(const Origin& from, std::string_view pin, Time now);
    /// True for this machine, and for an address that has logged in within a day.
    bool trusts(const Origin& from, Time now) const;
    /// The role of a token, which counts as its use.
    std::optional<Role> role_of(std::string_view token, Time now);
    void log_out(std::string_view token);

    // Tokens outlast a restart of the program: a file that its user alone may read. Each is kept with its PIN, so that a new
    // PIN ends it. Nothing is thrown: without the file people log in again.
    void keep(const std::filesystem::path& file, Time now) const;
    void restore(const std::filesystem::path& file, Time now);

private:
    /// A lock that grows each time that it begins.
    struct Growing {
        int rounds = 0;
        Time until{}, last{}; ///< its end; the last beginning

        bool holds(Time now) const { return now < until; }
        /// Begins, and returns how long it lasts.
        std::chrono::seconds begin(Time now);
    };
    struct FailedLogins {
        int wrong = 0;
        Time until{}; ///< the wrong PINs are forgotten
        Growing lock{};
    };
    void forget_old(Time now);
    std::size_t doubtful(Time now) const;

    struct Token {
        std::string text;
        Role role;
        Time until;
    };
    Pins pins_;
    std::map<std::string, FailedLogins> doubts_; ///< by address
    std::map<std::string, Time> known_; ///< addresses that have logged in, and when
    Growing strangers_; ///< the lock of all strangers
    std::vector<Token> tokens_; ///< the oldest first
};

/// At most `per_s` messages a second, and as many at once.
class Rate {
public:
    explicit Rate(double per_s)
        : per_s_(per_s)
        , left_(per_s)
    {
    }
    /// Returns false where a message is one too many.
    bool take(Logins::Time now);

private:
    double per_s_, left_;
    std::optional<Logins::Time> last_;
};

} // namespace starbow
