#include "session_content.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/hud/highlights.h"
#include "runtime/operation/record_files.h"
#include "runtime/visit/shown_record.h"
#include "runtime/world/open_scene.h"

namespace starbow {

static bool has_stars(const std::filesystem::path& scene) { return open_scene(scene).stars.has_value(); }

SessionContent content_of_scene(const std::string& scene)
{
    const std::filesystem::path file = shipped_file("scenes", scene);
    SceneFile scene_file = open_scene(file);
    return {.scene = file, .start = std::move(scene_file.start), .has_stars = scene_file.stars.has_value()};
}

SessionContent content_of_shot(const std::string& shot)
{
    const std::filesystem::path file = shipped_file("shots", shot);
    Shot start = load_shot(file);
    const std::filesystem::path scene = scene_of(start, file);
    return {.scene = scene, .start = std::move(start), .has_stars = has_stars(scene), .shot = shot};
}

SessionContent content_of_record(const std::filesystem::path& record)
{
    const ShownRecord flown(record);
    const RecordHeader& header = flown.header();
    const std::filesystem::path scene = find_flown(record, header, "desk", [](LogKind, const std::string&) {}).scene;
    return {.scene = scene, .start = header.start, .has_stars = has_stars(scene), .record = record};
}

SessionContent content_of_tour(const std::string& name, const Words& words)
{
    Tour tour = tour_in(name, words);
    const std::filesystem::path scene = scene_of(tour);
    const SceneFile opened = open_scene(scene);
    check_highlights(tour, opened);
    const Shot start = std::get<Cut>(tour.steps[0].motion).shot;
    return {
        .scene = scene, .start = start, .has_stars = opened.stars.has_value(), .tour_name = name, .tour = std::move(tour)};
}

} // namespace starbow
