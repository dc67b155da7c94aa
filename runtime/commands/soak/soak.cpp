#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/layout.h"
#include "config/model/shipped.h"
#include "displays/compile/compiled_view.h"
#include "log_file.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/interrupt.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/commands/tools.h"
#include "runtime/exhibit/exhibit.h"
#include "runtime/exhibit/outputs.h"
#include "runtime/operation/progress.h"
#include "runtime/operation/vitals.h"
#include "runtime/render/driver_memory.h"
#include "visitor.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <unistd.h>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;

struct SoakOptions {
    long visits = 300, seed = 1, settled = 1000, repeat = 0;
    int devices = 0;
    std::string as = use_names[0], scene = "avenue", tour = "first-minute";
    std::string log = "out/soak.csv";
};

Use use_of(const std::string& name) { return Use(std::ranges::find(use_names, name) - use_names.begin()); }

constexpr double frame_s = 0.08; ///< the visitor's time of a frame: "some seconds" are some dozens of frames
constexpr int resting_frames = 3; ///< after a visit, before a sample is taken
/// The rules of the visits: the question and the end come within frames.
const Visiting visiting{.idle_s = 2 * frame_s, .ask_s = frame_s, .fade_s = 2 * frame_s};
constexpr int waking_frames = 3; ///< in which a visitor takes the stick, and the exhibit fades to the flight
/// A visit does not end by itself while a docent's tour runs, or while a docent holds the exhibit: then a reset ends it.
constexpr int most_lingering_frames = 12;
/// A visitor stays until the saved layout is shown, so that each one is; not longer, for a device that is lost meanwhile is
/// opened with the newest layout.
constexpr int most_waiting_frames = 300;
/// Visits. Of each turn, the first half is shown on one of the other layouts; a sample is taken at its end, on the first
/// layout again, so that samples are of one state.
constexpr long turn = 20;

/// A folder for the layout that the soak saves again and again, and for the counts, which are none of the machine's
/// visitors'.
class SoakFolder {
public:
    SoakFolder()
        : folder_(std::filesystem::temp_directory_path() / ("starbow-soak-" + std::to_string(getpid())))
    {
        std::filesystem::create_directory(folder_);
        for (const std::string& name : shipped_names("layouts"))
            if (const std::string text = small_layout(name); !text.empty())
                layouts_.push_back(text);
        save(turn / 2);
    }
    ~SoakFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    SoakFolder(const SoakFolder&) = delete;

    std::filesystem::path layout() const { return folder_ / "layout.json"; }
    std::filesystem::path state() const { return folder_ / "state"; }
    std::filesystem::path textfile() const { return folder_ / "starbow.prom"; }
    void save(long visit) const
    {
        const bool first = visit % turn >= turn / 2;
        write_whole(layout(), layouts_[first ? 0 : std::size_t(visit / turn + 1) % layouts_.size()]);
    }

    /// Files in this folder and in the cache.
    std::size_t files() const
    {
        std::size_t count = 0;
        std::error_code error;
        for (const std::filesystem::path& folder : {folder_, map_cache_folder()})
            if (!folder.empty())
                for (std::filesystem::recursive_directory_iterator at(folder, error), end; !error && at != end;
                     at.increment(error))
                    ++count;
        return count;
    }

private:
    /// A shipped layout with outputs of 64 x 48 pixels; empty for one that names other files or monitors.
    static std::string small_layout(const std::string& name)
    {
        nlohmann::json layout = read_document(shipped_file("layouts", name)).root;
        layout.erase("$schema");
        for (nlohmann::json& output : layout["outputs"]) {
            if (output.contains("monitor") || output.dump().find("\"file\"") != std::string::npos)
                return "";
            output["size"] = {64, 48};
        }
        return layout.dump(1);
    }

    std::filesystem::path folder_;
    std::vector<std::string> layouts_;
};

/// Plays the visitors, one after the other, and samples the process after each twentieth.
class Visitors {
public:
    Visitors(const SoakOptions& options, SoakLog& log, const SoakFolder& folder)
        : options_(options)
        , log_(log)
        , folder_(folder)
        , choices_{shipped_names("scenes"), shipped_names("shots"), shipped_names("tours"), shipped_names("words"),
              shipped_names("qualities")}
        , use_(use_of(options.as))
        , visit_(log.next_visit())
    {
        begin();
    }

    void reloaded() { saved_ = false; }
    /// state: the digest of what the visit's end has restored.
    void visit_over(std::uint64_t state)
    {
        over_ = true;
        first_state_ = first_state_.value_or(state);
        other_states_ += state != *first_state_;
    }
    long other_states() const { return other_states_; } ///< visits whose end left another state than the first one's
    bool over() const { return visit_ >= options_.visits || interrupted(); }

    void act(RecordEntry& entry)
    {
        ++frames_;
        entry.dt_ns = std::int64_t(1e9 * frame_s), entry.skipped_ns = 0;
        const Head head = entry.controls.head;
        entry.controls = {};
        entry.controls.head = head;
        if (left_ == 0 && (use_ == Use::tour || use_ == Use::flight)) // these go on without a rest
            end();
        // The exhibit reads it beside its frames, once the file rests.
        if (left_ == 0 && saved_ && waited_++ < most_waiting_frames)
            return;
        if (woken_++ < waking_frames)
            entry.controls.pressed = true;
        else if (left_-- > 0)
            visitor_->act(entry, frame_s);
        else if (use_ == Use::visitors)
            see_off(entry);
        else if (left_ == -1)
            reset(entry);
        else if (left_ <= -1 - resting_frames)
            end();
    }

private:
    static void reset(RecordEntry& entry) { entry.commands.push_back({.kind = CommandKind::reset}); }

    /// The visitor has let go: the exhibit ends the visit.
    void see_off(RecordEntry& entry)
    {
        if (!over_ && left_ == -most_lingering_frames)
            reset(entry);
        if (over_ && rested_++ >= resting_frames)
            end();
    }

    /// The visit's number, which begins anew where the same visitors come again.
    long kind_of_visit() const { return options_.repeat > 0 ? visit_ % options_.repeat : visit_; }

    void begin()
    {
        visitor_ = std::make_unique<SeededVisitor>(use_, std::uint64_t(options_.seed), kind_of_visit(), choices_);
        left_ = visitor_->frames(), waited_ = rested_ = 0, over_ = false;
        woken_ = use_ == Use::visitors ? 0 : waking_frames;
        if (use_ == Use::reloads)
            folder_.save(kind_of_visit() * (turn / 2)); // the other layouts and the first one in turn
        else if (use_ == Use::visitors && (visit_ % (turn / 2) == 0 || unsaved_))
            save_or_later();
    }

    /// A full disk takes no layout: the next visit saves it.
    void save_or_later()
    {
        try {
            unsaved_ = true;
            folder_.save(kind_of_visit());
            unsaved_ = false;
            saved_ = frames_ > 0; // the first one is there before the exhibit
        } catch (const InputError&) {
        }
    }

    void end()
    {
        if (visit_ % turn == turn - 1) {
            const Vitals now = vitals();
            const DriverMemory driver = driver_memory();
            log_.add({visit_, frames_, std::chrono::duration<double>(Clock::now() - began_).count(), now.resident_bytes,
                now.heap_bytes, now.files, now.threads, driver.pieces, driver.bytes, folder_.files()});
        }
        ++visit_;
        progress_.show("visit " + std::to_string(visit_) + " of " + std::to_string(options_.visits),
            double(visit_) / double(options_.visits));
        saved_ = use_ == Use::reloads;
        begin();
    }

    const SoakOptions& options_;
    SoakLog& log_;
    const SoakFolder& folder_;
    SoakNames choices_;
    Use use_;
    long visit_, frames_ = 0;
    int left_ = 0, waited_ = 0, woken_ = 0, rested_ = 0; ///< frames
    bool over_ = false; ///< the visit has ended
    std::optional<std::uint64_t> first_state_;
    long other_states_ = 0;
    bool saved_ = false; ///< a layout is saved and not yet shown
    bool unsaved_ = false; ///< a layout could not be saved
    std::unique_ptr<SeededVisitor> visitor_;
    Progress progress_;
    Clock::time_point began_ = Clock::now();
};

int soak(const SoakOptions& options)
{
    if (!has_display())
        throw InputError("There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere); for a soak Xvfb will "
                         "do: xvfb-run starbow soak");
    // Whatever can be wrong is read before the first file is written.
    const Words words = words_in("en");
    const SessionContent content
        = use_of(options.as) == Use::tour ? content_of_tour(options.tour, words) : content_of_scene(options.scene);
    SoakLog log(options.log, options.as, options.seed, options.repeat);
    if (log.next_visit() >= options.visits)
        std::printf("All %ld visits of %s are over\n", options.visits, options.log.c_str());
    catch_interrupts();
    int status = 0;
    long other_states = 0;
    if (log.next_visit() < options.visits) {
        const SoakFolder folder;
        Visitors visitors(options, log, folder);
        ExhibitOptions exhibit;
        exhibit.content = content;
        exhibit.layout = load_layout(folder.layout());
        exhibit.words = words;
        exhibit.profiles = known_profiles();
        exhibit.quality = load_quality(shipped_file("qualities", "draft"));
        exhibit.menu_scenes = shipped_names("scenes"), exhibit.menu_tours = shipped_names("tours");
        exhibit.warms_up = false;
        exhibit.version = "soak";
        exhibit.paced = false;
        exhibit.counts_driver_memory = true;
        exhibit.state = folder.state();
        exhibit.textfile = folder.textfile();
        if (use_of(options.as) == Use::visitors)
            exhibit.visiting = visiting;
        exhibit.visit_over = [&](std::uint64_t state) { visitors.visit_over(state); };
        exhibit.visitor = [&](RecordEntry& entry) { visitors.act(entry); };
        exhibit.reloaded = [&] { visitors.reloaded(); };
        exhibit.over = [&] { return visitors.over(); };
        WindowSystem window_system;
        status = fly_exhibit(exhibit);
        other_states = visitors.other_states();
    }
    const SoakResult result = log.result(options.settled, options.devices);
    std::printf("%s", result.text.c_str());
    log.draw();
    if (other_states > 0)
        std::printf("%ld visits left the exhibit in another state than the first one\n", other_states);
    return status != 0 ? status : result.steady && other_states == 0 ? 0 : 1;
}

} // namespace

static void add_soak(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<SoakOptions>();
    Subcommand* command = app.add_subcommand(soak_tool.name, soak_tool.help);
    command->add_option("--visits", options->visits, "Number of visits")
        ->check(whole_number(1, 100000000))
        ->capture_default_str();
    command
        ->add_option("--as", options->as,
            "visitors of all kinds; a tour that nobody touches, or a flight with the stick, each of 50 frames a visit; or "
            "reloads of a layout, one a visit")
        ->check(one_of(std::vector<std::string>(use_names.begin(), use_names.end())))
        ->capture_default_str();
    command->add_option("--scene", options->scene, "Name or file of the scene that it begins with; a tour has its own")
        ->capture_default_str();
    command->add_option("--tour", options->tour, "Name or file of the tour that nobody touches")->capture_default_str();
    command->add_option("--seed", options->seed, "Another seed makes other visitors")
        ->check(whole_number(0, 1000000000))
        ->capture_default_str();
    command
        ->add_option("--repeat", options->repeat,
            "After this many visits the same visitors come again, and the comparison is of like with like: memory depends "
            "on the worlds that were shown last. 400 visits are compared; 0: all visitors are others")
        ->check(whole_number(0, 100000000))
        ->capture_default_str();
    command
        ->add_option(
            "--settled", options->settled, "The first visit of the comparison of memory, which caches fill until then")
        ->check(whole_number(1, 100000000))
        ->capture_default_str();
    command
        ->add_option("--devices", options->devices,
            "Number of devices that are plugged in and unplugged meanwhile; each has up to two files and a thread")
        ->check(whole_number(0, 100))
        ->capture_default_str();
    command
        ->add_option("--log", options->log,
            "This CSV file receives a line every twenty visits, and a picture beside it; a soak that was interrupted goes "
            "on where the file ends")
        ->capture_default_str();
    command->footer("Examples:\n  xvfb-run starbow soak\n  starbow soak --visits 30000 --log out/soak.csv\n"
                    "  LP_NUM_THREADS=1 xvfb-run starbow soak --as tour --visits 20000 --log out/tour.csv");
    command->callback([options, &chosen] { chosen = [options] { return soak(*options); }; });
}

static const Registered soak_command{13, add_soak};

} // namespace starbow
