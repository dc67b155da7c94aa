#include "auth.h"
#include "config/json/error.h"
#include "config/json/kept_file.h"
#include "config/json/whole_file.h"
#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sstream>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace starbow {
namespace {

constexpr std::size_t pin_digits = 6, most_bytes = 64 * 1024;

void draw(void* bytes, std::size_t count)
{
    for (std::size_t done = 0; done < count;) {
        const ssize_t got = getrandom(static_cast<char*>(bytes) + done, count - done, 0);
        if (got < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "getrandom");
        done += std::size_t(std::max<ssize_t>(got, 0));
    }
}

std::string draw_pin()
{
    constexpr std::uint32_t pins = 1000000, whole = UINT32_MAX / pins * pins; // so that each is equally likely
    std::uint32_t number = UINT32_MAX;
    while (number >= whole)
        draw(&number, sizeof number);
    const std::string digits = std::to_string(number % pins);
    return std::string(pin_digits - digits.size(), '0') + digits;
}

std::string draw_token()
{
    std::array<unsigned char, 16> bytes;
    draw(bytes.data(), bytes.size());
    std::string text;
    for (const unsigned char byte : bytes)
        for (const int half : {byte >> 4, byte & 15})
            text += "0123456789abcdef"[half];
    return text;
}

bool is_pin(std::string_view text)
{
    return text.size() == pin_digits && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

bool is_token(std::string_view text)
{
    return text.size() == 32
        && std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

constexpr const char* logins_kind = "logins2";

/// Throws InputError where a file has more rights than `rights`.
void check_private(const std::filesystem::path& file, mode_t rights)
{
    struct stat about { };
    if (stat(file.c_str(), &about) == 0 && (about.st_mode & 0777 & ~rights)) {
        std::ostringstream modes;
        modes << std::oct << (about.st_mode & 0777) << ", which opens it to more people than the exhibit's user and group; "
              << rights << " is right";
        throw InputError(file.string(), "", "has the rights " + modes.str());
    }
}

} // namespace

Pins read_pins(const std::filesystem::path& file)
{
    std::istringstream lines(read_whole(file, most_bytes, "a file with lines such as \"docent\" and six digits"));
    check_private(file, 0640);
    Pins pins;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::istringstream words(line.substr(0, line.find('#')));
        std::string role, pin, more;
        words >> role >> pin >> more;
        if (role.empty())
            continue;
        const auto known = std::ranges::find(role_names, role);
        // The line itself is not shown: messages go into the log, and it may hold a PIN.
        if (known == role_names.end() || !is_pin(pin) || !more.empty())
            throw InputError(file.string(), std::to_string(number),
                "the line is not a role (look, docent or engineer) with a PIN of six digits; \"docent\" and six digits is "
                "right");
        std::string& place = pins[std::size_t(known - role_names.begin())];
        if (!place.empty() || std::ranges::find(pins, pin) != pins.end())
            throw InputError(file.string(), std::to_string(number),
                "the line has a role or a PIN for the second time; a PIN of its own for each role is right");
        place = pin;
    }
    if (std::ranges::all_of(pins, &std::string::empty))
        throw InputError(file.string(), "", "has no PIN; a line such as \"docent\" and six digits is right");
    return pins;
}

Pins draw_pins()
{
    Pins pins;
    for (std::size_t i = 0; i < pins.size(); ++i)
        do
            pins[i] = draw_pin();
        while (std::find(pins.begin(), pins.begin() + std::ptrdiff_t(i), pins[i]) != pins.begin() + std::ptrdiff_t(i));
    return pins;
}

bool same_secret(std::string_view a, std::string_view b)
{
    if (a.size() != b.size())
        return false;
    volatile unsigned char difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference = (unsigned char)(difference | (a[i] ^ b[i]));
    return difference == 0;
}

std::chrono::seconds Logins::Growing::begin(Time now)
{
    if (rounds > 0 && now - last > memory)
        rounds = 0;
    const std::chrono::seconds length = lock * (1 << std::min(rounds++, most_doublings));
    until = now + length, last = now;
    return length;
}

void Logins::forget_old(Time now)
{
    for (auto& [address, doubt] : doubts_)
        if (doubt.until <= now && !doubt.lock.holds(now))
            doubt.wrong = 0;
    std::erase_if(doubts_, [&](const auto& one) {
        const FailedLogins& doubt = one.second;
        return doubt.wrong == 0 && (doubt.lock.rounds == 0 || now - doubt.lock.last > memory);
    });
    std::erase_if(known_, [&](const auto& one) { return now - one.second > memory; });
}

std::size_t Logins::doubtful(Time now) const
{
    return std::size_t(
        std::ranges::count_if(doubts_, [&](const auto& one) { return one.second.wrong > 0 || one.second.lock.holds(now); }));
}

bool Logins::trusts(const Origin& from, Time now) const
{
    const auto known = known_.find(from.address);
    return from.here || (known != known_.end() && now - known->second <= memory);
}

Logins::Attempt Logins::attempt(const Origin& from, std::string_view pin, Time now)
{
    forget_old(now);
    const auto locked = [&](Time until) {
        return Attempt{.answer = Answer::locked, .token = {}, .left = std::chrono::ceil<std::chrono::seconds>(until - now)};
    };
    const auto doubt = doubts_.find(from.address);
    if (doubt != doubts_.end() && doubt->second.lock.holds(now))
        return locked(doubt->second.lock.until);
    const bool stranger = !trusts(from, now) && (doubt == doubts_.end() || doubt->second.wrong == 0);
    if (stranger && strangers_.holds(now))
        return locked(strangers_.until);
    // All PINs are compared, so that the time does not tell which one was nearly right.
    std::optional<Role> role;
    for (std::size_t i = 0; i < pins_.size(); ++i)
        if (same_secret(pins_[i], pin) && !pins_[i].empty())
            role = Role(i);
    if (!role) {
        // A right PIN does not forgive wrong ones: whoever knows one must not guess another in between.
        FailedLogins& wrong = doubts_[from.address];
        ++wrong.wrong;
        wrong.until = now + lock;
        Attempt attempt;
        if (wrong.wrong >= most_wrong) {
            attempt.length = wrong.lock.begin(now);
            attempt.answer = Answer::locked, attempt.left = attempt.length, attempt.begins = Lock::address;
            wrong.wrong = 0;
        }
        if (stranger && doubtful(now) >= most_doubtful && !strangers_.holds(now)) {
            const std::chrono::seconds length = strangers_.begin(now);
            if (attempt.begins == Lock::none)
                attempt.begins = Lock::strangers, attempt.length = length;
        }
        return attempt;
    }
    known_[from.address] = now;
    if (known_.size() > most_known)
        known_.erase(std::ranges::min_element(known_, {}, [](const auto& one) { return one.second; }));
    std::erase_if(tokens_, [&](const Token& token) { return token.until <= now; });
    if (tokens_.size() >= most_tokens)
        tokens_.erase(tokens_.begin());
    tokens_.push_back({draw_token(), *role, now + lifetime});
    return {.answer = Answer::right, .role = *role, .token = tokens_.back().text};
}

std::optional<Role> Logins::role_of(std::string_view token, Time now)
{
    std::optional<Role> role;
    for (Token& known : tokens_)
        if (same_secret(known.text, token) && known.until > now) {
            role = known.role;
            known.until = now + lifetime;
        }
    return role;
}

void Logins::log_out(std::string_view token)
{
    std::erase_if(tokens_, [&](const Token& known) { return same_secret(known.text, token); });
}

void Logins::keep(const std::filesystem::path& file, Time now) const
{
    if (file.empty())
        return;
    const std::chrono::seconds clock
        = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch());
    std::string text;
    for (const Token& token : tokens_)
        if (token.until > now)
            text += token.text + " " + pins_[std::size_t(token.role)] + " "
                + std::to_string((clock + std::chrono::duration_cast<std::chrono::seconds>(token.until - now)).count())
                + "\n";
    try {
        write_kept(file, logins_kind, 0, {bytes_of(text)}, 0600);
    } catch (const InputError&) { // people log in again after a restart
    }
}

void Logins::restore(const std::filesystem::path& file, Time now)
{
    try {
        check_private(file, 0600);
    } catch (const InputError&) {
        return; // people log in again
    }
    KeptFile kept(file, logins_kind, 0);
    std::string text(std::min<std::uint64_t>(kept.size(0), most_bytes), '\0');
    if (!kept.read({bytes_of(text)}))
        return;
    const std::int64_t clock
        = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
    std::istringstream lines(text);
    std::string token, pin;
    for (std::int64_t until; lines >> token >> pin >> until && tokens_.size() < most_tokens;) {
        const auto role = std::ranges::find(pins_, pin);
        const std::int64_t left = until > clock && until < clock + 1000000 ? until - clock : 0;
        if (is_token(token) && is_pin(pin) && role != pins_.end() && left > 0)
            tokens_.push_back({token, Role(role - pins_.begin()),
                now + std::min<std::chrono::seconds>(std::chrono::seconds(left), lifetime)});
    }
}

bool Rate::take(Logins::Time now)
{
    if (last_)
        left_ = std::min(per_s_, left_ + per_s_ * std::chrono::duration<double>(now - *last_).count());
    last_ = now;
    if (left_ < 1)
        return false;
    left_ -= 1;
    return true;
}

} // namespace starbow
