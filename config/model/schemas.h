#pragma once
#include <string>
#include <vector>

namespace starbow {

/// The kinds of files that have a JSON schema: "quality", "ladder", ...
std::vector<std::string> kinds_with_schema();
/// The JSON schema (draft 7) of a kind of file, for editors. Throws InputError for an unknown kind.
std::string schema_text(const std::string& kind);

/// Every member of a kind of file for people: its meaning, its limits, its usual value, at most 100 letters a line. Throws as
/// schema_text.
std::string members_text(const std::string& kind);

} // namespace starbow
