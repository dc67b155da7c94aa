#pragma once
#include "config/json/describe.h"
#include "programme_file.h"

namespace starbow {

// Programmes, as config/json/describe.h says.

/// The name of a shipped file, of one of the folders of config/.
struct ShippedName : Text {
    const char* kind;
    std::string read(const Place& place, const Folder&) const;
};

/// A text in some languages.
struct NotesText {
    LocalisedText read(const Place& place, const Folder&) const;
    Json schema(Json&) const;
};

template <>
inline constexpr auto description<ProgrammeItem> = with_rules(
    describe<ProgrammeItem>("item", "A part of the show: exactly one tour, scene or shot.",
        field("tour", ShippedName{{}, "tours"}, "The tour that is shown, by the name of a shipped file.",
            &ProgrammeItem::tour),
        field("scene", ShippedName{{}, "scenes"}, "The world in which visitors fly, by the name of a shipped file.",
            &ProgrammeItem::scene),
        field("shot", ShippedName{{}, "shots"}, "The view that is shown, by the name of a shipped file.",
            &ProgrammeItem::shot),
        needed("minutes", Number{{0.1, 600}},
            "The planned time, minutes. The guide's timer shows it; nothing ends by itself.", &ProgrammeItem::minutes),
        field("notes", NotesText{}, "What the guide wants to say, by language. Visitors do not see it.",
            &ProgrammeItem::notes)),
    R"({ "oneOf": [{ "required": ["tour"] }, { "required": ["scene"] }, { "required": ["shot"] }] })");
static_assert(is_complete<ProgrammeItem>());
void check(const Place& place, const ProgrammeItem& item, const Folder&);

template <>
inline constexpr auto description<Programme> = describe_file<Programme>("programme",
    "A show that a guide gives: its parts in order, with notes and planned times.",
    needed("items", List{Object<ProgrammeItem>{}, 1, 100, "items"}, "The parts of the show, one after the other.",
        &Programme::items));
static_assert(is_complete<Programme>());

} // namespace starbow
