#include "tests/support/warp_fixture.h"
#include <limits>

namespace starbow::warp_test::warp_damage_test {
namespace {

std::string with(std::string text, const std::string& old, const std::string& replacement)
{
    const std::size_t at = text.find(old);
    if (at == text.npos)
        throw std::logic_error(old + " is not in the text");
    return text.replace(at, old.size(), replacement);
}

std::string with_word(std::string bytes, std::size_t at, std::uint32_t word)
{
    for (std::size_t i = 0; i < 4; ++i)
        bytes[at + i] = char(word >> 8 * i);
    return bytes;
}
std::string with_float(std::string bytes, std::size_t at, float value)
{
    return with_word(std::move(bytes), at, std::bit_cast<std::uint32_t>(value));
}

struct Damage {
    std::string content, place, says;
};

void expect_refused(const std::string& name, const std::vector<Damage>& damages, const std::string& region = "")
{
    for (const Damage& damage : damages) {
        SCOPED_TRACE(damage.content.substr(0, 120));
        const std::string message = complaint([&] { read(name, damage.content, region); });
        EXPECT_EQ(message.find('\n'), message.npos) << message;
        const std::string start = name + ": " + (damage.place.empty() ? "" : damage.place + ": ");
        EXPECT_EQ(message.substr(0, start.size()), start);
        EXPECT_NE(message.find(damage.says), message.npos) << message;
    }
}

TEST(WarpDamageTest, FaultsInBourkesFormatAreNamed)
{
    expect_refused("a.data",
        {{"1\n3 2\n", "line 1", "\"1\" is a type that is not read; 2, a rectangular grid, is right"},
            {"2\n", "line 2", "is missing"}, {"2\n3\n", "line 2", "has 1 values; columns and rows is right"},
            {"2\n1 2\n", "line 2", "\"1\" is too small; a number from 2 to 16384 is right"},
            {"2\n3.5 2\n", "line 2", "not a whole number"}, {"2\n-3 2\n", "line 2", "too small"},
            {"2\n10000 10000\n0 0 0 0 0\n", "line 2",
                "announces 100000000 vertices, for which the file's 10 further bytes are too few"},
            {with(bourke, "0 -1 0.5 0 1", "0 -1 0.5 0"), "line 4", "has 4 values; x y u v i is right"},
            {with(bourke, "0 -1 0.5 0 1", "0 -1 nan 0 1"), "line 4", "\"nan\" is not a number"},
            {with(bourke, "0 -1 0.5 0 1", "0 -1 0x5 0 1"), "line 4", "\"0x5\" is not a number"},
            {with(bourke, "0 -1 0.5 0 1", "0 -1 1e999 0 1"), "line 4", "not a number"},
            {with(bourke, "0 -1 0.5 0 1", "0 -999 0.5 0 1"), "line 4", "\"-999\" is too small"},
            {with(bourke, "0 -1 0.5 0 1", "0 -1 0.5 0 2000"), "line 4", "brightness"},
            {with(bourke, "1.5 1 1 1 1\n", ""), "line 8", "is missing, the file ends early; x y u v i is right"},
            {bourke + "0 0 0 0 0\n", "line 9", "comes after the last of 6 vertices"},
            {bourke + "aspect 0\n", "line 9", "too small"}, {bourke + "aspect 1\n1\n", "line 10", "comes after the end"},
            {"2\n2 2\n-1 -1 0 0 -1\n1 -1 1 0 -1\n-1 1 0 1 -1\n1 1 1 1 -1\n", "", "shows nothing: every triangle has a hole"},
            {"2\n2 2\n0 -1 0 0 1\n0 -1 1 0 1\n0 1 0 1 1\n0 1 1 1 1\n", "", "has no width"},
            {"2\n2 2\n1 -1 0 0 1\n1 -1 1 0 1\n1 1 0 1 1\n1 1 1 1 1\n", "", "shows nothing: its triangles lie at"}});
}

TEST(WarpDamageTest, FaultsInDomeprojectionAreNamed)
{
    expect_refused("a.csv",
        {{"u;v;x;y\n", "line 1", "not this format's first line; x;y;u;v;column;row is right"},
            {with(csv, "1;0;1;0;1;0", "1;0;1;0;1"), "line 3", "has 5 values"},
            {with(csv, "1;0;1;0;1;0", "1;;1;0;1;0"), "line 3", "\"\" is not a number"},
            {with(csv, "1;0;1;0;1;0", "1;inf;1;0;1;0"), "line 3", "not a number"},
            {with(csv, "1;0;1;0;1;0", "1,5;0;1;0;1;0"), "line 3", "\"1,5\" is not a number"},
            {with(csv, "1;0;1;0;1;0", "1;0;11;0;1;0"), "line 3", "too large"},
            {with(csv, "1;0;1;0;1;0", "1;0;1;0;-1;0"), "line 3", "too small"},
            {with(csv, "1;0;1;0;1;0", "1;0;1;0;1;1"), "column 1, row 1", "is there twice"},
            {with(csv, "1;0;1;0;1;0", "1;0;1;0;9999;0"), "", "4 vertices for a grid of 10000 x 2"},
            {"x;y;u;v;column;row\n0;0;0;0;0;0\n", "", "has 1 columns and 1 rows"},
            {"x;y;u;v;column;row\n5;5;0;0;0;0\n6;5;1;0;1;0\n5;6;0;1;0;1\n6;6;1;1;1;1\n", "",
                "x 5 to 6, y 5 to 6 in fractions of the viewport"}});
    const auto frustum = [](const std::string& text) { return complaint([&] { read_frustum({"f.csv", text}); }); };
    const std::string names = "x;y;z;heading;pitch;bank;left;right;bottom;top\n";
    EXPECT_EQ(
        frustum("x;y\n1;2\n"), "f.csv: line 1: \"z\" is missing; x;y;z;heading;pitch;bank;left;right;bottom;top is right");
    EXPECT_NE(frustum(names + "0;0;0;0;0;0;10;10;10\n").find("f.csv: line 2: "), std::string::npos);
    EXPECT_NE(frustum(names + "0;0;0;0;0;0;-20;10;10;10\n").find("turned about"), std::string::npos);
    EXPECT_NE(frustum(names + "0;0;0;0;0;0;90;10;10;10\n").find("too far from a flat picture's axis"), std::string::npos);
}

TEST(WarpDamageTest, FaultsInSimcadAreNamed)
{
    const std::string at = "GeometryFile/GeometryDefinition";
    expect_refused("a.simcad",
        {{"<GeometryFile><GeometryDefinition>", "byte 33", "is not XML"}, {"<GeometryFile/>", at, "is missing"},
            {with(with(simcad, "<Y-Flat", "<Z-Flat"), "</Y-Flat", "</Z-Flat"), at + "/Y-FlatParameters", "is missing"},
            {with(simcad, "range=\"100\"", ""), at + "/X-FlatParameters/@range", "\"\" is not a number of pixels"},
            {with(simcad, "range=\"100\"", "range=\"0\""), at + "/X-FlatParameters/@range", "\"0\""},
            {with(simcad, "0 5 0 5", "0 five 0 5"), at + "/X-FlatParameters, value 2", "\"five\" is not a number"},
            {with(simcad, "0 5 0 5", "0 99999 0 5"), at + "/X-FlatParameters, value 2", "too far"},
            {with(simcad, "0 5 0 5", "0 5 0"), at, "3 offsets in X and 4 in Y"},
            {with(with(simcad, "0 5 0 5", "0 5 0"), "0 0 -5 0", "0 0 -5"), at, "3 offsets, which is not a square"}});
    // An external entity must not be read.
    const std::string xxe
        = "<!DOCTYPE a [<!ENTITY e SYSTEM \"file:///etc/passwd\">]>" + with(simcad, "0 5 0 5", "0 &e; 0 5");
    EXPECT_NE(complaint([&] { read("a.simcad", xxe); }).find("\"&e;\" is not a number"), std::string::npos);
}

TEST(WarpDamageTest, FaultsInScissAreNamed)
{
    const std::string good = sample("channel1_warp_u2.sgc"), two = sample("channel1_warp_u3.sgc");
    const std::size_t indices = 60 + 24 * 1089;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_refused("a.sgc",
        {{"SGB", "byte 0", "not a SCISS mesh"}, {"SGC", "byte 0", "not a SCISS mesh"},
            {"SGC\x03", "byte 3", "3 is a version"}, {with_word(good, 4, 7), "byte 4", "7 is a type"},
            {with_float(good, 8, nan), "byte 8", "quaternion's x is out of range"},
            {with_float(good, 20, 0.5f), "byte 8", "a quaternion of length"},
            {with_float(good, 24, nan), "byte 24", "position's x"},
            {with_float(good, 36, 95), "byte 36", "too far from a flat picture's axis"},
            {with_float(good, 40, 80), "byte 36", "turned about"},
            {with_word(good, 52, 1), "byte 52", "1 columns and 33 rows are not a grid"},
            {with_word(good, 56, 0x7fffffff), "byte 52", "not a grid"},
            {with_word(two, 52, 6), "byte 52", "6 is a primitive"},
            {with_word(two, 56, 0xffffffff), "byte 56", "4294967295 vertices need more than the 34460 bytes that follow"},
            {with_float(good, 64, nan), "byte 64", "a vertex's y is out of range"},
            {with_float(good, 60 + 24 * 5 + 12, 50), "byte 192", "a vertex's u is out of range"},
            {with_word(good, indices, 0x40000000), "byte " + std::to_string(indices), "1073741824 indices need more"},
            {with_word(good, indices + 8, 1089), "byte " + std::to_string(indices + 8),
                "1089 is not the number of a vertex"},
            {good.substr(0, 50), "byte 48", "is missing, the file ends early"},
            {good.substr(0, indices), "byte " + std::to_string(indices), "the number of indices is missing"},
            {good.substr(0, good.size() - 2), "byte " + std::to_string(indices), "2080 indices need more"}});
}

TEST(WarpDamageTest, FaultsInScalableAreNamed)
{
    expect_refused("a.ol",
        {{"OPENMESH Version 2\n", "line 1", "OPENMESH Version 1.1 is right"},
            {with(scalable, "VERTICES 4", "VERTICES 5"), "VERTICES", "5 are announced and 4 are there"},
            {with(scalable, "FACES 2", "FACES 1"), "FACES", "1 are announced and 2 are there"},
            {with(scalable, "NATIVEXRES 200\r\n", ""), "", "NATIVEXRES is missing"},
            {with(scalable, "NATIVEXRES 200", "NATIVEXRES 0"), "line 12", "too small"},
            {with(scalable, "NATIVEXRES 200", "NATIVEXRES"), "line 12", "has no number"},
            {with(scalable, "NORMALIZED", "PIXELS"), "line 4", "MAPPING NORMALIZED is right"},
            {with(scalable, "PERSPECTIVE_TOP 16\r\n", ""), "", "PERSPECTIVE_TOP is missing"},
            {with(scalable, "PERSPECTIVE_TOP 16", "PERSPECTIVE_TOP -16"), "PERSPECTIVE_LEFT", "turned about"},
            {with(scalable, "200 100 51 1 1", "200 100 300 1 1"), "line 16", "\"300\" is too large"},
            {with(scalable, "200 100 51 1 1", "200 100 51 1"), "line 16", "is not a vertex; x y intensity s t is right"},
            {with(scalable, "[ 0 1 2 ]", "[ 0 1 4 ]"), "line 18", "\"4\" is not the number of a vertex"},
            {with(scalable, "[ 0 1 2 ]", "[ 0 1 -1 ]"), "line 18", "\"-1\" is not the number of a vertex"},
            {with(scalable, "[ 0 1 2 ]", "[ 0 1 ]"), "line 18", "is not a face"},
            {with(scalable, "MAPPING", "ORTHO_LEFT 1\r\nMAPPING"), "ORTHO_RIGHT", "spans nothing"}});
}

TEST(WarpDamageTest, FaultsInSkyskanAreNamed)
{
    expect_refused("a.txt",
        {{with(skyskan, "Dome Azimuth=30\n", ""), "line 4", "comes before Dome Azimuth="},
            {with(skyskan, "FOV=90", "FOV=0"), "line 3", "too small"},
            {with(skyskan, "Azimuth=30", "Azimuth=north"), "line 1", "\"north\" is not a number"},
            {with(skyskan, "3 2\n", "3 2 1\n"), "line 5", "has 3 values"},
            {with(skyskan, "3 2\n", "3000 2000\n"), "line 5", "too few"},
            {with(skyskan, "0.5 0 0.5 0\n", "0.5 0 0.5\n"), "line 7", "x y u v is right"},
            {with(skyskan, "1 1 -1 -1\n", ""), "line 11", "is missing"},
            {skyskan + "1 1 1 1\n", "line 12", "comes after the last"}, {"Dome Azimuth=30\n", "line 2", "is missing"}});
}

TEST(WarpDamageTest, FaultsInObjAreNamed)
{
    expect_refused("a.obj",
        {{"v 1 2\n", "line 1", "is not a vertex; v x y z, with a colour r g b after it or without, is right"}, {"v 1 2 z\n", "line 1", "\"z\" is not a number"},
            {with(obj, "f 1/1/1", "f 5/1/1"), "line 10",
                "\"5\" is not the number of a vertex before it; one from 1 to 4 is right"},
            {with(obj, "f 1/1/1", "f 1/5/1"), "line 10", "\"5\" is not the number of a vt before it"},
            {with(obj, "f 1/1/1", "f 0/1/1"), "line 10", "\"0\""}, {with(obj, "f 1/1/1", "f 1.5/1/1"), "line 10", "\"1.5\""},
            {with(obj, "f 1/1/1", "f -9999999999/1/1"), "line 10", "not the number of a vertex"},
            {with(obj, "f 1/1/1 2/2/2 3/3/3", "f 1/1 2/2"), "line 10", "fewer than three corners"},
            {"# nothing\n", "", "holds no mesh"}});
}

TEST(WarpDamageTest, FaultsInHeadsetMeshesAreNamed)
{
    expect_refused("a.mesh",
        {{"starbow headset mesh 2\n", "line 1", "starbow headset mesh 1 is right"},
            {with(headset, "2 2", "2 1"), "line 2", "too small"}, {with(headset, "2 2", "999 999"), "line 2", "too few"},
            {with(headset, "1 0 1 1", "1 0 1"), "line 4", "has 7 values"},
            {with(headset, "1 0 1 1", "1 0 1 1e3"), "line 4", "too large"},
            {headset + "0\n", "line 7", "comes after the last"}});
}

TEST(WarpDamageTest, FaultsInPfmAreNamed)
{
    const std::string good = pfm(4, 3, identity_map(4, 3));
    std::vector<float> far = identity_map(4, 3), outside(36, 0.f), holes(36, std::numeric_limits<float>::quiet_NaN());
    far[3] = 1e9f;
    for (std::size_t i = 0; i < 36; ++i)
        outside[i] = 3 + 0.1f * float(i % 3);
    expect_refused("a.pfm",
        {{with(good, "PF", "Pf"), "byte 0", "three channels"},
            {with(good, "4 3", "4 0"), "PFM header", "\"0\" is not a size"},
            {with(good, "4 3", "4.5 3"), "PFM header", "\"4.5\" is not a size"},
            {with(good, "4 3", "4 4"), "byte 12", "has 144 bytes of values for 4 x 4 pixels; 192 are right"},
            {with(good, "4 3", "16000 16000"), "byte 20", "3072000000 are right"},
            {with(good, "-1.0", "0"), "PFM header", "\"0\" is not a scale"},
            {with(good, "-1.0", "nan"), "PFM header", "\"nan\" is not a scale"},
            {good.substr(0, good.size() - 1), "byte 12", "143 bytes"}, {good + "x", "byte 12", "145 bytes"},
            {"PF\n4 3", "PFM header", "missing"},
            {pfm(4, 3, far), "column 1, row 2 from the top", "is not a place in the picture"},
            {pfm(4, 3, outside), "", "12 of 12 places outside the picture; places from 0 to 1 are right"},
            {pfm(4, 3, holes), "", "shows nothing"}});
}

TEST(WarpDamageTest, FaultsInMpcdiAreNamed)
{
    const std::string region = region_xml("r", frustum_xml), buffer = "<buffer id=\"b\">" + region + "</buffer>";
    const std::string map = pfm(4, 3, identity_map(4, 3));
    const auto archive = [&](const std::string& xml, const std::string& more = "") {
        return zipped({{"mpcdi.xml", xml}, {"r.pfm", map}, {"mask.png", more}});
    };
    const auto good = [&](const std::string& old, const std::string& replacement) {
        return archive(with(mpcdi_xml("3d", buffer, fileset_xml("r", "r.pfm")), old, replacement));
    };
    const auto masked = [&](const std::string& picture) {
        return archive(
            mpcdi_xml("3d", buffer, fileset_xml("r", "r.pfm", "<alphaMap><path>mask.png</path></alphaMap>")), picture);
    };
    const std::string top = "mpcdi.xml: MPCDI", in = top + "/display/buffer[b]/region[r]";
    std::string interlaced = png(2, 2, 3, std::vector<unsigned char>(12)),
                bomb = png(1024, 1024, 3, std::vector<unsigned char>(3 << 20));
    interlaced[28] = 1;
    bomb[22] = 1; // 256 rows, while its data have 1024
    expect_refused("a.mpcdi",
        {{"PK\x03\x04", "", "can't be read as a zip archive"}, {zipped({{"a.txt", "x"}}), "", "has 0 XML files at its root"},
            {zipped({{"a.xml", "x"}, {"b.xml", "y"}}), "", "has 2 XML files at its root"},
            {zipped({{"a.xml", "<MPCDI"}}), "a.xml, byte 5", "is not XML"},
            {zipped({{"a.xml", "<other/>"}}), "a.xml: other", "<MPCDI> around everything is right"},
            {good("version=\"2.0\"", "version=\"3.0\""), top, "\"3.0\" is a version"},
            {good("profile=\"3d\"", "profile=\"4d\""), top, "\"4d\" is a profile"},
            {good(buffer, ""), top + "/display", "has no region"},
            {good("x=\"0\"", ""), in, "lacks x; this attribute is right"},
            {good("XResolution=\"64\"", "XResolution=\"many\""), in + "/@xresolution", "\"many\" is not a number"},
            {good(frustum_xml, ""), in, "lacks <frustum>"}, {good("<yaw>30</yaw>", ""), in + "/frustum", "lacks <yaw>"},
            {good("<yaw>30", "<yaw>left"), in + "/frustum/yaw", "\"left\" is not a number"},
            {good("<upAngle>15", "<upAngle>-15"), in + "/frustum", "turned about"},
            {good("fileset region=\"r\"", "fileset region=\"q\""), top + "/files", "no fileset for the region \"r\""},
            {good("r.pfm", "none.pfm"), "none.pfm", "is not in the archive"},
            {good("r.pfm", "../r.pfm"), "../r.pfm", "is not in the archive"},
            {good("r.pfm", "mask.png"), "mask.png: PFM header", "missing"},
            {masked("no picture"), "mask.png", "is not a PNG"}, {masked(interlaced), "mask.png", "interlaced"},
            {masked(bomb), "mask.png", "has damaged data, or more than its"},
            {masked(png(4, 4, 3, std::vector<unsigned char>(48, 9)).substr(0, 60)), "mask.png", "ends early"}});
    expect_refused("a.data", {{bourke, "", "has no regions, and \"r\" is wanted"}}, "r");

    // Axes of wrong length or angle, and unknown units.
    const std::string frame = "<coordinateFrame><yawx>0</yawx><yawy>-1</yawy><yawz>0</yawz><pitchx>1</pitchx><pitchy>0</"
                              "pitchy><pitchz>0</pitchz>"
                              "<rollx>0</rollx><rolly>0</rolly><rollz>-1</rollz></coordinateFrame>";
    const auto points = [&](const std::string& old, const std::string& replacement) {
        std::string files = fileset_xml("r", "r.pfm");
        files.insert(files.find("<interpolation>"), "<geometricUnit>m</geometricUnit>");
        return archive(
            with(mpcdi_xml("a3", "<buffer id=\"b\">" + region_xml("r", frame) + "</buffer>", files), old, replacement));
    };
    expect_refused("a.mpcdi",
        {{points("<rollz>-1</rollz>", "<rollz>0</rollz>"), in + "/coordinateFrame", "roll axis of length 0"},
            {points("<rollx>0</rollx><rolly>0</rolly><rollz>-1</rollz>", "<rollx>1</rollx><rolly>0</rolly><rollz>0</rollz>"),
                in + "/coordinateFrame", "not at right angles"},
            {points(">m<", ">furlong<"), top + "/files/fileset/geometryWarpFile/geometricUnit",
                "\"furlong\" is not a unit"}});
}

TEST(WarpDamageTest, ArchivesThatUnpackToMuchAreRefused)
{
    // 20 MB of zeros in 20 kB, as the map and as the XML.
    const std::string zeros(20'000'000, '\0');
    const std::string xml
        = mpcdi_xml("2d", "<buffer id=\"b\">" + region_xml("r", "") + "</buffer>", fileset_xml("r", "r.pfm"));
    EXPECT_NE(complaint([&] {
        read("a.mpcdi", zipped({{"mpcdi.xml", xml}, {"r.pfm", zeros}}));
    }).find("r.pfm: unpacks to more than"),
        std::string::npos);
    EXPECT_NE(complaint([&] {
        read("a.mpcdi", zipped({{"mpcdi.xml", zeros}}));
    }).find("mpcdi.xml: unpacks to more than 1048576"),
        std::string::npos);
}

TEST(WarpDamageTest, UnreadableFilesAreNamed)
{
    EXPECT_NE(complaint([] { load_warp({scratch("none.sgc"), {}, {}, {}}); }).find("does not exist"), std::string::npos);
    EXPECT_NE(complaint([] { load_warp({scratch(""), {}, {}, {}}); }).find("is a folder"), std::string::npos);
    EXPECT_NE(complaint([] { load_warp({write_text("empty.data", ""), {}, {}, {}}); }).find("is empty"), std::string::npos);
    EXPECT_NE(complaint([] {
        load_warp({write_text("letter", "Dear Sir"), {}, {}, {}});
    }).find("is not a warp file that is known"),
        std::string::npos);
    const auto frustum = write_text("f.csv", "x;y;z;heading;pitch;bank;left;right;bottom;top\n0;0;0;0;0;0;1;1;1;1\n");
    EXPECT_NE(complaint([&] {
        load_warp({sample_path("channel1_warp_u2.sgc"), frustum, {}, {}});
    }).find("has a frustum of its own"),
        std::string::npos);
    EXPECT_TRUE(load_warp({sample_path("channel1_warp.simcad"), frustum, {}, {}}).frustum.has_value());
}

} // namespace
} // namespace starbow::warp_test::warp_damage_test
