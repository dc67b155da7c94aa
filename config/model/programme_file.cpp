#include "describe_programme.h"
#include "shipped.h"
#include <algorithm>

namespace starbow {

std::string ShippedName::read(const Place& place, const Folder&) const
{
    const std::string name = text(place);
    const std::vector<std::string> all = shipped_names(kind);
    if (std::ranges::find(all, name) == all.end()) {
        std::string list;
        for (const std::string& one : all)
            list += (list.empty() ? "" : ", ") + one;
        fail_at(place, "is not among the shipped " + std::string(kind) + "; one of these is right: " + list);
    }
    return name;
}

LocalisedText NotesText::read(const Place& place, const Folder&) const
{
    if (!place.json->is_object())
        fail_at(place, "is not an object; { \"en\": \"...\", \"de\": \"...\" } is right");
    return read_saying(place);
}

Json NotesText::schema(Json&) const
{
    return Json::parse(
        R"({ "type": "object", "minProperties": 1, "additionalProperties": { "type": "string", "minLength": 1 } })");
}

void check(const Place& place, const ProgrammeItem& item, const Folder&)
{
    if (!item.tour.empty() + !item.scene.empty() + !item.shot.empty() != 1)
        fail_at(place, "shows nothing, or several things; exactly one of \"tour\", \"scene\" and \"shot\" is right");
}

std::pair<std::string, std::string> shown_by(const ProgrammeItem& item)
{
    if (!item.tour.empty())
        return {"tour", item.tour};
    return !item.scene.empty() ? std::pair<std::string, std::string>{"scene", item.scene}
                               : std::pair<std::string, std::string>{"shot", item.shot};
}

Programme load_programme(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read<Programme>(root(document), std::filesystem::absolute(file).parent_path());
}

} // namespace starbow
