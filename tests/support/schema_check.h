#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace starbow::testing {

/// Returns true if config/schema/NAME.schema.json, which editors use, accepts `json`.
bool schema_accepts(const std::string& name, const nlohmann::json& json);

} // namespace starbow::testing
