#include "exhibit_file.h"
#include "comfort_reader.h"
#include "exposing_reader.h"
#include "layout_reader.h"
#include "remote_reader.h"
#include "shipped.h"
#include <algorithm>

namespace starbow {
namespace {

Flying read_flying(const Place& place, bool& paced)
{
    reject_unknown_members(place,
        {"mode", "max_gamma", "turn_deg_per_s", "roll_deg_per_s", "turn_jerk_deg_per_s3", "rapidity_per_s",
            "rapidity_jerk_per_s2", "paced"});
    Flying flying;
    if (auto p = find_member(place, "mode"))
        flying.mode = chosen(*p, flight_modes);
    take(place, "max_gamma", flying.max_gamma, {1.001, 1e6});
    take(place, "turn_deg_per_s", flying.turn_deg_per_s, {0, 360, true});
    take(place, "roll_deg_per_s", flying.roll_deg_per_s, {0, 360});
    take(place, "turn_jerk_deg_per_s3", flying.turn_jerk_deg_per_s3, {1, 1e6});
    take(place, "rapidity_per_s", flying.rapidity_per_s, {0.01, 10});
    take(place, "rapidity_jerk_per_s2", flying.rapidity_jerk_per_s2, {0.01, 1e4});
    take(place, "paced", paced);
    return flying;
}

/// A path is relative to the file, as in all files; a name means a shipped file.
std::string name_or_path(const Place& place, const std::filesystem::path& folder)
{
    const std::string name = text(place);
    const bool path = name.find('/') != name.npos || name.ends_with(".json") || name.ends_with(".jsonl");
    return path ? (folder / name).lexically_normal().string() : name;
}

Visiting read_visiting(const Place& place, const std::filesystem::path& folder)
{
    reject_unknown_members(place, {"idle_s", "ask_s", "longest_s", "fade_s", "unlock", "attract"});
    Visiting visiting;
    take(place, "idle_s", visiting.idle_s, {5, 3600});
    take(place, "ask_s", visiting.ask_s, {0, 300});
    take(place, "longest_s", visiting.longest_s, {0, 86400});
    take(place, "fade_s", visiting.fade_s, {0, 5});
    if (auto unlock = find_member(place, "unlock")) {
        visiting.unlock = text(*unlock);
        const bool typeable = visiting.unlock.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz") == std::string::npos;
        if (!typeable || visiting.unlock.size() < 4 || visiting.unlock.size() > 32)
            complain(*unlock, "can't be typed blind; 4 to 32 small letters and digits are right");
    }
    if (auto attract = find_member(place, "attract"))
        for (const Place& name : items(*attract, 0, 100, "tours and records"))
            visiting.attract.push_back(name_or_path(name, folder));
    return visiting;
}

} // namespace

Comfort read_comfort(const Place& place)
{
    reject_unknown_members(place, {"no_roll", "level_horizon", "turn_steps_deg", "vignette"});
    Comfort comfort;
    take(place, "no_roll", comfort.no_roll);
    take(place, "level_horizon", comfort.level_horizon);
    take(place, "turn_steps_deg", comfort.turn_steps_deg, {5, 45});
    if (const auto p = find_member(place, "vignette")) {
        if (comfort.turn_steps_deg > 0)
            complain(*p, "conflicts with turn_steps_deg, which leaves no smooth turn; one of them is right");
        reject_unknown_members(*p, {"elevation_deg", "clear_deg", "soft_deg", "darkness"});
        Vignette& vignette = comfort.vignette.emplace();
        take(*p, "elevation_deg", vignette.elevation_deg, {-90, 90});
        take(*p, "clear_deg", vignette.clear_deg, {0, 120});
        take(*p, "soft_deg", vignette.soft_deg, {1, 60});
        take(*p, "darkness", vignette.darkness, {0, 1, true});
    }
    return comfort;
}

Exposing read_exposing(const Place& place)
{
    reject_unknown_members(place, {"mode", "automatic", "min_ev", "max_ev", "bloom"});
    Exposing exposure;
    if (const auto p = find_member(place, "mode"))
        exposure.mode = chosen(*p, exposure_modes);
    take(place, "automatic", exposure.automatic);
    take(place, "min_ev", exposure.min_ev, {-60, 60});
    take(place, "max_ev", exposure.max_ev, {-60, 60});
    if (exposure.max_ev < exposure.min_ev) {
        const auto least = find_member(place, "min_ev");
        complain(least ? *least : member(place, "max_ev"),
            "leaves nothing between min_ev, " + shown(exposure.min_ev) + ", and max_ev, " + shown(exposure.max_ev)
                + "; a min_ev that is no greater is right");
    }
    if (auto p = find_member(place, "bloom"))
        exposure.bloom = number(*p, {0, 1});
    return exposure;
}

/// The name of a shipped file of a kind.
std::string shipped_name(const Place& place, const std::string& kind)
{
    const std::string name = text(place);
    const std::vector<std::string> all = shipped_names(kind);
    if (std::ranges::find(all, name) == all.end()) {
        std::string list;
        for (const std::string& one : all)
            list += (list.empty() ? "" : ", ") + one;
        complain(place, "is not among the shipped " + kind + "; one of these is right: " + list);
    }
    return name;
}

Exhibit load_exhibit(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    reject_unknown_members(top,
        {"$schema", "layout", "scene", "shot", "tour", "language", "profiles", "tutorial", "quality", "frame_budget_ms",
            "ladder", "flying", "exposure", "textfile", "remote", "presenter", "visit", "menu", "calm", "information",
            "speech", "comfort", "one_button", "left_handed", "machines"});
    Exhibit exhibit;
    for (const auto& [name, value] :
        {std::pair{"layout", &exhibit.layout}, {"scene", &exhibit.scene}, {"shot", &exhibit.shot}, {"tour", &exhibit.tour},
            {"language", &exhibit.language}, {"quality", &exhibit.quality}, {"ladder", &exhibit.ladder}})
        if (auto p = find_member(top, name))
            *value = name_or_path(*p, folder);
    if (auto scene = find_member(top, "scene"); scene && !exhibit.shot.empty())
        complain(*scene, "conflicts with the shot, which has a scene of its own; one of them is right");
    for (const char* other : {"scene", "shot"})
        if (auto place = find_member(top, other); place && !exhibit.tour.empty())
            complain(*place, "conflicts with the tour, which has a scene of its own; one of them is right");
    if (auto p = find_member(top, "textfile"))
        exhibit.textfile = (folder / text(*p)).lexically_normal();
    if (auto p = find_member(top, "profiles"))
        exhibit.profiles = folder / text(*p);
    if (auto p = find_member(top, "information"))
        exhibit.information = chosen(*p, informations);
    take(top, "speech", exhibit.speech);
    take(top, "tutorial", exhibit.tutorial);
    take(top, "frame_budget_ms", exhibit.frame_budget_ms, {0, 1000});
    if (auto p = find_member(top, "quality"); p && exhibit.frame_budget_ms > 0)
        complain(*p, "conflicts with frame_budget_ms, which chooses the quality; one of them is right");
    if (auto p = find_member(top, "flying"))
        exhibit.flying = read_flying(*p, exhibit.paced);
    if (auto p = find_member(top, "one_button")) {
        reject_unknown_members(*p, {"scan_s", "act_s"});
        OneButton& one_button = exhibit.one_button.emplace();
        take(*p, "scan_s", one_button.scan_s, {0.5, 10});
        take(*p, "act_s", one_button.act_s, {0.1, 10});
    }
    take(top, "left_handed", exhibit.left_handed);
    if (auto p = find_member(top, "comfort"))
        exhibit.flying.comfort = read_comfort(*p);
    if (auto p = find_member(top, "exposure"))
        exhibit.exposure = read_exposing(*p);
    take(top, "calm", exhibit.exposure.calm);
    if (auto p = find_member(top, "remote"))
        exhibit.remote = read_remote(*p, folder);
    if (auto p = find_member(top, "presenter")) {
        reject_unknown_members(*p, {"monitor"});
        exhibit.presenter.emplace();
        if (auto monitor = find_member(*p, "monitor"))
            exhibit.presenter->monitor = read_monitor(*monitor);
    }
    if (auto p = find_member(top, "machines")) {
        reject_unknown_members(*p, {"master", "interface", "domain", "exhibit"});
        Machines& machines = exhibit.machines.emplace();
        machines.master = text(member(*p, "master"));
        machines.interface = text(member(*p, "interface"));
        if (auto domain = find_member(*p, "domain"))
            machines.domain = integer(*domain, 0, 200);
        if (auto identity = find_member(*p, "exhibit")) {
            machines.exhibit = text(*identity);
            if (machines.exhibit.empty() || machines.exhibit.size() > 64)
                complain(*identity, "can't name an exhibit; 1 to 64 letters, the same on each of its machines, are right");
        }
    }
    if (auto p = find_member(top, "visit"))
        exhibit.visiting = read_visiting(*p, folder);
    if (auto menu = find_member(top, "menu")) {
        reject_unknown_members(*menu, {"scenes", "tours"});
        for (const auto& [name, names] : {std::pair{"scenes", &exhibit.menu_scenes}, {"tours", &exhibit.menu_tours}})
            if (auto p = find_member(*menu, name))
                for (const Place& one : items(*p, 1, 20, "names of shipped files"))
                    names->push_back(shipped_name(one, name));
    }
    return exhibit;
}

} // namespace starbow
