#include "exhibit_lines.h"
#include "config/model/shipped.h"
#include "runtime/exhibit/machine_files.h"
#include "runtime/exhibit/open_exhibit.h"
#include <cstdio>

namespace starbow {
namespace {

void print_machines(const Machines& machines, const Layout& layout)
{
    check_machines(machines, layout);
    for (const std::string& node : nodes_of(layout)) {
        std::string outputs;
        for (const Output& output : layout.outputs)
            if (is_shown_by(node, output))
                outputs += (outputs.empty() ? "" : ", ") + output.name;
        std::printf("machine %s%s: %s\n", node.c_str(), node == machines.master ? ", the master" : "", outputs.c_str());
    }
    std::printf("exhibit's identity on the network: %s\n", identity_of(machines, layout).c_str());
    try {
        const NetworkInterface interface = interface_of(machines.interface);
        std::printf("network: interface %s, %s here, domain %d\n", interface.name.c_str(), interface.address.c_str(),
            machines.domain);
        if (interface.loopback)
            std::printf("note: interface %s reaches no other machine; it is right where all nodes run on this one\n",
                interface.name.c_str());
        if (const std::string warning = warning_of_routes(interface); !warning.empty())
            std::printf("note: %s\n", warning.c_str());
    } catch (const NoInterface& error) { // the check may run at a desk, before anything is wired
        std::printf("note: %s. Here the machine would show its outputs alone, and wait for the network\n", error.what());
    }
}

} // namespace

std::string print_exhibit(const std::string& file)
{
    const Exhibit exhibit = load_exhibit(shipped_file("exhibits", file));
    const ExhibitOptions options = open_exhibit(exhibit);
    std::printf("exhibit %s: layout %s, world %s, words %s\n", std::filesystem::path(file).stem().c_str(),
        options.layout.name.c_str(), options.content.scene.stem().c_str(), options.words.language.c_str());
    if (exhibit.machines)
        print_machines(*exhibit.machines, options.layout);
    else if (!nodes_of(options.layout).empty())
        std::printf("note: the layout's outputs have machines, and the exhibit has none: this one shows all\n");
    return options.layout.file.string();
}

} // namespace starbow
