#include "shaders.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/render/shader_costs.h"
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ShaderCosts& costs, const std::string& family)
{
    Json all{{"card", costs.card}, {"family", family}};
    for (const ShaderCost& cost : costs.shaders)
        for (std::size_t i = 0; i < shader_figures.size(); ++i)
            all["shaders"][cost.pass][cost.variant][shader_figures[i].title] = cost.figures[i];
    return all;
}

Json read_against(const std::filesystem::path& file, const std::string& family)
{
    const Json old = Json::parse(read_whole(file, 100 << 20, "a file that bench --shaders --json wrote"), nullptr, false);
    if (!old.is_object() || !old.value("shaders", Json()).is_object() || !old.value("family", Json()).is_string())
        throw InputError(file.string() + ": is no table of shaders; a file that bench --shaders --json wrote is right");
    if (old["family"] != family)
        throw InputError(file.string() + ": is of " + old["family"].get<std::string>() + "; one of " + family + " is right");
    return old;
}

/// A heading, and a row of each pass: the median and the worst of its variants.
void print_passes(const ShaderCosts& costs)
{
    std::printf("%-28s%9s", "median, worst", "variants");
    for (const ShaderFigure& figure : shader_figures)
        std::printf("%15s", figure.title);
    std::map<std::string, std::vector<const ShaderCost*>> passes;
    for (const ShaderCost& cost : costs.shaders)
        passes[cost.pass].push_back(&cost);
    for (const auto& [name, variants] : passes) {
        std::printf("\n%-28s%9zu", name.c_str(), variants.size());
        for (std::size_t i = 0; i < shader_figures.size(); ++i) {
            std::vector<double> values;
            for (const ShaderCost* cost : variants)
                values.push_back(cost->figures[i]);
            std::printf("%8.0f%7.0f", median(values),
                shader_figures[i].least_is_worst ? *std::ranges::min_element(values) : *std::ranges::max_element(values));
        }
    }
    std::printf("\n");
}

/// A heading, and a row of each variant of one pass.
void print_variants(const ShaderCosts& costs, const std::string& pass)
{
    for (const ShaderFigure& figure : shader_figures)
        std::printf("%13s", figure.title);
    std::printf("\n");
    for (const ShaderCost& cost : costs.shaders)
        if (cost.pass == pass) {
            for (const double figure : cost.figures)
                std::printf("%13.0f", figure);
            std::printf("  %s\n", cost.variant.c_str());
        }
}

/// Prints the changes since an earlier table, pass by pass: the numbers of new and of missing variants, and of the variants
/// in both tables the sum of cycles and the most registers.
void print_changes(const Json& now, const Json& before)
{
    std::printf("\n%-28s%9s%9s%22s%16s\n", "changed", "new", "gone", "cycles of the others", "most VGPRs");
    for (const auto& [pass, variants] : now["shaders"].items()) {
        const Json old = before["shaders"].value(pass, Json::object());
        double cycles[2]{}, registers[2]{};
        std::size_t both = 0;
        bool changed = old.size() != variants.size();
        for (const auto& [variant, figures] : variants.items()) {
            if (!old.contains(variant))
                continue;
            ++both;
            changed = changed || old[variant] != figures;
            for (const auto& [k, table] : {std::pair(0, &old[variant]), std::pair(1, &figures)}) {
                cycles[k] += table->value("cycles", 0.0);
                registers[k] = std::max(registers[k], table->value("VGPRs", 0.0));
            }
        }
        if (changed || both != variants.size())
            std::printf("%-28s%9zu%9zu%14.0f %+6.1f %%%8.0f ->%5.0f\n", pass.c_str(), variants.size() - both,
                old.size() - both, cycles[1], both ? 100 * (cycles[1] / cycles[0] - 1) : 0, registers[0], registers[1]);
    }
    for (const auto& [pass, variants] : before["shaders"].items())
        if (!now["shaders"].contains(pass))
            std::printf("%-28s%9d%9zu\n", pass.c_str(), 0, variants.size());
}

} // namespace

void bench_shaders(const std::string& family, const std::string& pass, const std::string& scene,
    const std::filesystem::path& json, const std::filesystem::path& against)
{
    const Json before = against.empty() ? Json() : read_against(against, family);
    if (!json.empty())
        check_writable(json);
    std::vector<std::filesystem::path> scenes;
    for (const std::string& name : scene.empty() ? shipped_names("scenes") : std::vector{scene})
        scenes.push_back(shipped_file("scenes", name));
    const bool whole = !json.empty() || !against.empty(); // a table of all passes
    const ShaderCosts costs = shader_costs(scenes, family, whole ? "" : pass);
    const Json now = json_of(costs, family);
    if (!pass.empty() && !now["shaders"].contains(pass))
        throw InputError("--pass: " + pass + " is no pass; warp, or another of those that bench --shaders prints, is right");
    std::printf("%s; the compiler's figures, the same on every machine with this Mesa\n\n", costs.card.c_str());
    if (pass.empty())
        print_passes(costs);
    else
        print_variants(costs, pass);
    if (!against.empty())
        print_changes(now, before);
    if (json.empty())
        return;
    make_folder_of(json);
    write_whole(json, now.dump(1) + "\n");
}

} // namespace starbow
