#include "open_exhibit.h"
#include "config/model/shipped.h"
#include "runtime/machines/interface.h"
#include "runtime/operation/state_folder.h"
#include <algorithm>

namespace starbow {

ExhibitOptions open_exhibit(const Exhibit& exhibit)
{
    Words words = words_in(exhibit.language);
    SessionContent content = !exhibit.tour.empty() ? content_of_tour(exhibit.tour, words)
        : !exhibit.shot.empty()                    ? content_of_shot(exhibit.shot)
                                                   : content_of_scene(exhibit.scene);
    ExhibitOptions options{.content = std::move(content),
        .layout = load_layout(shipped_file("layouts", exhibit.layout)),
        .words = std::move(words)};
    options.rules = exhibit.flying;
    options.paced_flight = exhibit.flying.paced;
    options.one_button = exhibit.one_button;
    options.left_handed = exhibit.left_handed;
    options.exposure = exhibit.exposure;
    options.profiles = known_profiles(exhibit.profiles);
    options.tutorial = exhibit.tutorial;
    options.speech = exhibit.speech;
    options.information = exhibit.information;
    options.menu_scenes = exhibit.menu.scenes.empty() ? shipped_names("scenes") : exhibit.menu.scenes;
    options.menu_tours = exhibit.menu.tours.empty() ? shipped_names("tours") : exhibit.menu.tours;
    if (!exhibit.quality.empty())
        options.quality = load_quality(shipped_file("qualities", exhibit.quality));
    options.quality_name = std::filesystem::path(exhibit.quality).stem();
    options.frame_budget_ms = exhibit.frame_budget_ms;
    if (options.frame_budget_ms > 0)
        options.ladder = load_ladder(shipped_file("qualities", exhibit.ladder));
    options.state = state_folder();
    options.textfile = exhibit.textfile;
    options.remote = exhibit.remote;
    options.presenter = exhibit.presenter;
    if (!exhibit.programme.empty())
        options.programme = load_programme(shipped_file("programmes", exhibit.programme));
    options.visiting = exhibit.visiting;
    if (options.visiting)
        for (std::size_t i = 0; i < options.visiting->attract.size(); ++i)
            attraction_of(options, options.words, i); // whatever is wrong in it is said now
    return options;
}

void check_machines(const Machines& machines, const Layout& layout, const std::string& node)
{
    const std::vector<std::string> nodes = nodes_of(layout);
    if (nodes.empty())
        throw InputError(
            layout.file.string(), "", "has no \"node\" at its outputs; one at each is right for several machines");
    std::string list;
    for (const std::string& one : nodes)
        list += (list.empty() ? "" : ", ") + one;
    if (!node.empty() && std::ranges::find(nodes, node) == nodes.end())
        throw InputError("--node " + node + " is none of the layout " + layout.name + "; one of these is right: " + list);
    if (std::ranges::find(nodes, machines.master) == nodes.end())
        throw InputError("The master of the exhibit's machines, \"" + machines.master + "\", is not a node of the layout "
            + layout.name + "; one of these is right: " + list);
    try {
        interface_of(machines.interface);
    } catch (const NoInterface&) { // it may come; a text that is no network won't
    }
}

std::string identity_of(const Machines& machines, const Layout& layout)
{
    if (!machines.exhibit.empty())
        return machines.exhibit;
    std::string identity = layout.file.stem().string();
    const char* between = ": ";
    for (const std::string& node : nodes_of(layout))
        identity += std::exchange(between, ", ") + node;
    return identity;
}

} // namespace starbow
