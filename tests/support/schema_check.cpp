#include "schema_check.h"
#include "files.h"
#include <map>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace starbow::testing {

bool schema_accepts(const std::string& name, const nlohmann::json& json)
{
    static std::map<std::string, valijson::Schema> compiled;
    const auto [at, fresh] = compiled.try_emplace(name);
    if (fresh) {
        const auto text = nlohmann::json::parse(read_text(source_dir() / "config/schema" / (name + ".schema.json")));
        valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(text), at->second);
    }
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    return validator.validate(at->second, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
}

} // namespace starbow::testing
