#pragma once
#include <filesystem>
#include <optional>

namespace starbow {

/// The kinds of files that people give by their path.
enum class FileKind { gltf, scene, layout, tour, shot, exhibit, quality, words, programme };

/// The kind of a file, by its content; of a glTF also by its name, where the content does not tell. nullopt: none of these,
/// or it can't be read.
std::optional<FileKind> kind_of_file(const std::filesystem::path& file);

/// Throws InputError for a file of another kind than the wanted one, and says what takes it. A glTF is as good as a scene.
void reject_other_kind(const std::filesystem::path& file, FileKind wanted);

} // namespace starbow
