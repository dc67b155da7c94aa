#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace starbow::testing {

/// Whether config/schema/NAME.schema.json, the one that editors use, accepts it.
bool schema_accepts(const std::string& name, const nlohmann::json& json);

} // namespace starbow::testing
