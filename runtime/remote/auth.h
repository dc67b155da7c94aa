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

/// Who is logged in. Times are arguments, so that a test has its own clock.
class Logins {
public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr int most_wrong = 5; ///< PINs from one address
    static constexpr std::chrono::minutes lock{5};
    static constexpr std::size_t most_doubtful = 16; ///< addresses with wrong PINs; beyond, all others are locked out too
    static constexpr std::size_t most_tokens = 256;
    static constexpr std::chrono::hours lifetime{12}; ///< of a token that is not used

    explicit Logins(Pins pins)
        : pins_(std::move(pins))
    {
    }

    enum class Answer { right, wrong, locked };
    struct Attempt {
        Answer answer = Answer::wrong;
        Role role = Role::look;
        std::string token; ///< 32 hexadecimal digits, 128 bits of the system's random numbers
        std::chrono::seconds left{0}; ///< of the lock
    };
    /// One PIN typed at an address. While an address is locked no PIN is right there.
    Attempt attempt(const std::string& address, std::string_view pin, Time now);
    /// The role of a token, which counts as its use.
    std::optional<Role> role_of(std::string_view token, Time now);
    void log_out(std::string_view token);

    // Tokens outlast a restart of the program: a file that its user alone may read. Each is kept with its PIN, so that a new
    // PIN ends it. Nothing is thrown: without the file people log in again.
    void keep(const std::filesystem::path& file, Time now) const;
    void restore(const std::filesystem::path& file, Time now);

private:
    struct Doubt {
        int wrong = 0;
        Time until; ///< the lock's end, or when the wrong PINs are forgotten
    };
    struct Token {
        std::string text;
        Role role;
        Time until;
    };
    Pins pins_;
    std::map<std::string, Doubt> doubts_; ///< by address
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
