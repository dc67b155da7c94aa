#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace starbow {

/// A set of the values of an enum, which ends with `count`.
template <class Enum> class EnumSet {
    static_assert(std::size_t(Enum::count) <= 64);

public:
    constexpr EnumSet() = default;
    constexpr EnumSet(std::initializer_list<Enum> in)
    {
        for (const Enum one : in)
            set(one);
    }

    constexpr bool operator[](Enum one) const { return bits_ & bit(one); }
    constexpr void set(Enum one, bool in = true) { bits_ = in ? bits_ | bit(one) : bits_ & ~bit(one); }
    constexpr void flip(Enum one) { bits_ ^= bit(one); }
    constexpr bool any() const { return bits_ != 0; }

    constexpr EnumSet operator&(EnumSet other) const { return EnumSet(bits_ & other.bits_); }
    constexpr EnumSet operator|(EnumSet other) const { return EnumSet(bits_ | other.bits_); }
    constexpr EnumSet operator^(EnumSet other) const { return EnumSet(bits_ ^ other.bits_); }
    /// Those that the other set lacks.
    constexpr EnumSet operator-(EnumSet other) const { return EnumSet(bits_ & ~other.bits_); }
    constexpr bool operator==(const EnumSet&) const = default;

private:
    constexpr explicit EnumSet(std::uint64_t bits)
        : bits_(bits)
    {
    }
    static constexpr std::uint64_t bit(Enum one) { return std::uint64_t(1) << unsigned(one); }

    std::uint64_t bits_ = 0;
};

/// True if a table has a row for each of an enum's first `count` values, in their order. which: the row's value.
template <class Table, class Row, class Enum>
consteval bool has_each_in_order(const Table& table, Enum Row::*which, Enum count)
{
    for (std::size_t i = 0; i < table.size(); ++i)
        if (std::size_t(table[i].*which) != i)
            return false;
    return table.size() == std::size_t(count);
}

} // namespace starbow
