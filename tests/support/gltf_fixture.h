#pragma once
#include "files.h"
#include "runtime/world/world.h"
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace starbow::gltf_test {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

std::string base64(const Bytes& bytes);

template <typename T> Bytes bytes_of(const std::vector<T>& values)
{
    Bytes out(values.size() * sizeof(T));
    std::memcpy(out.data(), values.data(), out.size());
    return out;
}

void append32(Bytes& to, std::uint32_t value); ///< little-endian

/// A GLB file of a JSON and a binary chunk.
Bytes glb_bytes(const std::string& json, const Bytes& bin);

/// A glTF document under construction. All binary data goes into its one buffer.
struct Doc {
    Json json = {{"asset", {{"version", "2.0"}}}};
    Bytes bin;

    int put(const char* kind, Json thing); ///< returns its index

    int view(const Bytes& bytes, int stride = 0);

    /// type: SCALAR, VEC2, ... of numbers of type T.
    template <typename T> int accessor(const std::vector<T>& values, const char* type, bool normalized = false)
    {
        const int component = std::is_same_v<T, float> ? 5126
            : std::is_same_v<T, std::int8_t>           ? 5120
            : std::is_same_v<T, std::uint8_t>          ? 5121
            : std::is_same_v<T, std::int16_t>          ? 5122
            : std::is_same_v<T, std::uint16_t>         ? 5123
                                                       : 5125;
        return accessor(bytes_of(values), component, values.size(), type, normalized);
    }
    int accessor(const Bytes& bytes, int component, std::size_t numbers, const char* type, bool normalized);

    /// Adds a mesh of one primitive, a node with it, and the node to the scene.
    Json& show(Json primitive);

    std::string text() const;
};

/// The right triangle with the corners (0, 0, 0), (2, 0, 0) and (0, 1, 0); its flat normal is +z.
inline const std::vector<float> corner_positions = {0, 0, 0, 2, 0, 0, 0, 1, 0};

Doc triangle_doc();

/// The message with which check_speeds refuses a world; empty: it does not.
std::string speed_complaint(const World& world, const SceneFile& scene);

Bytes png(int width, int height, const Bytes& rgba);

/// 16 x 8 pixels, all of them 100.
Bytes grey_jpeg();

/// Two pixels: red, then half transparent blue.
Bytes small_png();

std::string png_uri();

/// Each test has a folder of its own, which is removed at the test's end.
class GltfTest : public ::testing::Test {
protected:
    std::filesystem::path folder
        = std::filesystem::path(::testing::TempDir()) / ("starbow_world_" + std::to_string(::getpid()));

    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    template <typename Content> std::filesystem::path write(const std::string& name, const Content& content) const
    {
        testing::write_bytes(folder / name, {reinterpret_cast<const char*>(content.data()), content.size()});
        return folder / name;
    }

    World load(const Doc& doc) const { return load_world(write("world.gltf", doc.text())); }

    /// Returns the message with which the file is refused. It must be one line and begin with the file's name.
    std::string complaint(const std::filesystem::path& file) const;

    std::string complaint(const Doc& doc) const { return complaint(write("world.gltf", doc.text())); }
};

} // namespace starbow::gltf_test
