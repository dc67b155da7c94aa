#include "file_kind.h"
#include "config/json/file_name.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include <array>

namespace starbow {
namespace {

struct KindName {
    const char* name; ///< with its article
    const char* use; ///< before the file's name, what takes it
};
/// In the order of FileKind.
constexpr std::array<KindName, 9> kinds{{{"a glTF world", "run --scene "}, {"a scene", "run --scene "},
    {"a layout", "run --layout "}, {"a tour", "run --tour "}, {"a shot", "run --shot "}, {"an exhibit", "run --exhibit "},
    {"a quality", "run --quality "}, {"a language's words", "run --language "}, {"a programme", "run --programme "}}};

std::optional<FileKind> kind_of(const nlohmann::json& root)
{
    if (!root.is_object())
        return {};
    const auto any = [&](std::initializer_list<const char*> members) {
        return std::any_of(members.begin(), members.end(), [&](const char* member) { return root.contains(member); });
    };
    // Each by the members that no other kind has, in this order.
    if (const auto asset = root.find("asset"); asset != root.end() && asset->is_object())
        return FileKind::gltf;
    if (any({"outputs"}))
        return FileKind::layout;
    if (any({"steps"}))
        return FileKind::tour;
    if (any({"items"}))
        return FileKind::programme;
    if (any({"texels_per_pixel", "max_texels_per_pixel", "cube_samples"}))
        return FileKind::quality;
    if (any({"gltf"}))
        return FileKind::scene;
    if (any({"layout", "visit", "flying", "menu", "information", "comfort", "remote"}))
        return FileKind::exhibit;
    if (any({"position", "look", "velocity"}) && any({"scene"}))
        return FileKind::shot;
    if (any({"hud.speed"}))
        return FileKind::words;
    return {};
}

} // namespace

std::optional<FileKind> kind_of_file(const std::filesystem::path& path)
{
    const bool named_gltf = ending_of(path) == ".gltf" || ending_of(path) == ".glb";
    const std::optional<FileKind> by_name = named_gltf ? std::optional(FileKind::gltf) : std::nullopt;
    RegularFile file(path);
    std::string begin(4, '\0');
    begin.resize(file.read(begin));
    if (file.has_fault())
        return by_name;
    if (begin == "glTF")
        return FileKind::gltf;
    try {
        if (const auto kind = kind_of(read_document(path).root))
            return kind;
    } catch (const InputError&) {
        // It may be too large for a document, or broken: its reader says so.
    }
    return by_name;
}

void reject_other_kind(const std::filesystem::path& file, FileKind wanted)
{
    const std::optional<FileKind> kind = kind_of_file(file);
    if (!kind || *kind == wanted || (*kind == FileKind::gltf && wanted == FileKind::scene))
        return;
    const KindName &is = kinds[std::size_t(*kind)], &right = kinds[std::size_t(wanted)];
    const std::string name = one_line(file.string());
    throw InputError(name, "",
        std::string("is ") + is.name + "; " + right.name + " is right here, and starbow " + is.use + name + " takes it");
}

} // namespace starbow
