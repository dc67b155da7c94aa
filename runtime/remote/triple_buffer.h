#pragma once
#include <array>
#include <atomic>
#include <cstdint>

namespace starbow {

/// The newest of many values, from one thread that writes to one that reads; neither ever waits. One of three
/// places is written, one is read, and the third holds the value that was published last.
template <class T> class TripleBuffer {
public:
    /// The place to write, for the writing thread. It holds an older value, so that texts and pixels keep their memory.
    T& next() { return places_[writes_]; }
    /// The value in next() becomes the newest one.
    void publish() { writes_ = middle_.exchange(writes_ | fresh, std::memory_order_acq_rel) & place; }
    /// For the reading thread: the newest value, which stays as it is until the next call of refresh.
    const T& newest() const { return places_[reads_]; }
    /// Makes newest() the value that was published last. Returns false where nothing was published since the last call.
    bool refresh()
    {
        if (!(middle_.load(std::memory_order_relaxed) & fresh))
            return false;
        reads_ = middle_.exchange(reads_, std::memory_order_acq_rel) & place;
        return true;
    }

private:
    static constexpr std::uint32_t place = 3, fresh = 4;
    std::array<T, 3> places_{};
    std::uint32_t writes_ = 0;
    alignas(64) std::atomic<std::uint32_t> middle_{1};
    alignas(64) std::uint32_t reads_ = 2;
};

} // namespace starbow
