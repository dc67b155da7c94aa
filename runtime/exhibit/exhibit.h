#pragma once
#include "config/model/exhibit_file.h"
#include "config/model/exposing.h"
#include "config/model/flying.h"
#include "config/model/information.h"
#include "config/model/layout.h"
#include "config/model/one_button.h"
#include "config/model/presenting.h"
#include "config/model/profile.h"
#include "config/model/programme_file.h"
#include "config/model/remote_file.h"
#include "config/model/visiting.h"
#include "config/model/words.h"
#include "runtime/flight/record.h"
#include "runtime/operation/latency.h"
#include "runtime/render/frame_renderer.h"
#include "session_content.h"
#include <filesystem>
#include <functional>
#include <optional>

namespace starbow {

class Trace;

/// Everything that an exhibit starts with, its files read.
struct ExhibitOptions {
    SessionContent content;
    Layout layout;
    Words words; ///< for the visitor's texts
    Flying rules{};
    bool paced_flight = false; ///< the visitors gain speed at each world's own pace
    std::optional<OneButton> one_button{}; ///< the visitors fly with one button; none: where they choose so
    bool left_handed = false; ///< the controls, from the start of each visit
    Exposing exposure{};
    std::vector<Profile> profiles{};
    bool tutorial = true;
    bool speech = false; ///< captions, descriptions and goals are read aloud
    Information information = Information::laboratory; ///< the first display of information
    std::vector<std::string> menu_scenes{}, menu_tours{}; ///< that visitors can choose, names of shipped ones
    std::optional<Programme> programme{}; ///< of a guide's show; none: there is none
    std::optional<Visiting> visiting{}; ///< the exhibit attends to its visitors itself; none: somebody else does
    bool careful = false; ///< the exhibit starts with care after disorderly ends; for the service manager's status
    std::optional<Quality> quality{}; ///< none: the device's default
    double frame_budget_ms = 0; ///< time of a whole frame; 0: the quality stays fixed
    std::vector<PresetLevel> ladder{}; ///< the qualities between which the governor moves
    std::optional<bool> warms_up{}; ///< compiles all pipelines of the switches before the first frame; none: only on a GPU
    long frames = 0; ///< number of frames to show; 0: until the visitor leaves
    Pattern pattern = Pattern::none; ///< the first test pattern
    std::filesystem::path record{}; ///< file or folder for the record, or folder for a record of each visit; empty: none
    std::filesystem::path log{}; ///< CSV file of the instruments' readings; empty: none
    bool by_eye = false; ///< the instruments have scales alone, and the key of the log asks for a reading
    double log_every_s = 0; ///< interval of automatic lines; 0: only at a key
    std::filesystem::path replay{}; ///< a record that is flown instead of the visitor's flight; empty: none
    Trace* trace = nullptr; ///< receives the spans of each frame; null: none. It must outlive the flight
    std::function<void(const FrameTimes&)> timed{}; ///< is called for each frame
    RemoteSettings remote{}; ///< port 0: none
    std::optional<Machines> machines{}; ///< the others of this exhibit; none: this one shows all
    std::string node{}; ///< the name of this one among them
    std::filesystem::path frame_log{}; ///< receives the frames that this one shows; empty: none
    std::optional<Presenting> presenter{}; ///< the guide's window; none: there is none
    std::string quality_name{}; ///< of quality, for the remote; empty: the ladder's, or the device's default
    std::filesystem::path cache{}; ///< folder of the small pictures; empty: none are shown
    std::filesystem::path state{}; ///< folder of the days' counts; empty: none are kept
    std::filesystem::path textfile{}; ///< receives the counts for node_exporter; empty: none
    std::string version{}; ///< the program's, for the counts
    bool paced = true; ///< frames keep the screen's rate
    bool counts_driver_memory = false; ///< for driver_memory()
    /// Takes the visitor's place: receives each frame's entry, its devices already read, and writes its own controls and
    /// time.
    std::function<void(RecordEntry&)> visitor{};
    std::function<void(std::uint64_t)> visit_over{}; ///< receives the digest of the state that a visit's end has restored
    std::function<void()> reloaded{}; ///< is called after each changed layout, applied or refused
    std::function<bool()> over{}; ///< is called before each frame; true ends the flight
};

/// An attraction, counted on from 0: a tour, or the start of the flight where the exhibit has none. Throws InputError.
SessionContent attraction_of(const ExhibitOptions& options, const Words& words, std::size_t number);

/// Flies until the visitor leaves. Follows changes of the layout's files and of the monitors, and recovers from the loss
/// of the GPU. Returns the exit status. Throws InputError or vk::SystemError for errors before
/// the first picture.
int fly_exhibit(const ExhibitOptions& options);

} // namespace starbow
