// HID report descriptors: the fields that devices declare, rare cases of HID 1.11, and damaged bytes. tests/hid/ has the
// devices, each with the source of its fields and of its bytes.
#include "input/report.h"
#include "tests/support/files.h"
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

namespace report_test {

using namespace starbow;
using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

namespace {

Bytes bytes_of(const std::string& hex)
{
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(std::uint8_t(std::stoul(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

std::vector<json> devices()
{
    std::vector<json> all;
    for (const auto& entry : std::filesystem::directory_iterator(starbow::testing::source_dir() / "tests/hid"))
        if (entry.path().extension() == ".json")
            all.push_back(json::parse(std::ifstream(entry.path())));
    std::sort(all.begin(), all.end()); // the folder's own order differs between machines
    return all;
}

/// A field as the files of tests/hid describe it.
json json_of(const Field& field)
{
    json out = {{"report_id", field.report_id}, {"usage_page", field.usage.page}, {"usage", field.usage.id},
        {"bit_offset", field.bit_offset}, {"bits", field.bits}, {"logical_min", field.logical_min},
        {"logical_max", field.logical_max}, {"signed", field.is_signed}, {"null_state", field.null_state}};
    if (field.relative)
        out["relative"] = true;
    if (field.repeated)
        out["repeated_usage"] = true;
    if (!field.array.empty()) {
        out["array"] = true;
        out["usage_max"] = field.array.back().last;
        for (const UsageRange& range : field.array)
            out["array_usages"].push_back({range.page, range.first, range.last});
    }
    return out;
}

/// The field that a report's `values` call PAGE/USAGE, or PAGE/USAGE/2 if it is the second one of its usage.
const Field& named_field(const Descriptor& descriptor, int report_id, const std::string& name)
{
    std::istringstream text(name);
    int page = 0, usage = 0, which = 1;
    char slash = 0;
    text >> page >> slash >> usage >> slash >> which;
    for (const Field& field : descriptor.fields)
        if (field.report_id == report_id && field.usage.page == page && field.usage.id == usage && --which <= 0)
            return field;
    throw std::runtime_error("no field " + name);
}

/// The value computed bit by bit.
std::int64_t bit_by_bit(const Field& field, const Bytes& payload)
{
    std::int64_t value = 0;
    for (int i = 0; i < field.bits; ++i) {
        const std::size_t bit = std::size_t(field.bit_offset + i);
        const bool set = bit / 8 < payload.size() && payload[bit / 8] >> (bit % 8) & 1;
        if (set)
            value += field.is_signed && i == field.bits - 1 ? -(std::int64_t(1) << i) : std::int64_t(1) << i;
    }
    return value;
}

Descriptor parsed(std::initializer_list<int> bytes) { return parse_descriptor(Bytes(bytes.begin(), bytes.end())); }

} // namespace

TEST(ReportTest, DevicesDeclareTheirFields)
{
    const std::vector<json> all = devices();
    EXPECT_GE(all.size(), 16u);
    int values = 0;
    for (const json& device : all) {
        SCOPED_TRACE(device["name"].get<std::string>());
        const Bytes bytes = bytes_of(device["descriptor_hex"]);
        ASSERT_EQ(bytes.size(), device["descriptor_bytes"].get<std::size_t>());
        const Descriptor found = parse_descriptor(bytes);
        EXPECT_EQ(found.stopped, "");
        EXPECT_EQ(found.uses_report_ids, device["uses_report_ids"].get<bool>());
        ASSERT_EQ(found.fields.size(), device["fields"].size());
        for (std::size_t i = 0; i < found.fields.size(); ++i) {
            json declared = device["fields"][i]; // a Sony DualShock 4 declares 0 to 127 of six bits
            if (!declared["signed"].get<bool>())
                declared["logical_max"] = std::min(
                    declared["logical_max"].get<std::int64_t>(), (std::int64_t(1) << declared["bits"].get<int>()) - 1);
            EXPECT_EQ(json_of(found.fields[i]), declared) << i;
        }
        json bits = json::object();
        for (const auto& [id, count] : found.report_bits)
            bits[std::to_string(id)] = count;
        EXPECT_EQ(bits, device["input_report_bits"]);
        json applications = json::array();
        for (const Usage& usage : found.applications)
            applications.push_back({usage.page, usage.id});
        EXPECT_EQ(applications, device["application_usages"]);
        for (const json& report : device["reports"]) {
            Bytes payload = bytes_of(report["hex"]);
            const int id = found.uses_report_ids ? payload.at(0) : 0;
            if (found.uses_report_ids)
                payload.erase(payload.begin());
            for (const Field& field : found.fields)
                if (field.report_id == id) {
                    EXPECT_EQ(raw_value(field, payload), bit_by_bit(field, payload));
                }
            const json chosen = report.value("values", json::object());
            for (const auto& [name, value] : chosen.items()) {
                ++values;
                EXPECT_EQ(raw_value(named_field(found, id, name), payload), value.get<std::int64_t>())
                    << name << " of " << report["hex"];
            }
        }
    }
    EXPECT_GE(values, 150);
}

/// A device's fields are facts; the bytes of its descriptor and its reports are those of this project's encoder.
TEST(ReportTest, TheEncoderWroteTheFilesBytes)
{
    const auto folder = starbow::testing::source_dir() / "tests/hid";
    const std::string command
        = "/usr/bin/python3 -B '" + (folder / "encode.py").string() + "' --check '" + folder.string() + "'/*.json";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    // Bytes that neither the encoder nor a list of items explains are others' work, which NOTICE names one by one.
    std::string others;
    for (const json& device : devices())
        if (!device.contains("items") && !device.value("encoded", false))
            others += device["name"].get<std::string>() + "\n";
    EXPECT_EQ(others, "Flight stick firmware with the report layout of the Logitech Extreme 3D Pro\n");
}

TEST(ReportTest, RareCasesOfTheStandardAreRead)
{
    // Usage page 1, usage X; 1 x 12 bits; min -2048 in two bytes, max 2047.
    Descriptor d = parsed({0x05, 1, 0x09, 0x30, 0x16, 0x00, 0xf8, 0x26, 0xff, 0x07, 0x75, 12, 0x95, 1, 0x81, 0x02});
    ASSERT_EQ(d.fields.size(), 1u);
    EXPECT_TRUE(d.fields[0].is_signed);
    EXPECT_EQ(d.fields[0].logical_min, -2048);
    EXPECT_EQ(raw_value(d.fields[0], Bytes{0x00, 0x08}), -2048);
    EXPECT_EQ(centred(d.fields[0], 2047), 1);
    EXPECT_EQ(centred(d.fields[0], -4000), -1);
    // A maximum of ff in one byte is 255 if the minimum is 0, and -1 if it is negative.
    d = parsed({0x05, 1, 0x09, 0x30, 0x15, 0, 0x25, 0xff, 0x75, 8, 0x95, 1, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).logical_max, 255);
    d = parsed({0x05, 1, 0x09, 0x30, 0x25, 0xff, 0x15, 0x81, 0x75, 8, 0x95, 1, 0x81, 2}); // in the other order
    EXPECT_EQ(d.fields.at(0).logical_max, -1);
    // Limits beyond the bits are cut to them: 0 to 65535 and -32768 to 32767 of eight bits. Without a maximum, all of the
    // bits count.
    d = parsed({0x05, 1, 0x09, 0x30, 0x15, 0, 0x27, 0xff, 0xff, 0, 0, 0x75, 8, 0x95, 1, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).logical_max, 255);
    EXPECT_NEAR(centred(d.fields[0], 127), 0, 0.01);
    EXPECT_EQ(centred(d.fields[0], 255), 1);
    d = parsed({0x05, 1, 0x09, 0x30, 0x16, 0x00, 0x80, 0x26, 0xff, 0x7f, 0x75, 8, 0x95, 1, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).logical_min, -128);
    EXPECT_EQ(d.fields[0].logical_max, 127);
    d = parsed({0x05, 1, 0x09, 0x30, 0x15, 0, 0x75, 16, 0x95, 1, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).logical_max, 65535);
    EXPECT_NEAR(centred(d.fields[0], 32768), 0, 0.001);
    d = parsed({0x05, 1, 0x09, 0x30, 0x15, 0, 0x75, 32, 0x95, 1, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).logical_max, 0xffffffff);
    // Four buttons of eight bits, 0 where they are up.
    d = parsed({0x05, 9, 0x19, 1, 0x29, 4, 0x15, 0, 0x25, 0, 0x75, 8, 0x95, 4, 0x81, 2});
    ASSERT_EQ(d.fields.size(), 4u);
    for (const Field& button : d.fields)
        EXPECT_TRUE(is_button(button)) << button.usage.id;
    // A four-byte usage has a page of its own. A page after the last usage applies to all short ones.
    d = parsed({0x05, 1, 0x0b, 0x01, 0, 9, 0, 0x09, 0x31, 0x05, 2, 0x75, 1, 0x95, 2, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).usage, (Usage{9, 1}));
    EXPECT_EQ(d.fields.at(1).usage, (Usage{2, 0x31}));
    // Between delimiters the first usage applies.
    d = parsed({0x05, 1, 0xa9, 1, 0x09, 0x30, 0x09, 0x31, 0xa9, 0, 0x09, 0x32, 0x75, 8, 0x95, 2, 0x81, 2});
    EXPECT_EQ(d.fields.at(0).usage, (Usage{1, 0x30}));
    EXPECT_EQ(d.fields.at(1).usage, (Usage{1, 0x32}));
    // Long items are skipped, 32 bits are read whole, and an array of buttons names those that are held.
    d = parsed({0xfe, 2, 0x77, 1, 2, 0x05, 9, 0x19, 1, 0x29, 8, 0x15, 1, 0x25, 8, 0x75, 4, 0x95, 2, 0x81, 0});
    ASSERT_EQ(d.fields.size(), 2u);
    EXPECT_EQ(array_usage(d.fields[0], 3), (Usage{9, 3}));
    EXPECT_FALSE(array_usage(d.fields[0], 0));
    EXPECT_FALSE(array_usage(d.fields[0], 9));
    d = parsed({0x05, 1, 0x09, 0x30, 0x17, 0, 0, 0, 0x80, 0x27, 0xff, 0xff, 0xff, 0x7f, 0x75, 32, 0x95, 1, 0x81, 2});
    EXPECT_EQ(raw_value(d.fields.at(0), Bytes{0, 0, 0, 0x80}), -2147483648ll);
    EXPECT_EQ(raw_value(d.fields.at(0), Bytes{0xff}), 255); // a short report
    // Push and pop keep every global item. Further values repeat the last usage.
    d = parsed({0x05, 1, 0x15, 0, 0x25, 9, 0x75, 4, 0x95, 1, 0xa4, 0x05, 9, 0x25, 1, 0x75, 1, 0x95, 4, 0x09, 1, 0x81, 2,
        0xb4, 0x09, 0x39, 0x81, 0x42});
    ASSERT_EQ(d.fields.size(), 5u);
    EXPECT_TRUE(!d.fields[0].repeated && d.fields[3].repeated);
    EXPECT_EQ(d.fields[4].usage, (Usage{1, 0x39}));
    EXPECT_EQ(d.fields[4].logical_max, 9);
    EXPECT_TRUE(d.fields[4].null_state);
    // A hat with eight directions from 1, released at 0, and a hat with four.
    Field hat{.bits = 4, .logical_min = 1, .logical_max = 8};
    EXPECT_EQ(hat_degrees(hat, 3), 90);
    EXPECT_FALSE(hat_degrees(hat, 0));
    hat.logical_min = 0, hat.logical_max = 3;
    EXPECT_EQ(hat_degrees(hat, 3), 270);
}

TEST(ReportTest, FaultsAreReportedAndEarlierFieldsKept)
{
    const std::initializer_list<int> good = {0x05, 1, 0x09, 0x30, 0x75, 8, 0x95, 1, 0x81, 2};
    const auto after = [&](std::initializer_list<int> more) {
        Bytes bytes(good.begin(), good.end());
        bytes.insert(bytes.end(), more.begin(), more.end());
        const Descriptor found = parse_descriptor(bytes);
        EXPECT_EQ(found.fields.size(), 1u);
        return found.stopped;
    };
    EXPECT_EQ(after({}), "");
    EXPECT_NE(after({0x27, 1, 2}).find("cut off"), std::string::npos);
    EXPECT_NE(after({0xfe}).find("cut off"), std::string::npos);
    EXPECT_NE(after({0xb4}).find("pops"), std::string::npos);
    EXPECT_NE(after({0xc0}).find("collection"), std::string::npos);
    EXPECT_NE(after({0x85, 0}).find("numbered 0"), std::string::npos);
    EXPECT_NE(after({0x97, 0xff, 0xff, 0xff, 0xff, 0x09, 1, 0x81, 2}).find("longer"), std::string::npos);
    EXPECT_NE(
        after({0x77, 0xff, 0xff, 0xff, 0xff, 0x97, 0xff, 0xff, 0xff, 0xff, 0x81, 3}).find("longer"), std::string::npos);
    EXPECT_NE(after({0x19, 9, 0x29, 3}).find("before it begins"), std::string::npos);
}

/// STARBOW_FUZZ_COUNT sets the number of mutations, STARBOW_FUZZ_SEED the seed. A seed's mutations are always the same.
TEST(ReportFuzzTest, DamagedDescriptorsAndReportsDoNoHarm)
{
    const char* count_text = std::getenv("STARBOW_FUZZ_COUNT");
    const long count = count_text ? std::atol(count_text) : 100000;
    std::vector<Bytes> seeds;
    for (const json& device : devices())
        seeds.push_back(bytes_of(device["descriptor_hex"]));
    const char* seed_text = std::getenv("STARBOW_FUZZ_SEED");
    std::mt19937 random(seed_text ? unsigned(std::atol(seed_text)) : 1);
    long fields = 0, stopped = 0;
    for (long n = 0; n < count; ++n) {
        Bytes bytes = seeds[random() % seeds.size()];
        for (unsigned k = random() % 8 + 1; k > 0 && !bytes.empty(); --k)
            switch (random() % 5) {
            case 0:
                bytes[random() % bytes.size()] = std::uint8_t(random());
                break;
            case 1:
                bytes.erase(bytes.begin() + std::ptrdiff_t(random() % bytes.size()));
                break;
            case 2:
                bytes.insert(bytes.begin() + std::ptrdiff_t(random() % bytes.size()), std::uint8_t(random()));
                break;
            case 3: // a global item of four bytes with a large number: sizes, counts and limits may overflow
                bytes.insert(bytes.begin() + std::ptrdiff_t(random() % bytes.size()),
                    {std::uint8_t(0x07 | random() % 11 << 4), 0xff, 0xff, 0xff, std::uint8_t(random() % 2 ? 0xff : 0x7f)});
                break;
            default:
                bytes.resize(random() % (bytes.size() + 1));
            }
        const Descriptor found = parse_descriptor(bytes);
        fields += long(found.fields.size());
        stopped += !found.stopped.empty();
        ASSERT_LE(found.fields.size(), 4096u);
        Bytes payload(random() % 70);
        for (std::uint8_t& byte : payload)
            byte = std::uint8_t(random());
        for (std::size_t i = 0; i < found.fields.size(); i += 1 + found.fields.size() / 32) {
            const Field& field = found.fields[i];
            ASSERT_TRUE(field.bits >= 1 && field.bits <= 32 && field.bit_offset >= 0);
            const std::int64_t raw = raw_value(field, payload);
            ASSERT_EQ(raw, bit_by_bit(field, payload));
            ASSERT_LE(std::abs(centred(field, raw)), 1);
            if (const auto degrees = hat_degrees(field, raw)) {
                ASSERT_TRUE(*degrees >= 0 && *degrees < 360) << *degrees;
            }
            (void)array_usage(field, raw);
        }
    }
    std::printf("  %ld descriptors: %ld fields, %ld stopped early\n", count, fields, stopped);
    EXPECT_GT(stopped, count / 20);
}

} // namespace report_test
