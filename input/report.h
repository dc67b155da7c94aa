#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace starbow {

/// A meaning in the HID Usage Tables: page 1, id 48 is an X axis, page 9, id 1 the first button.
struct Usage {
    std::uint16_t page = 0, id = 0;
    bool operator==(const Usage&) const = default;
};

/// Usages of one page from first to last.
struct UsageRange {
    std::uint16_t page = 0, first = 0, last = 0;
};

/// One value of an input report. Offsets count from the first bit after the report's number, the lowest bit of a byte first.
struct Field {
    std::uint8_t report_id = 0; ///< 0 where the device numbers no reports
    Usage usage; ///< of an array's element the first that it can hold
    int bit_offset = 0, bits = 0;
    std::int64_t logical_min = 0, logical_max = 0;
    bool is_signed = false; ///< two's complement
    bool null_state = false; ///< outside the logical range it means "no value"
    bool relative = false;
    bool repeated = false; ///< fewer usages than values: the last one counts for several
    std::vector<UsageRange> array; ///< of an array's element: the usages that its number, from logical_min on, chooses from
};

/// A device's report descriptor (Device Class Definition for HID 1.11, 6.2.2), as far as input goes.
struct Descriptor {
    std::vector<Usage> applications; ///< of the top-level application collections
    std::vector<Field> fields; ///< in the descriptor's order, without constant bits and values without a usage
    std::map<int, int> report_bits; ///< by report number, the number itself not counted
    bool uses_report_ids = false;
    std::string stopped; ///< the reason, for people, why the rest was not read; empty: all was read
};

/// Parses any bytes; of damaged ones it returns the part before the damage. Limited to 4096 fields and reports of 16 KiB.
Descriptor parse_descriptor(std::span<const std::uint8_t> bytes);

/// True for a button's value: 0 where it is up. Some devices spend eight bits on it.
bool is_button(const Field& field);

/// The field's number in a report's payload (after the report's number); bits beyond a short report are 0.
std::int64_t raw_value(const Field& field, std::span<const std::uint8_t> payload);

/// The value's place in the logical range, -1 to 1, clamped; 0 for a range without width.
double centred(const Field& field, std::int64_t raw);

/// A hat's direction in degrees clockwise from ahead; nullopt where it is let go, or where the value is no direction.
std::optional<double> hat_degrees(const Field& field, std::int64_t raw);

/// The usage that an array's element holds; nullopt where it is empty.
std::optional<Usage> array_usage(const Field& field, std::int64_t raw);

} // namespace starbow
