#include "session_content.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/hud/highlights.h"
#include "runtime/operation/record_files.h"
#include "runtime/visit/shown_record.h"
#include "runtime/visit/tour_player.h"
#include "runtime/world/open_scene.h"

namespace starbow {

SessionContent content_of_scene(const std::string& scene)
{
    const std::filesystem::path file = shipped_file("scenes", scene);
    return {.scene = file, .start = open_scene(file).start};
}

SessionContent content_of_shot(const std::string& shot)
{
    const std::filesystem::path file = shipped_file("shots", shot);
    Shot start = load_shot(file);
    const std::filesystem::path scene = scene_of(start, file);
    return {.scene = scene, .start = std::move(start), .shot = shot};
}

SessionContent content_of_record(const std::filesystem::path& record)
{
    const ShownRecord flown(record);
    const RecordHeader& header = flown.header();
    return {.scene = find_flown(record, header, "desk", [](LogKind, const std::string&) {}).scene,
        .start = header.start,
        .record = record};
}

SessionContent content_of_tour(const std::string& name, const Words& words)
{
    Tour tour = tour_in(name, words);
    const std::filesystem::path scene = scene_of(tour);
    check_highlights(tour, open_scene(scene));
    const Shot start = std::get<Cut>(tour.steps[0].motion).shot;
    return {.scene = scene, .start = start, .tour_name = name, .tour = std::move(tour)};
}

std::vector<Announcements> announcements_of(const std::string& tour)
{
    std::vector<Announcements> all;
    for (const std::string& language : tour.empty() ? std::vector<std::string>() : shipped_names("words"))
        try {
            Announcements one{language, {}};
            for (const Step& step : tour_in(tour, words_in(language)).steps)
                one.texts.push_back(announced(step));
            all.push_back(std::move(one));
        } catch (const InputError&) {
            // A site's own words, or the tour's own texts, lack it: the remote's page takes another language.
        }
    return all;
}

} // namespace starbow
