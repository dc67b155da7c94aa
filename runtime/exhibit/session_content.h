#pragma once
#include "config/model/shot.h"
#include "config/model/tour_file.h"
#include "config/model/words.h"
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// The shown part of an exhibit: a scene, the start of the visit in it, and perhaps a tour through it.
struct SessionContent {
    std::filesystem::path scene;
    Shot start; ///< a reset returns here
    std::string shot{}; ///< name or path of the start's shot; empty: the scene's own start, or the tour's
    std::string tour_name{}; ///< name or path; empty: no tour
    std::optional<Tour> tour{};
    std::filesystem::path record{}; ///< a flight that is shown as it was flown; empty: none
};

/// The captions and questions of a tour's steps in one language, before they are shown.
struct Announcements {
    std::string language; ///< its name
    std::vector<std::string> texts; ///< one for each step
};

/// Those of a tour, by name or path, in all languages that have its texts; none for an empty name.
std::vector<Announcements> announcements_of(const std::string& tour);

/// Each reads and checks the files of the content, by the name of a shipped one or a path. Throws InputError.
SessionContent content_of_scene(const std::string& scene);
SessionContent content_of_shot(const std::string& shot); ///< in the shot's own scene
SessionContent content_of_record(const std::filesystem::path& record); ///< in the record's own scene
SessionContent content_of_tour(const std::string& tour, const Words& words); ///< in the tour's own scene

} // namespace starbow
