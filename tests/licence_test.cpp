// The licence of every file: REUSE.toml names one for each, LICENSES/ has their texts, and NOTICE and the package's
// copyright file say the same. NOTICE names every library that the build looks for.
#include "tests/support/files.h"
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace licence_test {

using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

const std::string our_licence = "LGPL-3.0-or-later";
const std::vector<std::string> our_copyright{"2026 Starbow authors"};

/// Files that match one of the patterns, with their copyright holders and their licence as an SPDX expression.
struct Stanza {
    std::vector<std::string> patterns, copyrights;
    std::string licence;

    bool ours() const { return licence == our_licence && copyrights == our_copyright; }
};
using Files = std::vector<std::string>;

/// * stands for any characters of one folder's name or file's name, ** for any characters at all.
bool matches(std::string_view pattern, std::string_view path)
{
    if (pattern.empty())
        return path.empty();
    if (pattern[0] != '*')
        return !path.empty() && path[0] == pattern[0] && matches(pattern.substr(1), path.substr(1));
    const bool folders = pattern.starts_with("**");
    for (std::size_t taken = 0; taken <= path.size(); ++taken) {
        if (matches(pattern.substr(folders ? 2 : 1), path.substr(taken)))
            return true;
        if (!folders && taken < path.size() && path[taken] == '/')
            return false;
    }
    return false;
}

std::string joined(const std::vector<std::string>& words, const std::string& between)
{
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "" : between) + word;
    return all;
}

std::vector<std::string> parts(const std::string& text, const std::string& separator)
{
    static const std::string space = " \t\n";
    std::vector<std::string> all;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        std::string part = text.substr(at, end - at);
        part.erase(0, std::min(part.find_first_not_of(space), part.size()));
        part.erase(part.find_last_not_of(space) + 1);
        if (!part.empty())
            all.push_back(part);
        at = end + separator.size();
    }
    return all;
}

/// The tables of REUSE.toml, which uses a part of TOML: tables, keys with a string or an array of strings, whole lines of
/// comment. Throws where it uses more.
std::vector<Stanza> stanzas_of_reuse(const std::string& text)
{
    std::vector<Stanza> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#')
            continue;
        if (line == "[[annotations]]") {
            all.emplace_back();
            continue;
        }
        for (std::string more; line.ends_with("[") || (line.find('[') != std::string::npos && !line.ends_with("]"));)
            if (std::getline(lines, more))
                line += more;
            else
                throw std::runtime_error("an array does not end: " + line);
        const std::string key = line.substr(0, line.find(" = "));
        static const std::regex quoted("\"([^\"]*)\"");
        std::vector<std::string> values;
        for (std::sregex_iterator at(line.begin(), line.end(), quoted), end; at != end; ++at)
            values.push_back((*at)[1]);
        if (all.empty() ? line != "version = 1" : values.empty())
            throw std::runtime_error("not understood: " + line);
        if (key == "path")
            all.back().patterns = values;
        else if (key == "SPDX-FileCopyrightText")
            all.back().copyrights = values;
        else if (key == "SPDX-License-Identifier")
            all.back().licence = values.at(0);
        else if (!all.empty() && (key != "precedence" || values.at(0) != "override"))
            throw std::runtime_error("not understood: " + line);
    }
    return all;
}

/// The entries of NOTICE's first section: patterns at the left margin, below them lines "Licence:" and "Copyright:", and the
/// source.
std::vector<Stanza> stanzas_of_notice(const std::string& text)
{
    std::vector<Stanza> all;
    const std::size_t first = text.find("\n1. "), second = text.find("\n2. ");
    for (const std::string& paragraph : parts(text.substr(first, second - first), "\n\n")) {
        if (paragraph.find("\n  Licence: ") == std::string::npos)
            continue;
        Stanza entry;
        std::string patterns;
        std::istringstream lines(paragraph);
        for (std::string line; std::getline(lines, line);)
            if (!line.starts_with("  "))
                patterns += line + " ";
            else if (line.starts_with("  Licence: "))
                entry.licence = line.substr(11);
            else if (line.starts_with("  Copyright: "))
                entry.copyrights.push_back(line.substr(13));
        entry.patterns = parts(patterns, ",");
        all.push_back(entry);
    }
    return all;
}

/// The stanzas of a Debian copyright file (DEP-5) that name files, and the licences that it explains. A * there also stands
/// for /.
struct DebianCopyright {
    std::vector<Stanza> stanzas;
    std::set<std::string> explained;
};
DebianCopyright debian_copyright(const std::string& text)
{
    DebianCopyright found;
    for (const std::string& paragraph : parts(text, "\n\n")) {
        std::map<std::string, std::string> fields;
        std::string key;
        std::istringstream lines(paragraph);
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with(" ")) {
                key = line.substr(0, line.find(':'));
                line.erase(0, line.find(':') + 1);
            }
            fields[key] += line + "\n";
        }
        if (!fields.contains("License"))
            continue;
        const std::vector<std::string> licence = parts(fields["License"], "\n");
        if (!fields.contains("Files")) {
            if (licence.size() > 1)
                found.explained.insert(licence[0]);
            continue;
        }
        Stanza one{parts(fields["Files"], "\n"), parts(fields["Copyright"], "\n"), licence.at(0)};
        for (std::string& pattern : one.patterns)
            pattern = joined(parts(pattern, "*"), "**") + (pattern.ends_with("*") ? "**" : "");
        found.stanzas.push_back(one);
    }
    return found;
}

/// Debian's names for an SPDX expression's licences.
std::string debian_licence(const std::string& spdx)
{
    static const std::map<std::string, std::string> names{{"LGPL-3.0-or-later", "LGPL-3+"}, {"GPL-3.0-or-later", "GPL-3+"},
        {"MIT", "Expat"}, {"BSD-3-Clause", "BSD-3-clause"}};
    std::vector<std::string> all = parts(spdx, " AND ");
    for (std::string& one : all) {
        if (one.starts_with("LicenseRef-"))
            one.erase(0, 11);
        if (names.contains(one))
            one = names.at(one);
    }
    return joined(all, " and ");
}

/// Both formats say: the last stanza that names a file applies to it.
const Stanza* stanza_for(const std::vector<Stanza>& stanzas, const std::string& file)
{
    const auto at = std::find_if(stanzas.rbegin(), stanzas.rend(), [&](const Stanza& one) {
        return std::any_of(
            one.patterns.begin(), one.patterns.end(), [&](const std::string& pattern) { return matches(pattern, file); });
    });
    return at == stanzas.rend() ? nullptr : &*at;
}

std::vector<std::string> idle_patterns(const std::vector<Stanza>& stanzas, const Files& files)
{
    std::vector<std::string> idle;
    for (const Stanza& one : stanzas)
        for (const std::string& pattern : one.patterns)
            if (std::none_of(files.begin(), files.end(), [&](const std::string& file) { return matches(pattern, file); }))
                idle.push_back(pattern);
    return idle;
}

/// One sentence for each fault. texts: the names in LICENSES/ without their ending.
std::string reuse_faults(const std::vector<Stanza>& reuse, const Files& files, const std::set<std::string>& texts)
{
    std::string faults;
    std::set<std::string> used;
    for (const std::string& file : files) {
        if (file.starts_with("LICENSES/") || file == "LICENSE")
            continue; // the licences themselves
        const Stanza* stanza = stanza_for(reuse, file);
        if (!stanza || stanza->licence.empty())
            faults += file + " has no licence in REUSE.toml\n";
        else if (stanza->copyrights.empty())
            faults += file + " has no copyright in REUSE.toml\n";
        else
            for (const std::string& licence : parts(stanza->licence, " AND "))
                used.insert(licence);
    }
    for (const std::string& licence : used)
        if (!texts.contains(licence))
            faults += licence + " has no text in LICENSES/\n";
    for (const std::string& licence : texts)
        if (!used.contains(licence))
            faults += "LICENSES/" + licence + ".txt is the licence of no file\n";
    for (const std::string& pattern : idle_patterns(reuse, files))
        faults += "REUSE.toml names " + pattern + ", which is no file\n";
    return faults;
}

std::string notice_faults(const std::vector<Stanza>& notice, const std::vector<Stanza>& reuse, const Files& files)
{
    std::string faults;
    for (const std::string& file : files) {
        const Stanza *told = stanza_for(notice, file), *truth = stanza_for(reuse, file);
        if (!truth)
            continue; // reuse_faults says so
        if (!told && !truth->ours())
            faults += "NOTICE does not name " + file + ", which is not ours alone\n";
        else if (told && told->licence != truth->licence)
            faults += "NOTICE gives " + file + " the licence " + told->licence + ", and REUSE.toml " + truth->licence + "\n";
        else if (told && told->copyrights != truth->copyrights)
            faults += "NOTICE gives " + file + " the copyright " + joined(told->copyrights, "; ") + ", and REUSE.toml "
                + joined(truth->copyrights, "; ") + "\n";
    }
    for (const std::string& pattern : idle_patterns(notice, files))
        faults += "NOTICE names " + pattern + ", which is no file\n";
    return faults;
}

std::string debian_faults(const DebianCopyright& debian, const std::vector<Stanza>& reuse, const Files& files)
{
    std::string faults;
    for (const std::string& file : files) {
        const Stanza *told = stanza_for(debian.stanzas, file), *truth = stanza_for(reuse, file);
        if (!truth)
            continue;
        if (!told || told->licence != debian_licence(truth->licence) || told->copyrights != truth->copyrights)
            faults += "packaging/copyright gives " + file + " the licence " + (told ? told->licence : "none")
                + ", copyright " + (told ? joined(told->copyrights, "; ") : "none") + "\n";
    }
    for (const Stanza& one : debian.stanzas)
        for (const std::string& licence : parts(one.licence, " and "))
            if (!debian.explained.contains(licence))
                faults += "packaging/copyright does not explain " + licence + "\n";
    for (const std::string& pattern : idle_patterns(debian.stanzas, files))
        faults += "packaging/copyright names " + pattern + ", which is no file\n";
    return faults;
}

/// The names in the last column of NOTICE's table of libraries.
std::set<std::string> libraries_of_notice(const std::string& text)
{
    std::set<std::string> names;
    std::istringstream lines(text.substr(text.find("\n3. ")));
    for (std::string line; std::getline(lines, line);)
        if (const std::vector<std::string> columns = parts(line, "  "); line.starts_with("  ") && columns.size() == 4)
            for (const std::string& name : parts(columns[3], ","))
                names.insert(name);
    return names;
}

/// What a CMake file finds outside the repository, and the libraries that it links by their bare names.
std::set<std::string> libraries_of_cmake(const std::string& text)
{
    static const std::regex package(R"(find_package\((\w+))"),
        named(R"(find_(?:library|path|program)\(\w+ (?:NAMES )?([\w.-]+))"),
        pkg_config(R"(pkg_check_modules\(\w+ REQUIRED ([\w.-]+))"), link(R"(target_link_libraries\(([^)]*)\))"),
        target(R"((?:add_library|add_executable|TARGET)[( ]([\w-]+))");
    const auto words = [&](const std::regex& call) {
        std::set<std::string> found;
        for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at)
            found.insert((*at)[1]);
        return found;
    };
    std::set<std::string> all = words(package);
    all.merge(words(named));
    all.merge(words(pkg_config));
    const std::set<std::string> own = words(target);
    for (const std::string& call : words(link)) {
        std::istringstream arguments(call);
        for (std::string word; arguments >> word;)
            if (const std::string name = word.substr(0, word.find("::")); !name.starts_with("$") && !name.starts_with("-")
                && !name.starts_with("starbow") && !own.contains(name) && name != "PUBLIC" && name != "PRIVATE")
                all.insert(name);
    }
    return all;
}

/// The libraries that a source includes with angle brackets: an include's folder, or its file's name. Those of C, POSIX and
/// Linux are left out, as are generated ones.
std::set<std::string> libraries_of_source(const std::string& text)
{
    static const std::regex include("(?:^|\n)[ \t]*#[ \t]*include[ \t]*<([^>]+)>");
    static const std::set<std::string> of_the_system{"arpa", "dirent.h", "dlfcn.h", "execinfo.h", "fcntl.h", "ifaddrs.h",
        "link.h", "linux", "malloc.h", "net", "netinet", "poll.h", "pthread.h", "pty.h", "spawn.h", "sys", "termios.h",
        "time.h", "ucontext.h", "unistd.h", "machines.h", "map_sources.h", "known_texts.inc"};
    std::set<std::string> all;
    for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at) {
        const std::string whole = (*at)[1], name = whole.substr(0, whole.find('/'));
        if (whole.find_first_of("./") != std::string::npos && !of_the_system.contains(name))
            all.insert(name);
    }
    return all;
}

std::string missing(const std::set<std::string>& needed, const std::set<std::string>& named)
{
    std::string faults;
    for (const std::string& name : needed)
        if (!named.contains(name))
            faults += "NOTICE names no library " + name + "\n";
    return faults;
}

/// The files that git tracks; in a source archive, which has no .git, all files but those that are built or rendered.
Files files_of_repository()
{
    Files files;
    const fs::path root = source_dir();
    const std::string command = "git -C '" + root.string() + "' ls-files -z";
    if (fs::exists(root / ".git"))
        if (const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose); pipe) {
            std::string name;
            for (int c; (c = std::fgetc(pipe.get())) != EOF;)
                if (c == 0)
                    files.push_back(std::exchange(name, {}));
                else
                    name += char(c);
        }
    if (files.empty())
        for (fs::recursive_directory_iterator at(root), end; at != end; ++at) {
            const std::string name = fs::relative(at->path(), root).generic_string();
            if (name == "build" || name == "out" || name == ".git" || at->path().filename() == "__pycache__")
                at.disable_recursion_pending();
            else if (!at->is_directory())
                files.push_back(name);
        }
    return files;
}

std::string text_of(const std::string& file) { return read_text(source_dir() / file); }

const Files& files()
{
    static const Files all = files_of_repository();
    return all;
}
const std::vector<Stanza>& reuse()
{
    static const std::vector<Stanza> all = stanzas_of_reuse(text_of("REUSE.toml"));
    return all;
}

} // namespace

TEST(LicenceTest, EveryFileHasALicenceAndEveryLicenceATextAndAFile)
{
    ASSERT_GT(files().size(), 1300u);
    std::set<std::string> texts;
    for (const auto& entry : fs::directory_iterator(source_dir() / "LICENSES")) {
        EXPECT_EQ(entry.path().extension(), ".txt");
        EXPECT_GT(fs::file_size(entry.path()), 100u) << entry.path();
        texts.insert(entry.path().stem().string());
    }
    EXPECT_EQ(reuse_faults(reuse(), files(), texts), "");
    EXPECT_TRUE(text_of("LICENSE") == text_of("LICENSES/" + our_licence + ".txt"));
}

TEST(LicenceTest, NoticeNamesEveryFileByOthers)
{
    const std::vector<Stanza> notice = stanzas_of_notice(text_of("NOTICE"));
    ASSERT_GE(notice.size(), 20u);
    EXPECT_EQ(notice_faults(notice, reuse(), files()), "");
}

TEST(LicenceTest, ThePackagesCopyrightFileSaysTheSame)
{
    const std::string text = text_of("packaging/copyright");
    EXPECT_TRUE(text.starts_with("Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"));
    EXPECT_EQ(debian_faults(debian_copyright(text), reuse(), files()), "");
}

TEST(LicenceTest, NoticeNamesEveryLibrary)
{
    const std::set<std::string> named = libraries_of_notice(text_of("NOTICE"));
    std::set<std::string> needed = libraries_of_cmake(text_of("CMakeLists.txt"));
    needed.merge(libraries_of_cmake(text_of("tests/tests.cmake")));
    ASSERT_GE(needed.size(), 30u);
    for (const std::string& file : files())
        if (file.ends_with(".cpp") || file.ends_with(".h"))
            needed.merge(libraries_of_source(text_of(file)));
    ASSERT_GE(needed.size(), 50u);
    EXPECT_EQ(missing(needed, named), "");
}

/// The licence and the version stand in several files.
TEST(LicenceTest, OtherFilesNameTheSameLicenceAndVersion)
{
    std::smatch version;
    const std::string cmake = text_of("CMakeLists.txt"), citation = text_of("CITATION.cff");
    ASSERT_TRUE(std::regex_search(cmake, version, std::regex(R"(project\(starbow VERSION ([\d.]+))")));
    EXPECT_NE(citation.find("\nversion: " + version[1].str() + "\n"), std::string::npos);
    EXPECT_NE(citation.find("\nlicense: " + our_licence + "\n"), std::string::npos);
    EXPECT_NE(text_of("packaging/starbow.metainfo.xml").find("<project_license>" + our_licence + "</project_license>"),
        std::string::npos);
}

// Planted faults: the rules of this file must find them.
TEST(LicenceTest, PatternsKeepToFolders)
{
    EXPECT_TRUE(matches("a/*.h", "a/b.h"));
    EXPECT_FALSE(matches("a/*.h", "a/b/c.h"));
    EXPECT_TRUE(matches("a/**.h", "a/b/c.h"));
    EXPECT_FALSE(matches("a/**.h", "b/a/c.h"));
    EXPECT_FALSE(matches("a", "a/b"));
    EXPECT_FALSE(matches("a.h", "aXh"));
}

TEST(LicenceTest, PlantedFaultsAreFound)
{
    const std::string toml
        = "version = 1\n# ours\n[[annotations]]\npath = [\n    \"code/**.h\", \"REUSE.toml\"\n]\nprecedence = \"override\"\n"
          "SPDX-FileCopyrightText = \"2026 Starbow authors\"\nSPDX-License-Identifier = \"LGPL-3.0-or-later\"\n"
          "[[annotations]]\npath = \"data/*\"\nprecedence = \"override\"\n"
          "SPDX-FileCopyrightText = [\"1999 A\", \"2000 B\"]\nSPDX-License-Identifier = \"MIT AND CC0-1.0\"\n";
    const std::vector<Stanza> good = stanzas_of_reuse(toml);
    const std::set<std::string> texts{"LGPL-3.0-or-later", "MIT", "CC0-1.0"};
    Files files{"REUSE.toml", "LICENSE", "LICENSES/MIT.txt", "code/a/b.h", "data/x.png"};
    EXPECT_EQ(reuse_faults(good, files, texts), "");
    EXPECT_EQ(reuse_faults(good, files, {"LGPL-3.0-or-later", "MIT"}), "CC0-1.0 has no text in LICENSES/\n");
    EXPECT_EQ(reuse_faults(good, files, {"LGPL-3.0-or-later", "MIT", "CC0-1.0", "ISC"}),
        "LICENSES/ISC.txt is the licence of no file\n");
    files.push_back("code/a/font.ttf");
    EXPECT_EQ(reuse_faults(good, files, texts), "code/a/font.ttf has no licence in REUSE.toml\n");
    files.pop_back();
    EXPECT_EQ(reuse_faults(good, {"REUSE.toml", "code/a.h"}, {"LGPL-3.0-or-later"}),
        "REUSE.toml names data/*, which is no file\n");
    EXPECT_THROW(stanzas_of_reuse("version = 1\n[[annotations]]\npath = [\n"), std::runtime_error);
    EXPECT_THROW(stanzas_of_reuse("version = 1\n[[annotations]]\nprecedence = \"closest\"\n"), std::runtime_error);

    const auto told = [&](const std::string& entries) {
        return notice_faults(stanzas_of_notice("\n1. Files\n\n" + entries + "\n\n2. Numbers\n"), good, files);
    };
    EXPECT_EQ(
        told("data/x.png,\ndata/*\n  Licence: MIT AND CC0-1.0\n  Copyright: 1999 A\n  Copyright: 2000 B\n  From there."),
        "");
    EXPECT_EQ(told(""), "NOTICE does not name data/x.png, which is not ours alone\n");
    EXPECT_EQ(told("data/*\n  Licence: MIT\n  Copyright: 1999 A\n  Copyright: 2000 B"),
        "NOTICE gives data/x.png the licence MIT, and REUSE.toml MIT AND CC0-1.0\n");
    EXPECT_EQ(told("data/*\n  Licence: MIT AND CC0-1.0\n  Copyright: 1999 A"),
        "NOTICE gives data/x.png the copyright 1999 A, and REUSE.toml 1999 A; 2000 B\n");
    EXPECT_EQ(told("data/*, gone\n  Licence: MIT AND CC0-1.0\n  Copyright: 1999 A\n  Copyright: 2000 B"),
        "NOTICE names gone, which is no file\n");

    const std::string head
        = "Format: x\n\nFiles: *\nCopyright: 2026 Starbow authors\nLicense: LGPL-3+\n\nLicense: LGPL-3+\n See.\n";
    const Files ours_and_data{"code/a/b.h", "data/x.png"};
    const std::string rest
        = "\nFiles: data/*\nCopyright: 1999 A\n 2000 B\nLicense: Expat and CC0-1.0\n\nLicense: Expat\n See.\n";
    EXPECT_EQ(debian_faults(debian_copyright(head + rest + "\nLicense: CC0-1.0\n See.\n"), good, ours_and_data), "");
    EXPECT_EQ(
        debian_faults(debian_copyright(head + rest), good, ours_and_data), "packaging/copyright does not explain CC0-1.0\n");
    EXPECT_EQ(debian_faults(debian_copyright(head), good, ours_and_data),
        "packaging/copyright gives data/x.png the licence LGPL-3+, copyright 2026 Starbow authors\n");

    const std::set<std::string> named
        = libraries_of_notice("\n3. Libraries\n\n  linked  version  licence  names\n  A B  1.0  MIT  glm, a.h\n");
    EXPECT_EQ(missing(libraries_of_cmake("find_package(glm REQUIRED)\nadd_executable(mine x.cpp)\n"
                                         "target_link_libraries(mine PRIVATE glm::glm ${Z} starbow_x)\n"),
                  named),
        "");
    EXPECT_EQ(missing(libraries_of_cmake("find_library(X NAMES newest REQUIRED)\ntarget_link_libraries(mine quad)\n"
                                         "pkg_check_modules(Y REQUIRED u-1.0)\nfind_path(Z z.h)\n"),
                  named),
        "NOTICE names no library mine\nNOTICE names no library newest\nNOTICE names no library quad\nNOTICE names no "
        "library u-1.0\n"
        "NOTICE names no library z.h\n");
    EXPECT_EQ(
        missing(libraries_of_source("#include <vector>\n#include <sys/stat.h>\n#include <glm/glm.hpp>\n#include <a.h>\n"),
            named),
        "");
    EXPECT_EQ(missing(libraries_of_source("#include <header/only.hpp>\n"), named), "NOTICE names no library header\n");
}

} // namespace licence_test
