// The house rules, read from the repository itself: CONTRIBUTING.md's table says which room may include which, and every
// #include must follow it.
#include "tests/support/files.h"
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>

namespace house_test {

using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

/// A row of CONTRIBUTING.md's table: a folder without its last slash, and the folders that its files may include.
struct Room {
    std::string folder;
    std::vector<std::string> may;
};

bool within(const std::string& path, const std::string& folder) { return path.starts_with(folder + "/"); }

std::vector<std::string> quoted(const std::string& cell)
{
    static const std::regex code("`([^`]+)`");
    std::vector<std::string> all;
    for (std::sregex_iterator at(cell.begin(), cell.end(), code), end; at != end; ++at)
        all.push_back((*at)[1]);
    return all;
}

/// Reads the rows of the table with "room" and "may include" in its head.
std::vector<Room> rooms_of(const std::string& page)
{
    static const std::regex row(R"(\| `([^`]+)/` \|[^|]*\|([^|]*)\|)");
    std::vector<Room> rooms;
    std::istringstream text(page.substr(page.find("| room | what it holds | may include |")));
    std::string line;
    while (std::getline(text, line) && line.starts_with("|")) {
        std::smatch cells;
        if (std::regex_match(line, cells, row))
            rooms.push_back({cells[1], quoted(cells[2])});
    }
    return rooms;
}

struct Include {
    std::string from, to; ///< files, from the repository's root; to: the text of the include if no such file exists
    bool found = false;
};

/// All includes with quotes in a source's text. exists: returns true if the repository has the file.
std::vector<Include> includes_of(
    const std::string& file, const std::string& text, const std::function<bool(const std::string&)>& exists)
{
    static const std::regex include("(^|\n)[ \t]*#[ \t]*include[ \t]*\"([^\"]+)\"");
    std::vector<Include> all;
    for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at) {
        const std::string written = (*at)[2];
        Include one{file, written};
        // Compilers look beside the file, from the root, and, for GLSL, in shaders/.
        for (const fs::path& folder : {fs::path(file).parent_path(), fs::path(), fs::path("shaders")}) {
            const std::string path = (folder / written).lexically_normal().generic_string();
            if (!one.found && exists(path))
                one.to = path, one.found = true;
        }
        all.push_back(one);
    }
    return all;
}

std::vector<Include> includes_of_repository()
{
    static const std::set<std::string> sources{".h", ".cpp", ".glsl", ".vert", ".frag", ".comp"};
    const fs::path root = source_dir();
    std::vector<Include> all;
    for (const char* top : {"config", "displays", "input", "runtime", "shaders", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            if (!sources.contains(entry.path().extension().string()))
                continue;
            const std::string file = fs::relative(entry.path(), root).generic_string();
            const auto own = includes_of(
                file, read_text(entry.path()), [&](const std::string& path) { return fs::is_regular_file(root / path); });
            all.insert(all.end(), own.begin(), own.end());
        }
    return all;
}

/// Calls visit with the path and the text of each C++ file of the product.
template <class Visit> void for_each_source(Visit&& visit)
{
    for (const char* top : {"config", "displays", "input", "runtime"})
        for (const auto& entry : fs::recursive_directory_iterator(source_dir() / top))
            if (const fs::path& path = entry.path(); path.extension() == ".h" || path.extension() == ".cpp")
                visit(fs::relative(path, source_dir()).generic_string(), read_text(path));
}

const Room* room_of(const std::vector<Room>& rooms, const std::string& file)
{
    const Room* best = nullptr;
    for (const Room& room : rooms)
        if (within(file, room.folder) && (!best || room.folder.size() > best->folder.size()))
            best = &room;
    return best;
}

/// One sentence for each include that the table does not allow.
std::vector<std::string> broken_rules(const std::vector<Room>& rooms, const std::vector<Include>& includes)
{
    std::vector<std::string> broken;
    for (const Include& one : includes) {
        if (!one.found) {
            if (!one.to.starts_with("spirv/")) // the build generates it
                broken.push_back(one.from + " includes \"" + one.to + "\", which the repository does not have");
            continue;
        }
        const Room *from = room_of(rooms, one.from), *to = room_of(rooms, one.to);
        if (!from || !to) {
            broken.push_back((from ? one.to : one.from) + " is in no room of CONTRIBUTING.md's table");
            continue;
        }
        const bool allowed = from == to || std::any_of(from->may.begin(), from->may.end(), [&](const std::string& folder) {
            return within(one.to, folder);
        });
        if (!allowed)
            broken.push_back(
                one.from + " includes " + one.to + ": " + from->folder + "/ may not include " + to->folder + "/");
    }
    return broken;
}

/// The files of one cycle of includes, with the first one at both ends; empty without a cycle.
std::vector<std::string> cycle(const std::vector<Include>& includes)
{
    std::map<std::string, std::vector<std::string>> next;
    for (const Include& one : includes)
        if (one.found)
            next[one.from].push_back(one.to);
    std::set<std::string> done;
    std::vector<std::string> path, found;
    const std::function<void(const std::string&)> visit = [&](const std::string& file) {
        if (!found.empty() || done.contains(file))
            return;
        if (const auto at = std::find(path.begin(), path.end(), file); at != path.end()) {
            found.assign(at, path.end());
            found.push_back(file);
            return;
        }
        path.push_back(file);
        for (const std::string& to : next[file])
            visit(to);
        path.pop_back();
        done.insert(file);
    };
    for (const Include& one : includes)
        visit(one.from);
    return found;
}

std::string lines(const std::vector<std::string>& all)
{
    std::string text;
    for (const std::string& one : all)
        text += one + "\n";
    return text;
}

const std::vector<Room>& rooms()
{
    static const std::vector<Room> all = rooms_of(read_text(source_dir() / "CONTRIBUTING.md"));
    return all;
}
const std::vector<Include>& includes()
{
    static const std::vector<Include> all = includes_of_repository();
    return all;
}

} // namespace

TEST(House, EveryIncludeFollowsTheTableOfRooms)
{
    ASSERT_GE(rooms().size(), 20u);
    ASSERT_GE(includes().size(), 900u); // otherwise some sources were not found
    EXPECT_EQ(lines(broken_rules(rooms(), includes())), "");
}

TEST(House, ARoomIncludesOnlyRoomsAboveItInTheTable)
{
    for (std::size_t i = 0; i < rooms().size(); ++i) {
        EXPECT_TRUE(fs::is_directory(source_dir() / rooms()[i].folder)) << rooms()[i].folder;
        // `runtime` and `displays` name all of their rooms, but only those above may be included.
        for (const Include& one : includes())
            if (one.found && room_of(rooms(), one.from) == &rooms()[i]) {
                const Room* to = room_of(rooms(), one.to);
                EXPECT_TRUE(to && to <= &rooms()[i]) << one.from << " includes " << one.to;
            }
    }
}

TEST(House, NoFilesIncludeEachOtherInACycle) { EXPECT_EQ(lines(cycle(includes())), ""); }

TEST(House, NoCodeIncludesVulkanOutsideRenderAndExhibit)
{
    const std::regex vulkan("#[ \t]*include[ \t]*<(vulkan|GLFW)/");
    for_each_source([&](const std::string& file, const std::string& code) {
        if (std::regex_search(code, vulkan)) {
            EXPECT_TRUE(within(file, "runtime/render") || within(file, "runtime/exhibit") || file == "input/keyboard.cpp"
                || file == "input/pad.cpp")
                << file;
        }
    });
}

/// Headers of `render` bring Vulkan along; rooms above must not use it all the same.
TEST(House, NoCodeNamesVulkanOutsideRenderAndExhibit)
{
    const std::regex vulkan(R"(\bvk::|\bVK_[A-Z]|\bvk[A-Z]\w+\()");
    int files = 0;
    for_each_source([&](const std::string& file, const std::string& code) {
        if (within(file, "runtime/render") || within(file, "runtime/exhibit"))
            return;
        ++files;
        std::istringstream text(code);
        int number = 0;
        for (std::string line; std::getline(text, line);) {
            ++number;
            EXPECT_FALSE(std::regex_search(line.substr(0, line.find("//")), vulkan))
                << file << ":" << number << ": " << line;
        }
    });
    EXPECT_GT(files, 200);
}

/// A stream would wait for ever for a FIFO or a device; config/json/whole_file.h opens regular files alone.
TEST(House, FilesAreOpenedInOnePlace)
{
    const std::regex opens(R"(\b[io]?fstream\b|\bfopen\(|\bopen(at)?\([^)]*, *O_|\bstbi?_\w*(info|load\w*)\(file)");
    const std::set<std::string> allowed{"config/json/whole_file.cpp",
        "runtime/operation/crash.cpp", // in a signal's handler
        "runtime/operation/messages.cpp", // /dev/null for closed streams
        "runtime/commands/doctor.cpp", "runtime/operation/vitals.cpp",
        "input/hid.cpp"}; // the kernel's files and the system's own
    for_each_source([&](const std::string& file, const std::string& code) {
        std::istringstream text(allowed.contains(file) ? "" : code);
        for (std::string line; std::getline(text, line);)
            EXPECT_FALSE(std::regex_search(line.substr(0, line.find("//")), opens)) << file << ": " << line;
    });
}

/// Two specializations in two units are a fault that no compiler sees: the linker takes either.
TEST(House, AStructIsDescribedOnce)
{
    const std::regex described(R"(constexpr auto description<(\w+)>)");
    std::map<std::string, std::string> places;
    for_each_source([&](const std::string& file, const std::string& code) {
        for (std::sregex_iterator one(code.begin(), code.end(), described), end; one != end; ++one) {
            const auto [there, is_first] = places.emplace((*one)[1], file);
            EXPECT_TRUE(is_first) << (*one)[1] << " in " << there->second << " and in " << file;
        }
    });
    EXPECT_GT(places.size(), 60u);
}

/// Lavapipe's fences are held where a rendering begins and ends (runtime/render/scene_keeper.h); a blit's can't be.
TEST(House, EveryRenderingBeginsAndEndsInTheDevice)
{
    const std::regex rendering(R"(beginRendering|endRendering|blitImage)");
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "runtime")) {
        std::istringstream text(entry.is_regular_file() ? read_text(entry.path()) : "");
        for (std::string line; std::getline(text, line);)
            if (std::regex_search(line.substr(0, line.find("//")), rendering))
                found.push_back(entry.path().filename().string() + ": " + line.substr(line.find_first_not_of(' ')));
    }
    EXPECT_EQ(lines(found), "device.cpp: commands.beginRendering(info);\ndevice.cpp: commands.endRendering();\n");
}

/// Pages name tests as `Suite.Name` beside the figures that they measure.
TEST(House, EveryTestThatAPageNamesExists)
{
    std::string tests;
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "tests"))
        if (entry.path().extension() == ".cpp")
            tests += read_text(entry.path());
    const std::regex name("`([A-Z][A-Za-z0-9]+)\\.([A-Z][A-Za-z0-9]+)`");
    int named = 0;
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "docs"))
        if (entry.path().extension() == ".md") {
            const std::string page = read_text(entry.path());
            for (std::sregex_iterator at(page.begin(), page.end(), name), end; at != end; ++at, ++named)
                EXPECT_TRUE((*at)[0] == "`Suite.Name`"
                    || std::regex_search(
                        tests, std::regex("TEST(_F|_P)?\\(" + (*at)[1].str() + ",\\s*" + (*at)[2].str() + "\\)")))
                    << entry.path().filename() << ": " << (*at)[0];
        }
    EXPECT_GT(named, 30);
}

/// starbow_room(NAME FOLDER LIBRARY...) in CMakeLists.txt may link only rooms that may be included.
TEST(House, ARoomsLibraryLinksOnlyWhatTheTableAllows)
{
    const std::string cmake = read_text(source_dir() / "CMakeLists.txt");
    static const std::regex call(R"((?:^|\n) *starbow_room\((\w+) ([\w/]+)([^)]*)\))");
    std::map<std::string, std::string> folder_of;
    std::vector<std::tuple<std::string, std::string>> calls;
    for (std::sregex_iterator at(cmake.begin(), cmake.end(), call), end; at != end; ++at) {
        folder_of["starbow_" + std::string((*at)[1])] = (*at)[2];
        calls.emplace_back((*at)[2], (*at)[3]);
    }
    ASSERT_GE(calls.size(), 13u);
    for (const auto& [folder, libraries] : calls) {
        std::istringstream words(libraries);
        for (std::string library; words >> library;) {
            if (!folder_of.contains(library))
                continue; // not a room
            const std::string to = folder_of.at(library);
            for (const Room& room : rooms())
                if (room.folder == folder) {
                    EXPECT_TRUE(std::any_of(room.may.begin(), room.may.end(),
                        [&](const std::string& may) { return to == may || within(to, may); }))
                        << folder << " links " << library << ", whose room it may not include";
                }
        }
    }
}

// Planted faults: the rules of this file must find them.
// GLSL 4.60 (4.7.1) allows a driver to leave out infinities and NaN: then isinf() and isnan() are never true, and a division
// by zero may be anything.
TEST(House, NoShaderReliesOnInfinitiesOrNaN)
{
    const std::regex relies(R"(isinf\s*\(|isnan\s*\(|[0-9.]\s*/\s*0\.0*([^0-9]|$))");
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "shaders")) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".frag" && extension != ".vert" && extension != ".glsl" && extension != ".comp")
            continue;
        std::istringstream text(read_text(entry.path()));
        std::string line;
        for (int number = 1; std::getline(text, line); ++number)
            if (std::regex_search(line.substr(0, line.find("//")), relies))
                found.push_back(entry.path().filename().string() + ":" + std::to_string(number) + ": " + line);
    }
    EXPECT_EQ(lines(found), "");
}

TEST(House, PlantedFaultsAreFound)
{
    const std::vector<Room> two{{"low", {}}, {"high", {"low"}}};
    const auto exists = [](const std::string& path) {
        return std::set<std::string>{"low/a.h", "low/b.h", "high/c.h", "stray/d.h"}.contains(path);
    };
    const auto includes = [&](const std::string& file, const std::string& text) { return includes_of(file, text, exists); };
    EXPECT_EQ(lines(broken_rules(two, includes("high/c.h", "#include \"low/a.h\"\n#include <vector>\n"))), "");
    EXPECT_EQ(lines(broken_rules(two, includes("low/a.h", "#pragma once\n#include \"high/c.h\"\n"))),
        "low/a.h includes high/c.h: low/ may not include high/\n");
    EXPECT_EQ(lines(broken_rules(two, includes("low/a.h", "  # include \"gone.h\"\n"))),
        "low/a.h includes \"gone.h\", which the repository does not have\n");
    EXPECT_EQ(lines(broken_rules(two, includes("high/c.h", "#include \"stray/d.h\""))),
        "stray/d.h is in no room of CONTRIBUTING.md's table\n");
    std::vector<Include> both = includes("low/a.h", "#include \"b.h\"");
    EXPECT_EQ(lines(cycle(both)), "");
    for (const Include& one : includes("low/b.h", "#include \"a.h\""))
        both.push_back(one);
    EXPECT_EQ(lines(cycle(both)), "low/a.h\nlow/b.h\nlow/a.h\n");
}

/// Their lists quote the code, and they run seldom.
TEST(House, ToysAndPlantedFaultsFindTheirPlaces)
{
    for (const char* script : {"tests/toys.py", "tests/planted_faults.py"})
        EXPECT_EQ(std::system((source_dir() / script).string().append(" --list >/dev/null").c_str()), 0) << script;
}

} // namespace house_test
