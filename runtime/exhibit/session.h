#pragma once
#include "alignment_mode.h"
#include "config/model/beside.h"
#include "desktop_saver.h"
#include "display_hold.h"
#include "exhibit.h"
#include "input/calm.h"
#include "input/exhibit_state.h"
#include "input/head_tracker.h"
#include "input/hid.h"
#include "input/keyboard.h"
#include "input/presence.h"
#include "input/scan.h"
#include "lab.h"
#include "layout_loader.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/goals.h"
#include "runtime/flight/history.h"
#include "runtime/flight/menu.h"
#include "runtime/flight/record_replay.h"
#include "runtime/flight/shown_record.h"
#include "runtime/flight/tutorial.h"
#include "runtime/flight/visit.h"
#include "runtime/images/flash_guard.h"
#include "runtime/light/exposure.h"
#include "runtime/light/range_curve.h"
#include "runtime/operation/diary.h"
#include "runtime/operation/governor.h"
#include "runtime/operation/guide.h"
#include "runtime/operation/service.h"
#include "runtime/operation/skew.h"
#include "runtime/operation/speaker.h"
#include <chrono>
#include <memory>

namespace starbow {

struct RenderContext;

/// The part of a docent's directions that is no flight.
struct Directions {
    bool fades = false; ///< to black, and stays so
    double fade = 0; ///< the part of black now
    bool holds = false; ///< the visitors' devices do nothing
    double exposure_ev = 0; ///< added to every picture's
    bool restarts = false; ///< the exhibit ends, so that the service manager starts it anew
    std::string caption{}; ///< on the head-up display; empty: none
    std::string refusal{}; ///< the reason of the last refused one
};

/// The state of a running exhibit that outlasts the loss of a device.
struct Session {
    using Clock = std::chrono::steady_clock;
    /// Throws InputError where a record can't be written or read, or a tour's scene is wrong.
    explicit Session(const ExhibitOptions& options);

    const ExhibitOptions& options;
    Service service{};
    Visiting visiting; ///< the exhibit's rules; where somebody else attends to the visitors, those that count them
    Visit visit;
    Presence presence{};
    Clock::time_point locked_from{}; ///< the builder's keys, where the exhibit attends to its visitors
    bool goes_home = false; ///< through black, as the way is too long to be flown
    double home_black = 0; ///< the part of black on that way
    bool somebody = false; ///< has touched a control in this frame
    MenuState menu{}; ///< the visitors'
    std::vector<std::pair<std::string, std::string>> languages{}; ///< names and own words, as read when the menu opened
    bool one_button; ///< the visitor flies with one
    bool left_handed; ///< the controls are a left-handed visitor's
    Scan scan{}; ///< of the one button
    std::string coming{}; ///< the visitors' name of a world that is being read; empty: none
    Programme programme; ///< the shown one
    Words words; ///< for the visitors' texts
    Information information; ///< the shown display
    Beside beside = Beside::none; ///< the small picture
    GoalState goals{}; ///< the visitor's, in this world
    Flying rules; ///< of the visitors' flight
    std::optional<Quality> quality; ///< a fixed one, where no governor chooses
    std::string quality_name;
    Directions directions{};
    std::string pins{}; ///< a line with the remote's drawn PINs, for the operator; empty: none were drawn
    Layout layout; ///< the shown layout
    Layout kept; ///< the file's layout, without a builder's unsaved changes
    LayoutLoader loader; ///< follows the files of `layout`
    std::vector<MachineHealth> machines{}; ///< of the exhibit, this one first; empty: this one shows all
    std::optional<bool> barrier{}; ///< the screens of those in step change together; none: no others have shown anything yet
    std::string lacks{}; ///< what the network does not give yet: a sentence; empty: nothing is missing
    std::string refused; ///< the reason why a changed layout was not applied, for the head-up display
    std::optional<Guide> guide;
    std::unique_ptr<ShownRecord> shown_record; ///< the attraction's; null: none
    Flight flight;
    History history{};
    std::optional<Leaps> leaps{}; ///< of the last picture; none before the first one of a programme
    bool leapt = false; ///< the next picture has nothing to do with the one before
    Exposure exposure{};
    double begun_ev = 0; ///< the exposure with which the present view began, EV
    bool range; ///< a curve shows everything at once
    RangeMode range_mode{};
    CalmHands calm_hands{}; ///< of a calm exhibit, as the next two
    SlowTurns calm_ev{}, calm_black{};
    FlashGuard flash_guard{}; ///< of a calm exhibit
    double drawn_ev = 0; ///< of the last picture
    double calm_light = 1; ///< the part of the picture's light that it keeps
    bool calm_range = false; ///< calm_ev is that of a curve
    double black = 0; ///< the part of black over the picture
    Tutorial tutorial;
    RecordReplay record_replay;
    DisplayHold display{};
    DesktopSaver desktop_saver{};
    Keyboard keyboard{};
    Hid hid;
    std::unique_ptr<HeadTracker> tracker;
    AlignmentMode alignment;
    Lab lab;
    std::unique_ptr<Speaker> speaker; ///< null where the exhibit does not speak
    std::string spoken{}; ///< the moment of the last text
    double frame_s = 0; ///< the mean time of the last frames, s
    Diary diary;
    double visited_s = 0; ///< time with a visitor that the diary lacks
    std::size_t unplugged = 0; ///< devices, as last counted
    Skew skew{};
    std::optional<Governor> governor;
    std::vector<glm::ivec2> sizes{}; ///< of the outputs' windows, as last drawn
    Clock::time_point began = Clock::now(), last = began;
    Clock::time_point turned{}; ///< the diary
    long shown = 0; ///< frames
    bool complaints = false; ///< the validation layers had messages on a lost device
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
/// Gives a builder's keys back for ten minutes.
void unlock_builders_keys(Session& session);
/// The rules by which visits are counted where somebody else attends to them.
Visiting counted_by(const Programme& programme);
/// True where the visitor's controls steer: no tour shows its own motion.
bool visitor_flies(const Session& session);
/// True where the choices of one-button flying are the visitor's controls.
bool by_one_button(const Session& session);
/// True where the goals of the world are requested of the visitor: in a free flight, on the displays for visitors and
/// guides.
bool seeks_goals(const Session& session);
/// True while somebody's visit goes on.
bool knows_visitor(const Session& session);
/// Counts a visit that has ended, from its beginning to its last touch.
void count_visit(Session& session, double length_s);
/// The digest of all that a visitor can change.
std::uint64_t digest(const Session& session);
/// A recorder of the exhibit's flight from its start on. Throws InputError as Recorder does.
std::unique_ptr<Recorder> recorder_of(const ExhibitOptions& options, const Flying& rules);
/// The rules in a programme's world, which has its globes' grounds, a boundary where nobody attends to the visitors, and a
/// pace where the exhibit has one.
Flying rules_in(const ExhibitOptions& options, Flying rules, const Programme& programme);
/// The head tracker of a layout; null where it has none.
std::unique_ptr<HeadTracker> tracker_of(const Layout& layout);
/// The guide of a programme's tour, at its beginning; none without a tour. The programme must outlive it. visitors: as the
/// guide's.
std::optional<Guide> guide_of(const Programme& programme, const Flying& rules, bool visitors);
/// The governor of an exhibit's frame time; none where its quality is fixed.
std::optional<Governor> governor_of(const ExhibitOptions& options);
/// The spectral level that the qualities request; none: the world's own need.
std::optional<SpectralLevel> spectral_level_of(const Session& session);
/// The same for an exhibit's start.
std::optional<SpectralLevel> spectral_level_of(const ExhibitOptions& options);
/// The options of an exhibit's device, with windows.
Device::Options device_of(const ExhibitOptions& options);
/// Logs the remarks on a newly loaded world and its spectral level.
void log_world(const RenderContext& context);
/// The quality of the next frame.
Quality quality_of(const Session& session, const Device& device);
/// Leaves a level of the governor's ladder for which the device has no memory, and logs that with the reason. Returns false
/// without a governor, and where no level is left.
bool take_coarser_level(Session& session, std::size_t level, const std::string& reason);
/// The curve by which the next picture shows everything at once; none: the exposure alone does.
const std::optional<RangeCurve>& curve_of(const Session& session);
/// The exposure of the next picture, EV. With a curve: the change by the visitor and the docent.
double ev_of(const Session& session);
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
/// Turns the diary once a second; call it each frame. Returns true when the exposition of the counts is a new one.
bool turn_diary(Session& session, std::size_t outputs_shown, std::size_t pipelines);

/// Follows the visitor's way through the world's goals, where the display is for visitors or guides.
void seek_goals(Session& session, const SceneFile& scene, std::int64_t dt_ns);

/// The luminance of the frame before.
struct Metered {
    std::optional<double> ev; ///< the exposure for it
    std::span<const LuminanceSample> surfaces, stars;
    std::size_t across = 0; ///< the surfaces' samples lie in rows of so many
};

/// Steps flight, exposure, record and tutorial by the entry, whose commands are carried out already.
void step(Session& session, RecordEntry& entry, const Metered& metered, double seconds_per_time_unit);

} // namespace starbow
