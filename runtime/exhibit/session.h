#pragma once
#include "alignment_mode.h"
#include "desktop_saver.h"
#include "display_hold.h"
#include "exhibit.h"
#include "input/devices.h"
#include "input/exhibit_state.h"
#include "input/hands.h"
#include "lab.h"
#include "layout_loader.h"
#include "qualities.h"
#include "runtime/flight/goals.h"
#include "runtime/flight/menu.h"
#include "runtime/flight/record_replay.h"
#include "runtime/flight/tutorial.h"
#include "runtime/operation/service.h"
#include "runtime/operation/skew.h"
#include "runtime/operation/speaker.h"
#include "runtime/operation/usage_statistics.h"
#include "runtime/visit/attendance.h"
#include "runtime/visit/docent.h"
#include "runtime/visit/pointer.h"
#include "runtime/visit/shown_light.h"
#include "runtime/visit/tour_player.h"
#include <chrono>
#include <memory>

namespace starbow {

struct RenderContext;

/// The state of a running exhibit that outlasts the loss of a device.
struct Session {
    using Clock = std::chrono::steady_clock;
    /// Throws InputError where a record can't be written or read, or a tour's scene is wrong.
    explicit Session(const ExhibitOptions& options);

    const ExhibitOptions& options;
    Service service{};

    Attendance attendance;
    Docent docent{};
    Pointer pointer{}; ///< the docent's
    Choices choices; ///< the visitor's
    Words words; ///< of the chosen language
    MenuState menu{}; ///< the visitors'
    std::vector<std::pair<std::string, std::string>> languages{}; ///< names and own words, as read when the menu opened
    bool sky_has_names = false, sky_has_sun = false; ///< in the shown world
    std::string coming{}; ///< the name of a world that is being read; empty: none

    SessionContent content; ///< the shown one
    std::vector<Announcements> announcements; ///< of the content's tour, where a remote shows them
    int item = 0; ///< of the programme, begun last, the first one 1; 0: none yet
    Clock::time_point item_began{}; ///< by the guide's clock: frames that come late do not stop it
    Flying rules; ///< of the visitors' flight in it
    std::unique_ptr<FlightSource> source; ///< of its flight
    GoalState goals{}; ///< the visitor's, in this world
    Tutorial tutorial;
    RecordReplay record_replay;
    Devices devices;
    Hands hands;
    ShownLight light;

    Qualities qualities;
    std::string pins{}; ///< a line with the remote's drawn PINs, for the operator; empty: none were drawn
    Layout layout; ///< the shown layout
    Layout kept; ///< the file's layout, without a builder's unsaved changes
    LayoutLoader loader; ///< follows the files of `layout`
    std::vector<MachineHealth> machines{}; ///< of the exhibit, this one first; empty: this one shows all
    std::optional<bool> barrier{}; ///< the screens of those in step change together; none: no others have shown anything yet
    std::string lacks{}; ///< what the network does not give yet: a sentence; empty: nothing is missing
    std::string refused; ///< the reason why a changed layout was not applied, for the head-up display
    DisplayHold display{};
    DesktopSaver desktop_saver{};
    AlignmentMode alignment;
    Lab lab;
    std::unique_ptr<Speaker> speaker; ///< null where the exhibit does not speak
    std::string spoken{}; ///< the moment of the last text
    double frame_s = 0; ///< the mean time of the last frames, s
    UsageStatistics usage;
    std::size_t unplugged = 0; ///< devices, as last counted
    Skew skew{};
    Clock::time_point began = Clock::now(), last = began;
    Clock::time_point turned{}; ///< the usage statistics
    long shown = 0; ///< frames
    bool complaints = false; ///< the validation layers had messages on a lost device

    const Flight& flight() const { return source->flight(); } ///< the shown one
    const TourPlayer* tour() const { return source->tour(); } ///< the shown one; null: none
};

/// Limit of one step of loading, s. A world takes less than a second on a GPU, and half a minute on a busy processor.
constexpr double loading_limit_s = 60;
/// Limit of any other wait, s: it ends before the service manager's watchdog does, so that the log can name the wait.
double wait_limit_s(const Service& service);

inline double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

/// The name of a file, or of its path, as commands give it: chart-0.5 of chart-0.5 and of shots/chart-0.5.json.
std::string command_name_of(const std::filesystem::path& file);
/// Writes the state that remotes and the guide's window show. out: its memory is used again.
void describe(const Session& session, ExhibitState& out);
/// The visitor's choices at the start of each visit.
Choices first_choices(const ExhibitOptions& options);
/// The rules by which visits are counted where somebody else attends to them.
Visiting counted_by(const SessionContent& content);
/// True where the choices of one-button flying are the visitor's controls.
bool by_one_button(const Session& session);
/// True where the goals of the world are requested of the visitor: in a free flight, on the displays for visitors and
/// guides.
bool seeks_goals(const Session& session);
/// Counts a visit that has ended, from its beginning to its last touch.
void count_visit(Session& session, double length_s);
/// The digest of all that a visitor can change.
std::uint64_t digest(const Session& session);
/// A recorder of the exhibit's flight from its start on. Throws InputError as Recorder does.
std::unique_ptr<Recorder> recorder_of(const ExhibitOptions& options, const Flying& rules);
/// The rules in the content's world, which has its globes' grounds, a boundary where nobody attends to the visitors, and a
/// pace where the exhibit has one.
Flying rules_in(const ExhibitOptions& options, Flying rules, const SessionContent& content);
/// The announcements of the content's tour where the exhibit has a remote, which alone shows them; otherwise none.
std::vector<Announcements> announced_on(const ExhibitOptions& options, const SessionContent& content);
/// The source of the content's flight, at its beginning. Throws InputError.
std::unique_ptr<FlightSource> source_of(const SessionContent& content, const Flying& rules, const Staging& staging);
/// The options of an exhibit's device, with windows.
Device::Options device_of(const ExhibitOptions& options);
/// Logs the remarks on a newly loaded world and its spectral level.
void log_world(const RenderContext& context);
/// True while a test pattern, which only a builder calls up, shows the drawn PINs.
bool shows_pins(const Session& session);
/// A sentence about the machines that are not in step; empty where all are.
std::string steps_of(const Session& session);
/// A sentence about the machines and their screens, for a builder.
std::string screens_of(const Session& session);
/// The line below the head-up display's figures.
std::string notice_of(const Session& session);
/// True once the requested frames are shown, or a remote or the caller says so.
bool is_over(const Session& session);
std::string describe(const Skew& skew);

/// Reads the visitor's devices; sets the entry's controls and times. Returns false if the visitor leaves.
bool read_controls(Session& session, std::span<GLFWwindow* const> windows, RecordEntry& entry);
/// Counts a frame. frame_s: the time since the frame before was presented.
void count_frame(Session& session, double frame_s, double refresh_hz);
/// Turns the usage statistics once a second; call it each frame. Returns true when the exposition of the counts is a new
/// one.
bool turn_usage(Session& session, std::size_t outputs_shown, std::size_t pipelines);

/// Follows the visitor's way through the world's goals, where the display is for visitors or guides.
void seek_goals(Session& session, const SceneFile& scene, std::int64_t dt_ns);

/// Steps flight, light, record and tutorial by the entry, whose commands are carried out already.
void step(Session& session, RecordEntry& entry, const Metered& metered);

} // namespace starbow
