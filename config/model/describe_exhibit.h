#pragma once
#include "config/json/describe.h"
#include "describe_layout.h"
#include "describe_programme.h"
#include "exhibit_file.h"

namespace starbow {

// Exhibit files, as config/json/describe.h says.

/// The name of a shipped file, or a path from the file's folder, as paths are in all files.
struct NameOrPath : Text {
    std::string read(const Place& place, const Folder& folder) const;
};
/// A path from the file's folder.
struct PathFrom : Text {
    std::filesystem::path read(const Place& place, const Folder& folder) const
    {
        return (folder.path / text(place)).lexically_normal();
    }
};

template <>
inline constexpr auto description<Vignette> = describe<Vignette>("vignette",
    "The picture's edge darkens while the ship turns. Not beside turn_steps_deg.",
    field("elevation_deg", Number{{-90, 90}},
        "The middle of the clear part above straight ahead, for domes whose front is higher, degrees.",
        &Vignette::elevation_deg),
    field(
        "clear_deg", Number{{0, 120}}, "Nothing darkens within this angle from that middle, degrees.", &Vignette::clear_deg),
    field("soft_deg", Number{{1, 60}}, "From there to the greatest darkness, degrees.", &Vignette::soft_deg),
    field("darkness", Number{{0, 1, true}},
        "The part of the light that is lost there while the ship turns at half of turn_deg_per_s or faster.",
        &Vignette::darkness));
static_assert(is_complete<Vignette>());

template <>
inline constexpr auto description<Comfort> = describe<Comfort>("comfort",
    "Rules against motion sickness, for a dome or a headset, where the whole field of view turns.",
    field("no_roll", Flag{}, "true: the controls' roll does nothing.", &Comfort::no_roll),
    field("level_horizon", Flag{},
        "true: the cockpit's right axis stays horizontal, the pitch within 75 degrees, also on the way home. There is no "
        "roll then.",
        &Comfort::level_horizon),
    field("turn_steps_deg", Number{{5, 45}},
        "The view turns at once by this many degrees while the stick is held, every 0.4 s, instead of smoothly.",
        &Comfort::turn_steps_deg),
    field("vignette", Object<Vignette>{}, "", &Comfort::vignette));
static_assert(is_complete<Comfort>());
void check(const Place& place, const Comfort& comfort, const Folder&);

template <>
inline constexpr auto description<Flying> = describe<Flying>("flying",
    "The rules of flight, with limits that spare visitors' stomachs. Seconds are the visitor's.",
    field("mode", Named{&flight_modes},
        "guided: the throttle's place sets the speed, and the velocity follows the nose. free: the throttle's place sets "
        "the speed, and the nose turns by itself. newtonian: the throttle sets the thrust along the nose, and the ship is "
        "not slowed down otherwise.",
        &Flying::mode),
    field("max_gamma", Number{{1.001, 1000000}},
        "The Lorentz factor at full throttle; lower places are evenly spaced in rapidity. 2.294 is 0.9 of light's speed, "
        "7.089 "
        "is 0.99, 22.37 is 0.999.",
        &Flying::max_gamma),
    field("turn_deg_per_s", Number{{0, 360, true}},
        "The fastest turn of the nose up, down, left or right, degrees per second.", &Flying::turn_deg_per_s),
    field(
        "roll_deg_per_s", Number{{0, 360}}, "The fastest roll, degrees per second; 0 never rolls.", &Flying::roll_deg_per_s),
    field("turn_jerk_deg_per_s3", Number{{1, 1000000}},
        "The greatest jerk of any turn, degrees per second cubed, even when a stick is thrown from end to end. Smaller "
        "values make turns begin and end more softly.",
        &Flying::turn_jerk_deg_per_s3),
    field("rapidity_per_s", Number{{0.01, 10}},
        "The greatest gain or loss of speed, rapidity per second (the proper acceleration in units of c per second).",
        &Flying::rapidity_per_s),
    field("rapidity_jerk_per_s2", Number{{0.01, 10000}}, "The greatest change of that gain, rapidity per second squared.",
        &Flying::rapidity_jerk_per_s2),
    field("paced", Flag{},
        "A held throttle gains speed at the pace of the world: slowly among things, fast in empty space, so that a flight "
        "through it lasts the time that the scene's file plans. Not while the instruments' readings are logged.",
        &Flying::paced),
    // The world's own, and the exhibit's "comfort".
    not_in_file(&Flying::boundary, &Flying::pace, &Flying::solids, &Flying::comfort));
static_assert(is_complete<Flying>());

template <>
inline constexpr auto description<Exposing> = describe<Exposing>("exposure",
    "The exposure of the pictures. EV are powers of two of the light; the visitor's change is added.",
    field("mode", Named{&exposure_modes},
        "eye: one exposure, as an eye sees it. range: one curve of brightness shows everything at once. Each visit begins "
        "with it; a key changes it.",
        &Exposing::mode),
    field("automatic", Flag{},
        "true: the exposure follows the view, as eyes do: in about half a second to a brighter view, in three to a darker "
        "one.",
        &Exposing::automatic),
    field("min_ev", Number{{-60, 60}}, "The least automatic exposure, for the brightest views, EV.", &Exposing::min_ev),
    field("max_ev", Number{{-60, 60}}, "The greatest automatic exposure, for the darkest views, EV; not below min_ev.",
        &Exposing::max_ev),
    field("bloom", Number{{0, 1}},
        "The share of the light brighter than the screen's white that glows around it, as in an eye or a lens; 0: none, "
        "which takes no time. Left out: 0.1 on a GPU, 0 without one.",
        &Exposing::bloom),
    not_in_file(&Exposing::calm)); // the exhibit's "calm"
static_assert(is_complete<Exposing>());
void check(const Place& place, const Exposing& exposing, const Folder&);

/// A word that can be typed blind.
std::string read_unlock(const Place& place, const Folder&);
template <>
inline constexpr auto description<Visiting> = describe<Visiting>("visit",
    "The exhibit attends to its visitors by itself: while nobody is there it shows tours, a touch begins a visit, and after "
    "it "
    "everything is as at the start. Without it somebody else attends to them.",
    field("idle_s", Number{{5, 3600}},
        "Seconds without a touch until the exhibit asks for the visitor. A running tour does not count as idle time.",
        &Visiting::idle_s),
    field("ask_s", Number{{0, 300}},
        "Seconds that the question is shown, and the end of the longest visit announced; 0: neither.", &Visiting::ask_s),
    field(
        "longest_s", Number{{0, 86400}}, "The longest visit, seconds; 0: as long as somebody flies.", &Visiting::longest_s),
    field("fade_s", Number{{0, 5}}, "Seconds of the fade through black from one state of the exhibit to the next.",
        &Visiting::fade_s),
    field("unlock", Own(&read_unlock, R"({ "type": "string", "pattern": "^[0-9a-z]{4,32}$" })"),
        "Typed on the exhibit's keyboard, it gives the builder's keys back for ten minutes: F2, F3, Page Up and Down, F5, "
        "F11, K and Esc. Without it they stay locked.",
        &Visiting::unlock),
    field("attract", List{NameOrPath{}, 0, 100, "tours and records"},
        "Shown in turn while nobody is there: tour files, or names of those in config/tours, and records of flights "
        "(.jsonl). Without any the start of the flight is shown.",
        &Visiting::attract));
static_assert(is_complete<Visiting>());

std::string read_identity(const Place& place, const Folder&);
template <>
inline constexpr auto description<Machines> = describe<Machines>("machines",
    "Several machines show this exhibit together: each output of the layout has a node, and each machine is started with "
    "starbow "
    "run --node and its name. Without it one machine shows all.",
    needed("master", Text{R"(["left"])"}, "The node that has the visitors' devices, the remote and the tours.",
        &Machines::master),
    needed("interface", Text{R"(["192.168.7.0/24", "enp3s0", "lo"])"},
        "The network on which the machines speak to each other, without a login: an interface's name, or a network of which "
        "each machine has an address. It should be a switch of its own.",
        &Machines::interface),
    field("domain", Whole{0, 200},
        "A number of the exhibit; two exhibits on one network have different ones, so that neither receives the other's "
        "messages.",
        &Machines::domain),
    field("exhibit",
        Own(&read_identity,
            R"({ "type": "string", "minLength": 1, "maxLength": 64, "examples": ["dome in the east hall"] })"),
        "The exhibit's identity, the same on each of its machines. Messages of another exhibit on the same network and "
        "domain are left out. Without it the identity is the layout's name with the names of its nodes.",
        &Machines::exhibit));
static_assert(is_complete<Machines>());

struct IpAddress : Text {
    std::string read(const Place& place, const Folder&) const;
};
/// A name or an IP address, as a browser's address line shows it: without scheme and port, IPv6 in brackets.
std::string read_host_name(const Place& place, const Folder&);
inline const std::vector<std::pair<std::string_view, bool>> osc_roles{{"docent", false}, {"engineer", true}};
template <>
inline constexpr auto description<OscSettings> = describe<OscSettings>("osc",
    "Commands by OSC over UDP, which has no login.", needed("port", Whole{1, 65535}, "The UDP port.", &OscSettings::port),
    needed("from", List{IpAddress{}, 1, 64, "IP addresses that may send commands"},
        "The IP addresses whose commands are taken.", &OscSettings::from),
    field("role", Named{&osc_roles}, "The role of all senders.", &OscSettings::engineer));
static_assert(is_complete<OscSettings>());

template <>
inline constexpr auto description<RemoteSettings> = with_rules(
    describe<RemoteSettings>("remote",
        "A page for tablets and telephones, OSC, and starbow tell. Without it no port is opened.",
        needed("port", Whole{1, 65535}, "The TCP port of the page.", &RemoteSettings::port),
        field("address", IpAddress{},
            "The IP address of this machine at which the page is reached; 0.0.0.0: all of its IPv4 addresses, ::: all "
            "addresses.",
            &RemoteSettings::address),
        field("hosts", List{Own(&read_host_name, R"({ "type": "string", "minLength": 1 })"), 0, 64, "names"},
            "The names by which browsers reach this machine, beside its address and localhost. Another name is refused.",
            &RemoteSettings::hosts),
        field("certificate", PathFrom{},
            "The certificate's PEM file, with those that it rests on. With it the page is https.",
            &RemoteSettings::certificate),
        field("key", PathFrom{}, "The PEM file of the certificate's key.", &RemoteSettings::key),
        field("pins", PathFrom{},
            "The file of PINs, readable by the exhibit's user and group alone: lines such as docent 123456. Without it "
            "/etc/starbow/pins, and without that PINs are drawn.",
            &RemoteSettings::pins),
        field("osc", Object<OscSettings>{}, "", &RemoteSettings::osc)),
    R"({ "dependencies": { "certificate": ["key"], "key": ["certificate"] } })");
static_assert(is_complete<RemoteSettings>());
void check(const Place& place, const RemoteSettings& remote, const Folder&);

template <>
inline constexpr auto description<OneButton> = describe<OneButton>("one_button",
    "The visitors fly with one button: the display shows the choices in turn, and a press of any key or button takes the "
    "shown "
    "one.",
    field("scan_s", Number{{0.5, 10}}, "Each choice is shown for this time, seconds.", &OneButton::scan_s),
    field("act_s", Number{{0.1, 10}}, "A short press acts for this time, seconds; a longer one for as long as it is held.",
        &OneButton::act_s));
static_assert(is_complete<OneButton>());

template <>
inline constexpr auto description<Presenting> = describe<Presenting>("presenter",
    "A window for the guide beside the visitors' ones: their picture small, the tour's cue sheet, and everything that a "
    "guide can "
    "do, by keys and by the mouse.",
    field("monitor", Object<MonitorName>{}, "", &Presenting::monitor));
static_assert(is_complete<Presenting>());

template <>
inline constexpr auto description<Menu> = describe<Menu>("menu",
    "What visitors can choose in their menu, by the names of shipped files. Without a list, all of them.",
    field("scenes", List{ShippedName{{}, "scenes"}, 1, 20, "names of shipped files"}, "The worlds that visitors can choose.",
        &Menu::scenes),
    field("tours", List{ShippedName{{}, "tours"}, 1, 20, "names of shipped files"}, "The tours that visitors can choose.",
        &Menu::tours));
static_assert(is_complete<Menu>());

template <>
inline constexpr auto description<Exhibit> = describe_file<Exhibit>("exhibit",
    "The parts of an exhibit, and its rules of flight. Paths start at this file's folder; names without a slash and without "
    ".json "
    "are those of shipped files.",
    field("layout", NameOrPath{}, "The displays: a layout file, or the name of one in config/layouts.", &Exhibit::layout),
    field("scene", NameOrPath{},
        "The world: a scene file, or the name of one in config/scenes. The visit begins at the scene's start. Not beside a "
        "shot.",
        &Exhibit::scene),
    field("shot", NameOrPath{},
        "The start of the visit, in the shot's own scene: a shot file, or the name of one in config/shots.", &Exhibit::shot),
    field("tour", NameOrPath{},
        "The shown tour, in its own scene: a tour file, or the name of one in config/tours. Not beside a scene or a shot.",
        &Exhibit::tour),
    field("programme", NameOrPath{},
        "The programme of a guide's show: a programme file, or the name of one in config/programmes. The guide's window and "
        "the remote's page show it.",
        &Exhibit::programme),
    field("language", NameOrPath{},
        "The language of the visitors' texts: a file of words, or the name of one in config/words.", &Exhibit::language),
    field("quality", NameOrPath{},
        "Speed or accuracy: a quality file, or the name of one in config/qualities. Without it the device's default: fine "
        "on a GPU, balanced without one. Not beside frame_budget_ms.",
        &Exhibit::quality),
    field("ladder", NameOrPath{},
        "For frame_budget_ms: a ladder that starbow measure wrote, or the name of one in config/qualities.",
        &Exhibit::ladder),
    field("textfile", PathFrom{},
        "A file that receives the exhibit's counts every 15 seconds, for node_exporter's textfile collector.",
        &Exhibit::textfile),
    field("profiles", PathFrom{},
        "A folder with profiles of this exhibit's own sticks. They have precedence over a person's own profiles and the "
        "shipped ones.",
        &Exhibit::profiles),
    field("information", Named{&informations},
        "The first display of information: for a visitor, a guide or the laboratory. A key steps through them.",
        &Exhibit::information),
    field("speech", Flag{}, "true: captions, descriptions and goals are read aloud by espeak-ng.", &Exhibit::speech),
    field("tutorial", Flag{}, "true: a visit begins with three prompts: go, turn, stop.", &Exhibit::tutorial),
    field("frame_budget_ms", Number{{0, 1000}},
        "The time of a whole frame, milliseconds, that is held by moves along the ladder of qualities; 0: the quality "
        "stays.",
        &Exhibit::frame_budget_ms),
    field("flying", Object<Flying>{}, "", &Exhibit::flying),
    field("one_button", Object<OneButton>{}, "", &Exhibit::one_button),
    field("left_handed", Flag{},
        "true: keyboard, pads and sticks suit a left-handed visitor. In the visitors' menu each one can choose.",
        &Exhibit::left_handed),
    again("comfort", Within{Object<Comfort>{}, &Exhibit::flying, &Flying::comfort}, "", &Exhibit::flying),
    field("exposure", Object<Exposing>{}, "", &Exhibit::exposure),
    again("calm", Within{Flag{}, &Exhibit::exposure, &Exposing::calm},
        "true: however visitors press the controls, switches, throttle, exposure and fades make no more than three flashes "
        "in a second (WCAG 2.3.1). Presses that change the picture at once act at most once a second.",
        &Exhibit::exposure),
    field("remote", Object<RemoteSettings>{}, "", &Exhibit::remote),
    field("presenter", Object<Presenting>{}, "", &Exhibit::presenter),
    field("machines", Object<Machines>{}, "", &Exhibit::machines),
    field("visit", Object<Visiting>{}, "", &Exhibit::visiting), field("menu", Object<Menu>{}, "", &Exhibit::menu));
static_assert(is_complete<Exhibit>());
void check(const Place& place, const Exhibit& exhibit, const Folder&);

} // namespace starbow
