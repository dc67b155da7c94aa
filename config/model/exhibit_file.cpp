#include "exhibit_file.h"
#include "exposing_reader.h"

namespace starbow {
namespace {

Flying read_flying(const Place& place)
{
    only(place,
        {"mode", "greatest_gamma", "turn_deg_per_s", "roll_deg_per_s", "turn_jerk_deg_per_s3", "rapidity_per_s",
            "rapidity_jerk_per_s2"});
    Flying flying;
    if (auto p = find(place, "mode"))
        flying.mode = chosen(*p, flight_modes);
    take(place, "greatest_gamma", flying.greatest_gamma, {1.001, 1e6});
    take(place, "turn_deg_per_s", flying.turn_deg_per_s, {0, 360, true});
    take(place, "roll_deg_per_s", flying.roll_deg_per_s, {0, 360});
    take(place, "turn_jerk_deg_per_s3", flying.turn_jerk_deg_per_s3, {1, 1e6});
    take(place, "rapidity_per_s", flying.rapidity_per_s, {0.01, 10});
    take(place, "rapidity_jerk_per_s2", flying.rapidity_jerk_per_s2, {0.01, 1e4});
    return flying;
}

/// Paths are the file's own, as in every other file; names are those of shipped ones.
std::string name_or_path(const Place& place, const std::filesystem::path& folder)
{
    const std::string name = text(place);
    const bool path = name.find('/') != name.npos || name.ends_with(".json");
    return path ? (folder / name).lexically_normal().string() : name;
}

} // namespace

Exposing read_exposing(const Place& place)
{
    only(place, {"automatic", "least_ev", "greatest_ev", "bloom"});
    Exposing exposure;
    take(place, "automatic", exposure.automatic);
    take(place, "least_ev", exposure.least_ev, {-60, 60});
    take(place, "greatest_ev", exposure.greatest_ev, {-60, 60});
    if (exposure.greatest_ev < exposure.least_ev) {
        const auto least = find(place, "least_ev");
        complain(least ? *least : member(place, "greatest_ev"),
            "leaves nothing between least_ev, " + shown(exposure.least_ev) + ", and greatest_ev, "
                + shown(exposure.greatest_ev) + "; a least_ev that is no greater is right");
    }
    take(place, "bloom", exposure.bloom, {0, 1});
    return exposure;
}

Exhibit load_exhibit(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    only(top,
        {"$schema", "layout", "scene", "shot", "tour", "language", "profiles", "tutorial", "quality", "hold_ms", "ladder",
            "flying", "exposure"});
    Exhibit exhibit;
    for (const auto& [name, value] :
        {std::pair{"layout", &exhibit.layout}, {"scene", &exhibit.scene}, {"shot", &exhibit.shot}, {"tour", &exhibit.tour},
            {"language", &exhibit.language}, {"quality", &exhibit.quality}, {"ladder", &exhibit.ladder}})
        if (auto p = find(top, name))
            *value = name_or_path(*p, folder);
    if (auto scene = find(top, "scene"); scene && !exhibit.shot.empty())
        complain(*scene, "is one too many beside a shot, which has a scene of its own; one of them is right");
    for (const char* other : {"scene", "shot"})
        if (auto place = find(top, other); place && !exhibit.tour.empty())
            complain(*place, "is one too many beside a tour, which has a scene of its own; one of them is right");
    if (auto p = find(top, "profiles"))
        exhibit.profiles = folder / text(*p);
    take(top, "tutorial", exhibit.tutorial);
    take(top, "hold_ms", exhibit.hold_ms, {0, 1000});
    if (auto p = find(top, "quality"); p && exhibit.hold_ms > 0)
        complain(*p, "is one too many beside hold_ms, which chooses it; one of them is right");
    if (auto p = find(top, "flying"))
        exhibit.flying = read_flying(*p);
    if (auto p = find(top, "exposure"))
        exhibit.exposure = read_exposing(*p);
    return exhibit;
}

} // namespace starbow
