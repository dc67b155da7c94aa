#pragma once
#include "config/json/error.h"
#include "runtime/world/world.h"
#include <cstring>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stb/stb_image_write.h>
#include <unistd.h>

namespace starbow::gltf_test {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

inline std::string base64(const Bytes& bytes)
{
    const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? letters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

template <typename T> Bytes bytes_of(const std::vector<T>& values)
{
    Bytes out(values.size() * sizeof(T));
    std::memcpy(out.data(), values.data(), out.size());
    return out;
}

inline void append32(Bytes& to, std::uint32_t value)
{
    for (int i = 0; i < 4; ++i)
        to.push_back(std::uint8_t(value >> 8 * i));
}

inline Bytes glb_bytes(const std::string& json, const Bytes& bin)
{
    std::string text = json + std::string((4 - json.size() % 4) % 4, ' ');
    Bytes body = bin, out;
    body.resize((body.size() + 3) / 4 * 4);
    append32(out, 0x46546C67);
    append32(out, 2);
    append32(out, std::uint32_t(28 + text.size() + body.size()));
    append32(out, std::uint32_t(text.size()));
    append32(out, 0x4E4F534A);
    out.insert(out.end(), text.begin(), text.end());
    append32(out, std::uint32_t(body.size()));
    append32(out, 0x004E4942);
    out.insert(out.end(), body.begin(), body.end());
    return out;
}

/// A glTF document under construction. All binary data goes into its one buffer.
struct Doc {
    Json json = {{"asset", {{"version", "2.0"}}}};
    Bytes bin;

    int put(const char* kind, Json thing)
    {
        json[kind].push_back(std::move(thing));
        return int(json[kind].size()) - 1;
    }

    int view(const Bytes& bytes, int stride = 0)
    {
        while (bin.size() % 4)
            bin.push_back(0);
        Json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}};
        if (stride)
            view["byteStride"] = stride;
        bin.insert(bin.end(), bytes.begin(), bytes.end());
        json["buffers"] = {{{"byteLength", bin.size()}}};
        return put("bufferViews", view);
    }

    template <typename T> int accessor(const std::vector<T>& values, const char* type, bool normalized = false)
    {
        int width = std::string(type) == "SCALAR" ? 1 : type[3] - '0';
        int component = std::is_same_v<T, float> ? 5126
            : std::is_same_v<T, std::int8_t>     ? 5120
            : std::is_same_v<T, std::uint8_t>    ? 5121
            : std::is_same_v<T, std::int16_t>    ? 5122
            : std::is_same_v<T, std::uint16_t>   ? 5123
                                                 : 5125;
        return put("accessors",
            {{"bufferView", view(bytes_of(values))}, {"componentType", component}, {"type", type},
                {"count", values.size() / std::size_t(width)}, {"normalized", normalized}});
    }

    /// Adds a mesh of one primitive, a node with it, and the node to the scene.
    Json& show(Json primitive)
    {
        int mesh = put("meshes", {{"primitives", {primitive}}});
        json["scenes"][0]["nodes"].push_back(put("nodes", {{"mesh", mesh}}));
        return json["meshes"][std::size_t(mesh)]["primitives"][0];
    }

    std::string text() const
    {
        Json out = json;
        if (out.contains("buffers") && out["buffers"].is_array() && out["buffers"].size() == 1
            && out["buffers"][0].is_object() && !out["buffers"][0].contains("uri"))
            out["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bin);
        return out.dump();
    }
};

/// The right triangle with the corners (0, 0, 0), (2, 0, 0) and (0, 1, 0); its flat normal is +z.
inline const std::vector<float> corner_positions = {0, 0, 0, 2, 0, 0, 0, 1, 0};

inline Doc triangle_doc()
{
    Doc doc;
    doc.show({{"attributes", {{"POSITION", doc.accessor(corner_positions, "VEC3")}}}});
    return doc;
}

inline void append_to_bytes(void* to, void* data, int size)
{
    auto* from = static_cast<std::uint8_t*>(data);
    static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), from, from + size);
}

inline Bytes png(int width, int height, const Bytes& rgba)
{
    Bytes out;
    stbi_write_png_to_func(append_to_bytes, &out, width, height, 4, rgba.data(), 4 * width);
    return out;
}

/// 16 x 8 pixels, all of them 100.
inline Bytes grey_jpeg()
{
    Bytes out, grey(16 * 8 * 3, 100);
    stbi_write_jpg_to_func(append_to_bytes, &out, 16, 8, 3, grey.data(), 90);
    return out;
}

/// Two pixels: red, then half transparent blue.
inline Bytes small_png() { return png(2, 1, {255, 0, 0, 255, 0, 0, 255, 128}); }

inline std::string png_uri() { return "data:image/png;base64," + base64(small_png()); }

/// Each test has a folder of its own, which is removed at the test's end.
class GltfTest : public testing::Test {
protected:
    std::filesystem::path folder
        = std::filesystem::path(testing::TempDir()) / ("starbow_world_" + std::to_string(::getpid()));

    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    template <typename Content> std::filesystem::path write(const std::string& name, const Content& content) const
    {
        // Overwriting in place makes some file systems wait for the disk.
        std::filesystem::remove(folder / name);
        std::ofstream(folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(content.data()), std::streamsize(content.size()));
        return folder / name;
    }

    World load(const Doc& doc) const { return load_world(write("world.gltf", doc.text())); }

    /// Returns the message with which the file is refused. It must be one line and begin with the file's name.
    std::string complaint(const std::filesystem::path& file) const
    {
        try {
            load_world(file);
        } catch (const InputError& error) {
            std::string line = error.what();
            EXPECT_TRUE(line.starts_with(file.string() + ": ")) << line;
            EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos) << line;
            EXPECT_LT(line.size(), file.string().size() + 400) << line;
            return line.substr(std::min(line.size(), file.string().size() + 2));
        }
        ADD_FAILURE() << "it loads";
        return "";
    }

    std::string complaint(const Doc& doc) const { return complaint(write("world.gltf", doc.text())); }
};

} // namespace starbow::gltf_test
