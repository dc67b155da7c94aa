#include "config/json/file_name.h"
#include "parts.h"
#include <algorithm>

namespace starbow {

// Each stands in the file of its name.
extern const WarpFormat bourke_format, mpcdi_format, pfm_format, domeprojection_format, simcad_format, sciss_format,
    scalable_format, skyskan_format, obj_format, headset_format;

std::span<const WarpFormat* const> warp_formats()
{
    static constexpr const WarpFormat* all[]{&bourke_format, &mpcdi_format, &pfm_format, &domeprojection_format,
        &simcad_format, &sciss_format, &scalable_format, &skyskan_format, &obj_format, &headset_format};
    return all;
}

namespace {

WarpStart start_of(std::string_view bytes)
{
    std::string_view text = bytes;
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return {bytes, text, text.substr(0, std::min(text.find_first_of("\r\n"), text.size()))};
}

/// Null for an unknown format.
const WarpFormat* format_of(const WarpFile& file)
{
    const WarpStart start = start_of(file.content);
    const std::string ending = ending_of(file.name);
    const auto first = [](auto&& is) -> const WarpFormat* {
        const auto found = std::ranges::find_if(warp_formats(), is);
        return found == warp_formats().end() ? nullptr : *found;
    };
    if (const auto* sure = first([&](const WarpFormat* one) { return one->begins && one->begins(start); }))
        return sure;
    if (const auto* named = first([&](const WarpFormat* one) {
            return !ending.empty() && std::ranges::find(one->endings, ending) != one->endings.end();
        }))
        return named;
    return first([&](const WarpFormat* one) { return one->seems && one->seems(start); });
}

/// "a Bourke mesh (.data), MPCDI (.mpcdi) or headset mesh"
std::string names_of_all()
{
    std::string names = "a ";
    for (const WarpFormat* one : warp_formats()) {
        if (one != warp_formats().front())
            names += one == warp_formats().back() ? " or " : ", ";
        names += one->name;
        if (!one->endings[0].empty())
            names.append(" (").append(one->endings[0]).append(")");
    }
    return names;
}

} // namespace

WarpMesh read_warp(const WarpFile& file, const WarpReading& reading)
{
    if (file.content.empty())
        refuse(file, "", "is empty; a warp file is right");
    const WarpFormat* format = format_of(file);
    const auto& [region, form, aspect] = reading;
    if (!region.empty() && !(format && format->has_regions))
        refuse(file, "", "has no regions, and " + in_quotes(region) + " is wanted; an MPCDI file, or no region, is right");
    if (form != FloatMapForm() && !(format && format->has_form))
        refuse(file, "",
            std::string(form.first_row_on_top ? "has no first row to choose"
                    : form.offsets            ? "holds no offsets"
                    : form.v_up               ? "says itself whether v counts up or down"
                                              : "says itself where its samples lie")
                + "; an MPCDI or PFM file, or leaving that out, is right");
    if (aspect && !(format && format->has_aspect))
        refuse(file, "",
            "counts in fractions of the viewport, whose aspect it does not need; a Bourke mesh, or no aspect, is right");
    if (form.offsets && (form.v_up || form.edge_to_edge))
        refuse(file, "",
            "holds offsets, which are upwards and from edge to edge; places, or no word of v and samples, is right");
    if (!format)
        refuse(file, "", "is not a warp file that is known; " + names_of_all() + " is right");
    return format->read(file, reading);
}

} // namespace starbow
