// Profiles and the mapping of a device's values: every shipped profile on its device's fields, the shapes of axes, wrong
// files.
#include "config/model/profile.h"
#include "input/mapping.h"
#include "tests/support/files.h"
#include "tests/support/schema_check.h"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace profile_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

json json_of(const std::filesystem::path& file) { return json::parse(std::ifstream(file)); }

Descriptor descriptor_of(const json& device)
{
    const std::string hex = device["descriptor_hex"];
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(std::uint8_t(std::stoul(hex.substr(i, 2), nullptr, 16)));
    return parse_descriptor(bytes);
}

std::optional<json> device(const std::string& vendor, const std::string& product)
{
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "tests/hid"))
        if (entry.path().extension() == ".json")
            if (json found = json_of(entry.path()); found["vid"] == vendor && found["pid"] == product)
                return found;
    return {};
}

std::vector<std::filesystem::path> shipped()
{
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "config/profiles"))
        all.push_back(entry.path());
    return all;
}

/// Every axis in its middle, throttles too, with no button pressed and hats released.
DeviceState at_rest(const Descriptor& descriptor)
{
    DeviceState state;
    for (const Field& field : descriptor.fields) {
        const bool hat = field.usage == Usage{1, 0x39};
        state.raw.push_back(field.bits == 1 ? 0
                : hat                       ? field.logical_max + 1
                                            : (field.logical_min + field.logical_max + 1) / 2);
    }
    return state;
}

std::size_t field(const Descriptor& descriptor, Usage usage)
{
    for (std::size_t i = 0; i < descriptor.fields.size(); ++i)
        if (descriptor.fields[i].usage == usage)
            return i;
    throw std::runtime_error("no such field");
}

} // namespace

TEST(ProfileTest, ShippedProfilesAreValidAndFitTheirDevices)
{
    int on_devices = 0;
    EXPECT_GE(shipped().size(), 8u);
    for (const auto& file : shipped()) {
        SCOPED_TRACE(file.filename().string());
        const json profile_json = json_of(file);
        EXPECT_TRUE(schema_accepts("profile", profile_json));
        const Profile profile = load_profile(file);
        const auto real = device(profile_json["vendor"], profile_json["product"]);
        if (!real)
            continue;
        ++on_devices;
        const Descriptor descriptor = descriptor_of(*real);
        for (const AxisUse& use : profile.axes)
            EXPECT_NO_THROW(field(descriptor, {std::uint16_t(use.page), std::uint16_t(use.usage)})) << use.usage;
        for (const ButtonUse& use : profile.buttons)
            EXPECT_NO_THROW(field(descriptor, {9, std::uint16_t(use.button)})) << use.button;
        // At rest all controls are 0, except the throttle in its middle.
        Controls controls;
        Mapping mapping(descriptor, profile);
        mapping.add(at_rest(descriptor), 0, 0.01, controls);
        EXPECT_EQ(controls.turn, glm::dvec3(0));
        EXPECT_EQ(controls.look_rad, glm::dvec2(0));
        EXPECT_EQ(controls.throttle_rate, 0);
        EXPECT_FALSE(controls[Switch::stop] || controls[Switch::home] || controls[Switch::undo]);
        for (const Lever& lever : mapping.levers())
            EXPECT_NEAR(lever.place, 0.5, 0.01);
    }
    EXPECT_GE(on_devices, 8);
}

TEST(ProfileTest, AnyDeviceFliesByItsUsages)
{
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "tests/hid")) {
        if (entry.path().extension() != ".json")
            continue;
        SCOPED_TRACE(entry.path().filename().string());
        const Descriptor descriptor = descriptor_of(json_of(entry.path()));
        if (entry.path().filename().string().starts_with("sony-buzz") || entry.path().filename().string().starts_with("ion"))
            continue; // buttons and keys alone can't fly
        Mapping mapping(descriptor, usual_profile(descriptor));
        Controls rest;
        mapping.add(at_rest(descriptor), 0, 0.01, rest);
        EXPECT_EQ(rest.turn, glm::dvec3(0));
        // Some axis turns the nose to the right at one end and to the left at the other.
        bool turns = false;
        for (std::size_t i = 0; i < descriptor.fields.size(); ++i) {
            DeviceState state = at_rest(descriptor);
            Controls high, low;
            state.raw[i] = descriptor.fields[i].logical_max;
            mapping.add(state, 0, 0.01, high);
            state.raw[i] = descriptor.fields[i].logical_min;
            mapping.add(state, 0, 0.01, low);
            turns = turns || (descriptor.fields[i].bits > 1 && high.turn.y == -1 && low.turn.y == 1);
        }
        EXPECT_TRUE(turns);
    }
}

// A stick of known make: right is right, back is up, forward on the slider is full speed.
TEST(ProfileTest, AStickMovesTheShipAsTheHandMoves)
{
    const Descriptor descriptor = descriptor_of(*device("044f", "b10a"));
    Mapping mapping(descriptor, load_profile(source_dir() / "config/profiles/thrustmaster-t16000m.json"));
    DeviceState state = at_rest(descriptor);
    const auto controls_now = [&] {
        Controls controls;
        mapping.add(state, 0, 0.1, controls);
        if (!mapping.levers().empty())
            controls.lever = mapping.levers()[0].place;
        return controls;
    };
    state.raw[field(descriptor, {1, 0x30})] = 16383;
    EXPECT_EQ(controls_now().turn, glm::dvec3(0, -1, 0)); // to the right: against the right-handed rotation about y
    state = at_rest(descriptor);
    state.raw[field(descriptor, {1, 0x31})] = 16383;
    EXPECT_EQ(controls_now().turn, glm::dvec3(1, 0, 0));
    state = at_rest(descriptor);
    state.raw[field(descriptor, {1, 0x36})] = 0;
    EXPECT_EQ(controls_now().lever, 1);
    state.raw[field(descriptor, {1, 0x36})] = 255;
    EXPECT_EQ(controls_now().lever, 0);
    // A press counts once, the hat looks around, and fields without a value do nothing.
    state.presses.resize(descriptor.fields.size());
    state.presses[field(descriptor, {9, 1})] = {1};
    EXPECT_TRUE(controls_now()[Switch::stop]);
    state.presses.clear();
    EXPECT_FALSE(controls_now()[Switch::stop]);
    state = at_rest(descriptor);
    state.raw[field(descriptor, {1, 0x39})] = 2;
    EXPECT_LT(controls_now().look_rad.x, -0.1);
    state.raw.assign(descriptor.fields.size(), std::nullopt);
    EXPECT_FALSE(controls_now().lever);
    EXPECT_EQ(controls_now().turn, glm::dvec3(0));
}

// A pad of known make: for a left hand the right stick turns, the left trigger makes faster, the bumpers change places.
TEST(ProfileTest, ALeftHandHasTheOtherSideOfAPad)
{
    const Descriptor descriptor = descriptor_of(*device("054c", "09cc"));
    const Profile right = load_profile(source_dir() / "config/profiles/sony-dualshock-4.json");
    const auto does = [&](const Profile& profile, Usage usage, std::int64_t raw) {
        DeviceState state = at_rest(descriptor);
        for (const std::uint16_t trigger : {51, 52})
            state.raw[field(descriptor, {1, trigger})] = 0;
        state.presses.resize(descriptor.fields.size());
        state.raw[field(descriptor, usage)] = raw;
        if (usage.page == 9)
            state.presses[field(descriptor, usage)] = {raw};
        Controls controls;
        Mapping(descriptor, profile).add(state, 0, 0.1, controls);
        return controls;
    };
    const Profile left = left_handed(right);
    for (const auto& [usual, mirrored] : {std::pair<std::uint16_t, std::uint16_t>{48, 50}, {49, 53}, {52, 51}})
        for (const std::int64_t raw : {0, 40, 255}) {
            const Controls by_right = does(right, {1, usual}, raw), by_left = does(left, {1, mirrored}, raw);
            EXPECT_EQ(by_right.turn, by_left.turn) << usual;
            EXPECT_EQ(by_right.throttle_rate, by_left.throttle_rate) << usual;
            EXPECT_EQ(by_right.look_rad, by_left.look_rad) << usual;
            const Controls looked = does(right, {1, mirrored}, raw), by_other = does(left, {1, usual}, raw);
            EXPECT_EQ(looked.look_rad, by_other.look_rad) << mirrored;
            EXPECT_EQ(looked.throttle_rate, by_other.throttle_rate) << mirrored;
        }
    EXPECT_EQ(does(left, {1, 50}, 255).turn, glm::dvec3(0, -1, 0));
    EXPECT_EQ(does(left, {1, 53}, 255).turn, glm::dvec3(1, 0, 0)) << "pulled back, the nose goes up";
    EXPECT_TRUE(does(right, {9, 5}, 1)[Switch::look_ahead]);
    EXPECT_TRUE(does(left, {9, 6}, 1)[Switch::look_ahead]);
    EXPECT_TRUE(does(left, {9, 5}, 1)[Switch::aberration]);
    EXPECT_TRUE(does(left, {9, 2}, 1)[Switch::stop]) << "the other buttons stay";
    EXPECT_TRUE(does(left, {9, 2}, 1).held);
    EXPECT_FALSE(does(left, {9, 2}, 0).held);
    const Profile again = left_handed(left);
    EXPECT_EQ(again.axes, right.axes);
    EXPECT_EQ(again.buttons, right.buttons);
}

TEST(ProfileTest, AStickWithoutASecondOneStaysAsItIsForALeftHand)
{
    const Profile stick = load_profile(source_dir() / "config/profiles/thrustmaster-t16000m.json");
    EXPECT_EQ(left_handed(stick).axes, stick.axes);
    EXPECT_EQ(left_handed(stick).buttons, stick.buttons);
}

TEST(ProfileTest, AxesHaveDeadZonesCurvesAndDetents)
{
    const Field stick{.bits = 16, .logical_min = 0, .logical_max = 1000};
    AxisUse use{.role = AxisRole::nose_up, .dead_zone = 0.1, .curve = 2};
    EXPECT_EQ(shaped(use, stick, 500), 0);
    EXPECT_EQ(shaped(use, stick, 549), 0);
    EXPECT_EQ(shaped(use, stick, 1000), 1);
    EXPECT_EQ(shaped(use, stick, 0), -1);
    EXPECT_NEAR(shaped(use, stick, 775), 0.25, 1e-12); // half of the way beyond the dead zone, squared
    use.inverted = true;
    EXPECT_EQ(shaped(use, stick, 1000), -1);
    // A calibrated axis reaches its ends at the device's, on both sides of its middle, also with a range from high to low.
    use = {.role = AxisRole::nose_up, .dead_zone = 0, .curve = 1, .range = std::array{100.0, 400.0, 900.0}};
    EXPECT_EQ(shaped(use, stick, 50), -1);
    EXPECT_EQ(shaped(use, stick, 250), -0.5);
    EXPECT_EQ(shaped(use, stick, 650), 0.5);
    use.range = std::array{900.0, 400.0, 100.0};
    EXPECT_EQ(shaped(use, stick, 650), -0.5);
    EXPECT_EQ(shaped(use, stick, 250), 0.5);
    // A throttle runs from 0 to 1 and rests in its detents.
    use = {.role = AxisRole::throttle, .dead_zone = 0.02, .curve = 1, .detents = {0.5}};
    EXPECT_EQ(shaped(use, stick, 10), 0);
    EXPECT_EQ(shaped(use, stick, 990), 1);
    EXPECT_EQ(shaped(use, stick, 515), 0.5);
    EXPECT_GT(shaped(use, stick, 560), 0.55);
    // With the largest dead zone it is a switch without undefined places.
    use.dead_zone = 0.5;
    EXPECT_EQ(shaped(use, stick, 400), 0);
    EXPECT_EQ(shaped(use, stick, 500), 0);
    EXPECT_EQ(shaped(use, stick, 600), 1);
}

TEST(ProfileTest, ShortOrUnknownReportsKeepTheOtherValues)
{
    const Descriptor descriptor = descriptor_of(*device("046d", "c626"));
    DeviceState state;
    const std::vector<std::uint8_t> first = {1, 10, 0, 20, 0, 30, 0}, cut = {1, 11, 0, 21}, unknown = {99, 1, 2, 3, 4, 5, 6};
    EXPECT_TRUE(take_report(descriptor, first, 5, state));
    EXPECT_EQ(state.raw[0], 10);
    EXPECT_TRUE(take_report(descriptor, cut, 6, state));
    EXPECT_EQ(state.raw[0], 11);
    EXPECT_EQ(state.raw[1], 20);
    EXPECT_FALSE(take_report(descriptor, unknown, 7, state));
    EXPECT_FALSE(take_report(descriptor, {}, 8, state));
    EXPECT_EQ(state.report_ns, 6);
}

TEST(ProfileTest, WrongProfilesAreRefused)
{
    const auto result_of = [](const std::string& text) {
        try {
            load_profile(write_text("profile.json", text));
            return std::string("read");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
    };
    const std::string head = R"({ "name": "a", "vendor": "044f", "product": "b10a")";
    EXPECT_EQ(result_of(head + "}"), "read");
    for (const auto& [more, problem] : std::vector<std::pair<std::string, std::string>>{
             {R"(, "axes": [{ "usage": 48, "role": "nose-upp" }])", "/axes/0/role: \"nose-upp\""},
             {R"(, "axes": [{ "role": "nose-up" }])", "lacks \"usage\""},
             {R"(, "axes": [{ "usage": 48, "role": "none", "dead_zone": 0.9 }])", "/axes/0/dead_zone: 0.9 is too large"},
             {R"(, "axes": [{ "usage": 48, "role": "none", "range": [0, 9, 5] }])", "has its middle outside its ends"},
             {R"(, "buttons": [{ "button": 0, "role": "stop" }])", "/buttons/0/button: 0 is too small"},
             {R"(, "mirrored_buttons": [[5]])", "/mirrored_buttons/0"},
             {R"(, "mirrored_buttons": [[5, 0]])", "/mirrored_buttons/0/1: 0 is too small"},
             {R"(, "hat": { "z": "none" })", "/hat/z"}})
        EXPECT_NE(result_of(head + more + "}").find(problem), std::string::npos) << result_of(head + more + "}");
    EXPECT_NE(result_of(R"({ "name": "a", "vendor": "44f", "product": "b10a" })").find("four hexadecimal digits"),
        std::string::npos);
}

TEST(ProfileTest, WrittenProfilesReadBackTheSame)
{
    std::vector<Profile> all;
    for (const auto& file : shipped())
        all.push_back(load_profile(file));
    Profile full;
    full.name = "\"Left\" \\ stick, \xc3\xa9";
    full.vendor = 0x044f, full.product = 0xfffe, full.serial = "A/1 2";
    full.axes = {{2, 0xbb, 3, AxisRole::throttle, true, 0.123, 2.5, std::array{4294967295.0, 0.5, -2147483648.0}, {0.1, 1}},
        {1, 0x30, 0, AxisRole::none, false, 0, 1, std::array{-0.25, 1.0 / 3, 1e9}}};
    full.buttons = {{128, HeldRole::darker}, {1, ButtonRole()}};
    full.mirrored_buttons = {{1, 128}, {7, 8}};
    full.hat.y = AxisRole::push_back;
    all.push_back(full);
    Profile bare;
    bare.name = "b", bare.vendor = 1, bare.product = 0;
    all.push_back(bare);
    const std::filesystem::path file = scratch("profiles/of/mine/written.json"); // folders that do not exist yet
    for (const Profile& profile : all) {
        SCOPED_TRACE(profile.name);
        save_profile(profile, file);
        EXPECT_TRUE(schema_accepts("profile", json_of(file)));
        const Profile back = load_profile(file);
        EXPECT_EQ(back.name, profile.name);
        EXPECT_EQ(back.vendor, profile.vendor);
        EXPECT_EQ(back.product, profile.product);
        EXPECT_EQ(back.serial, profile.serial);
        EXPECT_EQ(back.axes, profile.axes);
        EXPECT_EQ(back.buttons, profile.buttons);
        EXPECT_EQ(back.mirrored_buttons, profile.mirrored_buttons);
        EXPECT_EQ(back.hat.x, profile.hat.x);
        EXPECT_EQ(back.hat.y, profile.hat.y);
    }
    // A name that is not UTF-8 loses the wrong bytes, and the file loads.
    bare.name = "a\xff";
    save_profile(bare, file);
    EXPECT_TRUE(load_profile(file).name.starts_with("a"));
}

TEST(ProfileTest, AProfileThatCantBeWrittenLeavesTheOldOne)
{
    Profile profile;
    profile.name = "new";
    const auto file = write_text("profile-kept.json", "old");
    EXPECT_NE(
        complaint([&] { save_profile(profile, file / "in-a-file.json"); }).find("can't be written"), std::string::npos);
    EXPECT_NE(complaint([&] { save_profile(profile, file.parent_path()); }).find("is not a file"), std::string::npos);
    EXPECT_EQ(read_text(file), "old");
    // A link stays a link; the file that it leads to is replaced.
    const auto link = scratch("profile-link.json");
    std::filesystem::remove(link);
    std::filesystem::create_symlink(file, link);
    save_profile(profile, link);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(load_profile(file).name, "new");
}

} // namespace profile_test
