#include "gltf_fixture.h"
#include "config/json/error.h"
#include "runtime/world/fastest_motion.h"
#include <stb/stb_image_write.h>

namespace starbow::gltf_test {

std::string base64(const Bytes& bytes)
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

void append32(Bytes& to, std::uint32_t value)
{
    for (int i = 0; i < 4; ++i)
        to.push_back(std::uint8_t(value >> 8 * i));
}

Bytes glb_bytes(const std::string& json, const Bytes& bin)
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

Doc triangle_doc()
{
    Doc doc;
    doc.show({{"attributes", {{"POSITION", doc.accessor(corner_positions, "VEC3")}}}});
    return doc;
}

static void append_to_bytes(void* to, void* data, int size)
{
    auto* from = static_cast<std::uint8_t*>(data);
    static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), from, from + size);
}

Bytes png(int width, int height, const Bytes& rgba)
{
    Bytes out;
    stbi_write_png_to_func(append_to_bytes, &out, width, height, 4, rgba.data(), 4 * width);
    return out;
}

Bytes grey_jpeg()
{
    Bytes out, grey(16 * 8 * 3, 100);
    stbi_write_jpg_to_func(append_to_bytes, &out, 16, 8, 3, grey.data(), 90);
    return out;
}

Bytes small_png() { return png(2, 1, {255, 0, 0, 255, 0, 0, 255, 128}); }

std::string png_uri() { return "data:image/png;base64," + base64(small_png()); }

int Doc::put(const char* kind, Json thing)
{
    json[kind].push_back(std::move(thing));
    return int(json[kind].size()) - 1;
}

int Doc::view(const Bytes& bytes, int stride)
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

Json& Doc::show(Json primitive)
{
    int mesh = put("meshes", {{"primitives", {primitive}}});
    json["scenes"][0]["nodes"].push_back(put("nodes", {{"mesh", mesh}}));
    return json["meshes"][std::size_t(mesh)]["primitives"][0];
}

std::string Doc::text() const
{
    Json out = json;
    if (out.contains("buffers") && out["buffers"].is_array() && out["buffers"].size() == 1 && out["buffers"][0].is_object()
        && !out["buffers"][0].contains("uri"))
        out["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bin);
    return out.dump();
}

int Doc::accessor(const Bytes& bytes, int component, std::size_t numbers, const char* type, bool normalized)
{
    const int width = std::string(type) == "SCALAR" ? 1 : type[3] - '0';
    return put("accessors",
        {{"bufferView", view(bytes)}, {"componentType", component}, {"type", type}, {"count", numbers / std::size_t(width)},
            {"normalized", normalized}});
}

std::string GltfTest::complaint(const std::filesystem::path& file) const
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

std::string speed_complaint(const World& world, const SceneFile& scene)
{
    try {
        check_speeds(world, scene);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace starbow::gltf_test
