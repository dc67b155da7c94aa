#include "schemas.h"
#include "describe_exhibit.h"
#include "describe_layout.h"
#include "describe_quality.h"

namespace starbow {
namespace {

template <class... Files> std::vector<std::pair<std::string_view, Json (*)()>> all()
{
    return {{description<Files>.name, file_schema<Files>}...};
}
const std::vector<std::pair<std::string_view, Json (*)()>>& schemas()
{
    static const auto known = all<Exhibit, Layout, Quality, Ladder>();
    return known;
}

} // namespace

std::vector<std::string> kinds_with_schema()
{
    std::vector<std::string> names;
    for (const auto& [name, schema] : schemas())
        names.emplace_back(name);
    return names;
}

std::string schema_text(const std::string& kind)
{
    return schemas()[index_named(kind, names_of(schemas()), "kind of file")].second().dump(4) + "\n";
}

} // namespace starbow
