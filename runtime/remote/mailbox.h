#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

namespace starbow {

/// A ring between one thread that puts and one that takes. Neither ever waits; a full ring refuses, and counts that.
template <class T, std::size_t room> class Mailbox {
    static_assert(room > 0 && (room & (room - 1)) == 0, "places are found by a mask");

public:
    /// Called by the thread that puts. Returns false where the ring is full; then `letter` is as before.
    bool put(T&& letter)
    {
        const std::size_t end = end_.load(std::memory_order_relaxed);
        if (end - begin_.load(std::memory_order_acquire) == room) {
            refused_.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
        letters_[end & (room - 1)] = std::move(letter);
        end_.store(end + 1, std::memory_order_release);
        return true;
    }
    /// Called by the thread that takes, in the order of put.
    bool take(T& letter)
    {
        const std::size_t begin = begin_.load(std::memory_order_relaxed);
        if (begin == end_.load(std::memory_order_acquire))
            return false;
        letter = std::move(letters_[begin & (room - 1)]);
        begin_.store(begin + 1, std::memory_order_release);
        return true;
    }
    /// The number of letters that were refused; for any thread.
    std::size_t refused() const { return refused_.load(std::memory_order_relaxed); }

private:
    std::array<T, room> letters_{};
    alignas(64) std::atomic<std::size_t> begin_{0}; ///< letters taken since the start
    alignas(64) std::atomic<std::size_t> end_{0}; ///< letters put since the start
    std::atomic<std::size_t> refused_{0};
};

} // namespace starbow
