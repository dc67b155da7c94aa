#pragma once
#include <array>
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
    void add(std::uint64_t word) { value = (value ^ word) * 1099511628211u; }
    void add(const std::string& text) { add(text.data(), text.size() + 1); }
};

/// Hashes every word of long contents, so that every single fault is detected. Four parallel chains are as fast as memory.
class ContentHash {
public:
    void add(const void* data, std::size_t bytes)
    {
        const char* from = static_cast<const char*>(data);
        std::array<std::uint64_t, 4> words;
        for (; bytes >= sizeof words; bytes -= sizeof words, from += sizeof words) {
            std::memcpy(words.data(), from, sizeof words);
            for (std::size_t i = 0; i < lanes_.size(); ++i)
                lanes_[i].add(words[i]);
        }
        lanes_[0].add(from, bytes);
    }
    std::uint64_t value() const
    {
        Hash all = lanes_[0];
        for (std::size_t i = 1; i < lanes_.size(); ++i)
            all.add(lanes_[i].value);
        return all.value;
    }

private:
    std::array<Hash, 4> lanes_;
};

} // namespace starbow
