#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace starbow {

/// FNV-1a, 64 bits: it names our own files and offers no protection.
struct Hash {
    std::uint64_t value = 14695981039346656037u;
    void add(const void* data, std::size_t size)
    {
        for (std::size_t i = 0; i < size; ++i)
            value = (value ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211u;
    }
    void add(const std::string& text) { add(text.data(), text.size() + 1); }
};

/// Hashes every word of long contents, so that a fault within one word is always detected. Four parallel chains are as fast
/// as memory. Each step turns the word, because a product passes a word's highest bit on to no other bit: two signs that
/// change would cancel each other.
class ContentHash {
public:
    void add(const void* data, std::size_t bytes)
    {
        const char* from = static_cast<const char*>(data);
        const std::size_t all = bytes;
        std::array<std::uint64_t, 4> words;
        for (; bytes >= sizeof words; bytes -= sizeof words, from += sizeof words) {
            std::memcpy(words.data(), from, sizeof words);
            for (std::size_t i = 0; i < lanes_.size(); ++i)
                mix(lanes_[i], words[i]);
        }
        for (std::size_t size; bytes > 0; bytes -= size, from += size) {
            std::uint64_t word = 0;
            size = std::min(bytes, sizeof word);
            std::memcpy(&word, from, size);
            mix(lanes_[0], word);
        }
        mix(lanes_[0], all); // "ab" and "c" are not "a" and "bc"
    }
    std::uint64_t value() const
    {
        std::uint64_t all = 0;
        for (const std::uint64_t lane : lanes_)
            mix(all, lane, 0xd6e8feb86659fd93); // another factor: a change in one lane is not one in another, a step later
        return all;
    }

private:
    static void mix(std::uint64_t& lane, std::uint64_t word, std::uint64_t odd = 0x9e3779b97f4a7c15)
    {
        lane = std::rotl((lane ^ word) * odd, 29);
    }

    std::array<std::uint64_t, 4> lanes_{1, 2, 3, 4};
};

} // namespace starbow
