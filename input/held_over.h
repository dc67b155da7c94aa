#pragma once
#include <array>
#include <cstddef>

namespace starbow {

/// Keys and buttons that one visitor holds down when the next one takes over. Each counts again once it has been let go.
template <std::size_t count> class HeldOver {
public:
    /// The hands change: what is down at the next reading was left behind.
    void forget() { forgets_ = true; }
    /// A new press, of which a reading may miss that the key was up before.
    void press(std::size_t key) { left_[key] = false; }
    /// Returns whether a key counts as down. Call it for each key at each reading.
    bool counts(std::size_t key, bool down)
    {
        left_[key] = down && (left_[key] || forgets_);
        return down && !left_[key];
    }
    /// The end of a reading.
    void end() { forgets_ = false; }

private:
    std::array<bool, count> left_{};
    bool forgets_ = false;
};

} // namespace starbow
