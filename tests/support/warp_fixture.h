#pragma once
#include "displays/warp/formats.h"
#include "files.h"
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <stb/stb_image_write.h>
#include <zip.h>

namespace starbow::warp_test {

using namespace starbow::testing;

inline std::filesystem::path sample_path(const std::string& name) { return source_dir() / "tests/warp" / name; }
inline std::string sample(const std::string& name) { return read_text(sample_path(name)); }

inline WarpMesh read(
    const std::string& name, const std::string& content, const std::string& region = "", const FloatMapForm& form = {})
{
    return read_warp({name, content}, {region, form});
}

/// A zip archive of files, each compressed with deflate.
inline std::string zipped(const std::vector<std::pair<std::string, std::string>>& files)
{
    zip_error_t error;
    zip_source_t* memory = zip_source_buffer_create(nullptr, 0, 0, &error);
    zip_source_keep(memory);
    zip_t* archive = zip_open_from_source(memory, ZIP_TRUNCATE, &error);
    for (const auto& [name, bytes] : files) {
        const zip_int64_t index = zip_file_add(
            archive, name.c_str(), zip_source_buffer(archive, bytes.data(), bytes.size(), 0), ZIP_FL_OVERWRITE);
        // Without the time of day the archive's bytes are always the same.
        zip_file_set_dostime(archive, zip_uint64_t(index), 0, 0x21, 0); // midnight of 1 January 1980
    }
    zip_close(archive);
    zip_source_open(memory);
    zip_source_seek(memory, 0, SEEK_END);
    std::string bytes(std::size_t(zip_source_tell(memory)), '\0');
    zip_source_seek(memory, 0, SEEK_SET);
    zip_source_read(memory, bytes.data(), bytes.size());
    zip_source_close(memory);
    zip_source_free(memory);
    return bytes;
}

inline std::string png(int width, int height, int channels, const std::vector<unsigned char>& values)
{
    std::string out;
    stbi_write_png_to_func(
        [](void* to, void* data, int count) {
            static_cast<std::string*>(to)->append(static_cast<char*>(data), std::size_t(count));
        },
        &out, width, height, channels, values.data(), width * channels);
    return out;
}

/// A PFM from rows of triples in the file's order.
inline std::string pfm(int width, int height, const std::vector<float>& values, bool little = true)
{
    std::string out = "PF\n" + std::to_string(width) + " " + std::to_string(height) + (little ? "\n-1.0\n" : "\n1.0\n");
    for (float value : values) {
        char bytes[4];
        std::memcpy(bytes, &value, 4);
        if ((std::endian::native == std::endian::little) != little)
            std::reverse(bytes, bytes + 4);
        out.append(bytes, 4);
    }
    return out;
}

/// The PFM of a map that warps nothing: the bottom row first, u to the right, v down.
inline std::vector<float> identity_map(int width, int height)
{
    std::vector<float> values;
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            values.insert(values.end(), {(x + 0.5f) / width, (y + 0.5f) / height, 0});
    return values;
}

/// MPCDI's XML around regions and filesets.
inline std::string mpcdi_xml(
    const std::string& profile, const std::string& buffers, const std::string& filesets, const std::string& version = "2.0")
{
    return "<?xml version=\"1.0\"?>\n<MPCDI profile=\"" + profile + "\" geometry=\"1\" version=\"" + version + "\"><display>"
        + buffers + "</display><files>" + filesets + "</files></MPCDI>";
}
inline std::string region_xml(const std::string& id, const std::string& inside)
{
    return "<region id=\"" + id + "\" x=\"0\" y=\"0\" xsize=\"1\" ysize=\"1\" XResolution=\"64\" YResolution=\"48\">"
        + inside + "</region>";
}
inline const std::string frustum_xml = "<frustum><yaw>30</yaw><pitch>20</pitch><roll>10</roll><rightAngle>25</rightAngle>"
                                       "<leftAngle>-24</leftAngle><upAngle>15</upAngle><downAngle>-14</downAngle></frustum>";
inline std::string fileset_xml(const std::string& region, const std::string& warp, const std::string& more = "")
{
    return "<fileset region=\"" + region + "\"><geometryWarpFile><path>" + warp
        + "</path><interpolation>linear</interpolation>" + "</geometryWarpFile>" + more + "</fileset>";
}

inline std::string mpcdi_3d()
{
    return zipped({{"mpcdi.xml",
                       mpcdi_xml("3d", "<buffer id=\"b\">" + region_xml("left", frustum_xml) + "</buffer>",
                           fileset_xml("left", "left.pfm",
                               "<alphaMap><path>a.png</path><componentDepth>1</componentDepth><bitDepth>8</bitDepth>"
                               "<gammaEmbedded>2.2</gammaEmbedded></alphaMap><betaMap><path>b.png</path></betaMap>"))},
        {"left.pfm", pfm(4, 3, identity_map(4, 3))}, {"a.png", png(2, 1, 3, {0, 0, 0, 255, 255, 255})},
        {"b.png", png(1, 2, 3, {51, 0, 0, 0, 0, 102})}});
}

inline const std::string bourke
    = "2\n3 2\n-1.5 -1 0 0 1\n0 -1 0.5 0 1\n1.5 -1 1 0 0.5\n-1.5 1 0 1 1\n0 1 0.5 1 -1\n1.5 1 1 1 1\n";
inline const std::string csv = "x;y;u;v;column;row\n0;0;0;0;0;0\n1;0;1;0;1;0\n0;1;0;1;0;1\n1;1;1;1;1;1\n";
inline const std::string simcad
    = "<GeometryFile><GeometryDefinition><X-FlatParameters range=\"100\">0 5 0 5</X-FlatParameters>"
      "<Y-FlatParameters range=\"50\">0 0 -5 0</Y-FlatParameters></GeometryDefinition></GeometryFile>";
inline const std::string scalable
    = "OPENMESH Version 1.1\r\nVERTICES 4\r\nFACES 2\r\nMAPPING NORMALIZED\r\nPERSPECTIVE_YAW 30\r\n"
      "PERSPECTIVE_PITCH 20\r\nPERSPECTIVE_ROLL 10\r\nPERSPECTIVE_LEFT -25\r\nPERSPECTIVE_RIGHT 26\r\n"
      "PERSPECTIVE_TOP 16\r\nPERSPECTIVE_BOTTOM -15\r\nNATIVEXRES 200\r\nNATIVEYRES 100\r\n"
      "0 0 255 0 0\r\n200 0 255 1 0\r\n200 100 51 1 1\r\n0 90 255 0 1\r\n[ 0 1 2 ]\r\n[ 0 2 3 ]\r\n";
inline const std::string skyskan
    = "Dome Azimuth=30\nDome Elevation=40\nHorizontal FOV=90\nVertical FOV=60\n3 2\n0 0 0 0\n0.5 0 0.5 0\n"
      "1 0 1 0\n0 1 0 1\n0.5 1 0.5 1\n1 1 -1 -1\n";
inline const std::string obj
    = "# mesh\r\nv -1 -1 0\r\nv 1 -1 0\r\nv 1 1 0\r\nv -1 1 0\r\nvt 0 0\r\nvt 1 0\r\nvt 1 1\r\nvt 0 1\r\n"
      "f 1/1/1 2/2/2 3/3/3\r\nf 1/1 3/3 4/4\r\n";
inline const std::string headset = "starbow headset mesh 1\n2 2\n0 0 -1 1 -1.1 1.1 -1.2 1.2\n1 0 1 1 1.1 1.1 1.2 1.2\n"
                                   "0 1 -1 -1 -1.1 -1.1 -1.2 -1.2\n1 1 1 -1 1.1 -1.1 1.2 -1.2\n";

/// A small file of each format, by its name.
inline const std::map<std::string, std::string>& small_samples()
{
    static const std::map<std::string, std::string> all{{"Bourke mesh", bourke}, {"MPCDI", mpcdi_3d()},
        {"PFM", pfm(2, 2, identity_map(2, 2))}, {"domeprojection", csv}, {"SimCAD", simcad},
        {"SCISS", sample("channel1_warp_u2.sgc")}, {"Scalable", scalable}, {"SkySkan", skyskan}, {"OBJ", obj},
        {"headset mesh", headset}};
    return all;
}

/// Flags the vertices that some triangle uses.
inline std::vector<char> used(const WarpMesh& mesh)
{
    std::vector<char> flags(mesh.vertices.size());
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t i : triangle)
            flags.at(i) = 1;
    return flags;
}

} // namespace starbow::warp_test
