#include "report.h"
#include <algorithm>
#include <utility>

namespace starbow {
namespace {

constexpr std::size_t most_fields = 4096, most_depth = 64, most_usages = 1024;
constexpr std::int64_t most_bits = 8 * 16384; // Linux's limit too

/// A short item's data with its size. A later item decides if it is signed.
struct Data {
    std::uint32_t bits = 0;
    int size = 0;

    std::int64_t as_signed() const
    {
        if (size == 0)
            return 0;
        const int unused = 64 - 8 * size;
        return std::int64_t(std::uint64_t(bits) << unused) >> unused;
    }
};

struct Globals {
    std::uint16_t page = 0;
    Data logical_min, logical_max;
    std::uint32_t size = 0, count = 0;
    std::uint8_t report_id = 0;
};

/// Usages declared by the local items of one main item.
struct Locals {
    struct Entry {
        UsageRange range;
        bool own_page = false; ///< declared with the usage itself, in four bytes
    };
    std::vector<Entry> usages;
    std::optional<Entry> from; ///< a minimum without its maximum yet, or the other way round
    std::optional<Entry> to;
    bool in_alternatives = false, alternative_taken = false;
    bool page_after = false; ///< a usage page item has come after the last usage
};

/// Item tags with their types (HID 1.11, 6.2.2.4 to 6.2.2.8), the size bits left out.
enum Tag : std::uint8_t {
    input = 0x80,
    output = 0x90,
    collection = 0xa0,
    feature = 0xb0,
    end_collection = 0xc0,
    usage_page = 0x04,
    logical_minimum = 0x14,
    logical_maximum = 0x24,
    report_size = 0x74,
    report_id = 0x84,
    report_count = 0x94,
    push = 0xa4,
    pop = 0xb4,
    usage = 0x08,
    usage_minimum = 0x18,
    usage_maximum = 0x28,
    delimiter = 0xa8,
};

class Parser {
public:
    Descriptor read(std::span<const std::uint8_t> bytes)
    {
        for (std::size_t at = 0; at < bytes.size() && found_.stopped.empty();) {
            const std::uint8_t prefix = bytes[at];
            if (prefix == 0xfe) { // a long item, with its size in the first byte; none is defined
                if (at + 2 >= bytes.size())
                    return stop("a long item is cut off");
                at += 3 + std::size_t(bytes[at + 1]);
                continue;
            }
            Data data;
            data.size = (prefix & 3) == 3 ? 4 : prefix & 3;
            if (at + std::size_t(data.size) >= bytes.size())
                return stop("its last item is cut off");
            for (int i = 0; i < data.size; ++i)
                data.bits |= std::uint32_t(bytes[at + 1 + std::size_t(i)]) << (8 * i);
            item(Tag(prefix & 0xfc), data);
            at += 1 + std::size_t(data.size);
        }
        return std::move(found_);
    }

private:
    Descriptor stop(const char* why)
    {
        found_.stopped = why;
        return std::move(found_);
    }

    void item(Tag tag, Data data)
    {
        switch (tag) {
        case usage_page:
            globals_.page = std::uint16_t(data.bits);
            locals_.page_after = true;
            return;
        case logical_minimum:
            globals_.logical_min = data;
            return;
        case logical_maximum:
            globals_.logical_max = data;
            return;
        case report_size:
            globals_.size = data.bits;
            return;
        case report_count:
            globals_.count = data.bits;
            return;
        case report_id:
            if (data.bits == 0 || data.bits > 255)
                found_.stopped = "a report is numbered " + std::to_string(data.bits) + "; 1 to 255 is right";
            globals_.report_id = std::uint8_t(data.bits);
            found_.uses_report_ids = true;
            return;
        case push:
            if (pushed_.size() == most_depth)
                found_.stopped = "it pushes more than 64 times";
            else
                pushed_.push_back(globals_);
            return;
        case pop:
            if (pushed_.empty()) {
                found_.stopped = "it pops what it did not push";
            } else {
                globals_ = pushed_.back();
                pushed_.pop_back();
            }
            return;
        case usage:
            declare(entry(data));
            return;
        case usage_minimum:
            locals_.from = entry(data);
            range();
            return;
        case usage_maximum:
            locals_.to = entry(data);
            range();
            return;
        case delimiter:
            locals_.in_alternatives = data.bits == 1;
            locals_.alternative_taken = false;
            return;
        case collection:
            begin_collection(data.bits);
            break;
        case end_collection:
            if (depth_ == 0)
                found_.stopped = "it ends a collection that it did not begin";
            else
                --depth_;
            break;
        case input:
            add_input(data.bits);
            break;
        case output:
        case feature:
            break;
        default:
            return; // physical ranges, units and strings are not needed
        }
        locals_ = {}; // local items apply to one main item
    }

    Locals::Entry entry(Data data)
    {
        locals_.page_after = false;
        const auto id = std::uint16_t(data.bits);
        return data.size == 4 ? Locals::Entry{{std::uint16_t(data.bits >> 16), id, id}, true}
                              : Locals::Entry{{globals_.page, id, id}, false};
    }

    /// Adds a usage. Between delimiters only the first, preferred one is taken.
    void declare(const Locals::Entry& entry)
    {
        if (locals_.in_alternatives && std::exchange(locals_.alternative_taken, true))
            return;
        if (locals_.usages.size() == most_usages)
            found_.stopped = "a main item has more than 1024 usages";
        else
            locals_.usages.push_back(entry);
    }

    void range()
    {
        if (!locals_.from || !locals_.to)
            return;
        Locals::Entry whole = *locals_.from;
        whole.range.last = locals_.to->range.first;
        if (locals_.to->own_page)
            whole.range.page = locals_.to->range.page, whole.own_page = true;
        locals_.from.reset(), locals_.to.reset();
        if (whole.range.last < whole.range.first)
            found_.stopped = "a range of usages ends before it begins";
        else
            declare(whole);
    }

    std::vector<UsageRange> usages() const
    {
        std::vector<UsageRange> all;
        for (Locals::Entry entry : locals_.usages) {
            if (locals_.page_after && !entry.own_page)
                entry.range.page = globals_.page;
            all.push_back(entry.range);
        }
        return all;
    }

    void begin_collection(std::uint32_t type)
    {
        if (depth_ == most_depth) {
            found_.stopped = "its collections are nested more than 64 deep";
            return;
        }
        const auto all = usages();
        if (depth_++ == 0 && type == 1 && found_.applications.size() < most_usages)
            found_.applications.push_back(all.empty() ? Usage{} : Usage{all[0].page, all[0].first});
    }

    void add_input(std::uint32_t flags)
    {
        int& bits = found_.report_bits[globals_.report_id];
        const std::uint64_t added = std::uint64_t(globals_.size) * globals_.count; // fits: both have 32 bits
        if (globals_.size > most_bits || added > std::uint64_t(most_bits - bits)) {
            found_.stopped = "a report is longer than 16384 bytes";
            return;
        }
        const int begin = bits;
        bits += int(added);
        const bool constant = flags & 1, variable = flags & 2;
        const std::vector<UsageRange> all = usages();
        if (constant || all.empty() || globals_.size == 0 || globals_.size > 32)
            return;
        Field field;
        field.report_id = globals_.report_id;
        field.bits = int(globals_.size);
        field.logical_min = globals_.logical_min.as_signed();
        field.is_signed = field.logical_min < 0;
        field.logical_max = field.is_signed ? globals_.logical_max.as_signed() : std::int64_t(globals_.logical_max.bits);
        // Limits beyond the field's bits are cut to them, as Linux does; a range without width is that of the bits.
        const std::int64_t values = std::int64_t(1) << field.bits;
        const std::int64_t least = field.is_signed ? -values / 2 : 0, most = least + values - 1;
        field.logical_min = std::clamp(field.logical_min, least, most);
        field.logical_max = std::clamp(field.logical_max, least, most);
        if (field.logical_max <= field.logical_min)
            field.logical_min = least, field.logical_max = most;
        field.relative = flags & 4;
        field.null_state = flags & 64;
        std::size_t in_range = 0;
        std::uint32_t within = 0;
        for (std::uint32_t i = 0; i < globals_.count; ++i) {
            if (found_.fields.size() == most_fields) {
                found_.stopped = "it has more than 4096 fields";
                return;
            }
            field.bit_offset = begin + int(i * globals_.size);
            if (variable) {
                const UsageRange& range = all[in_range];
                field.usage = {range.page, std::uint16_t(range.first + within)};
                if (range.first + within < range.last)
                    ++within;
                else if (in_range + 1 < all.size())
                    ++in_range, within = 0;
                else if (i + 1 < globals_.count)
                    repeats_.push_back(found_.fields.size() + 1);
            } else {
                field.usage = {all[0].page, all[0].first};
                field.array = all;
            }
            found_.fields.push_back(field);
        }
        for (std::size_t k : repeats_)
            if (k < found_.fields.size())
                found_.fields[k].repeated = true;
        repeats_.clear();
    }

    Descriptor found_;
    Globals globals_;
    Locals locals_;
    std::vector<Globals> pushed_;
    std::vector<std::size_t> repeats_;
    std::size_t depth_ = 0;
};

} // namespace

Descriptor parse_descriptor(std::span<const std::uint8_t> bytes) { return Parser().read(bytes); }

bool is_button(const Field& field) { return field.usage.page == 9 && field.array.empty() && !field.relative; }

std::int64_t raw_value(const Field& field, std::span<const std::uint8_t> payload)
{
    std::uint64_t all = 0;
    const std::size_t first = std::size_t(field.bit_offset) / 8;
    for (std::size_t i = 0; i < 5 && first + i < payload.size(); ++i)
        all |= std::uint64_t(payload[first + i]) << (8 * i);
    const int unused = 64 - field.bits;
    const std::uint64_t top = all >> (field.bit_offset % 8) << unused;
    return field.is_signed ? std::int64_t(top) >> unused : std::int64_t(top >> unused);
}

double centred(const Field& field, std::int64_t raw)
{
    const double low = double(field.logical_min), high = double(field.logical_max);
    return high > low ? std::clamp((double(raw) - low) / (high - low) * 2 - 1, -1.0, 1.0) : 0;
}

std::optional<double> hat_degrees(const Field& field, std::int64_t raw)
{
    if (raw < field.logical_min || raw > field.logical_max)
        return {};
    return 360.0 * double(raw - field.logical_min) / double(field.logical_max - field.logical_min + 1);
}

std::optional<Usage> array_usage(const Field& field, std::int64_t raw)
{
    std::int64_t index = raw - field.logical_min;
    if (index < 0 || raw > field.logical_max)
        return {};
    for (const UsageRange& range : field.array) {
        const std::int64_t count = std::int64_t(range.last) - range.first + 1;
        if (index < count) {
            const Usage usage{range.page, std::uint16_t(range.first + index)};
            return usage.id == 0 ? std::nullopt : std::optional(usage); // usage 0 of a page is "none"
        }
        index -= count;
    }
    return {};
}

} // namespace starbow
