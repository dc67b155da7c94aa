#include "config/json/whole_file.h"
#include "tests/support/files.h"
#include <array>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace starbow::whole_file_test {
namespace {

using namespace starbow::testing;

std::filesystem::path fifo(const std::string& name)
{
    EXPECT_EQ(::mkfifo(scratch(name).c_str(), 0600), 0);
    return scratch(name);
}

std::filesystem::path socket_at(const std::string& name)
{
    sockaddr_un address{.sun_family = AF_UNIX};
    const std::string path = scratch(name).string();
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    const int made = ::socket(AF_UNIX, SOCK_DGRAM, 0);
    EXPECT_EQ(::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(made);
    return path;
}

std::span<const unsigned char> bytes(std::string_view text)
{
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

/// The bytes that this process has read from files so far, as the kernel counts them; that count included.
long bytes_read()
{
    std::ifstream counts("/proc/self/io");
    std::string name;
    long bytes = -1;
    counts >> name >> bytes;
    EXPECT_EQ(name, "rchar:");
    return bytes;
}

TEST(WholeFile, OnlyRegularFilesAreRead)
{
    const auto fault = [](const std::filesystem::path& file) {
        const std::string name = file.string(), said = complaint([&] { read_whole(file, 100, "a poem"); });
        EXPECT_TRUE(said.starts_with(name + ": ") && said.ends_with("; a poem is right")) << said;
        return said.substr(std::min(said.size(), name.size() + 2), said.size() - std::min(said.size(), name.size() + 19));
    };
    EXPECT_EQ(fault(fifo("reading")), "is a FIFO, not a file");
    EXPECT_EQ(fault(socket_at("s")), "is a socket, not a file");
    EXPECT_EQ(fault("/dev/zero"), "is a device, not a file");
    EXPECT_EQ(fault(scratch("")), "is a folder");
    EXPECT_EQ(fault(scratch("none")), "does not exist");
    EXPECT_EQ(fault(write_text("long", std::string(101, 'x'))), "is larger than 100 bytes");
    EXPECT_EQ(read_whole(write_text("short", std::string(100, 'x')), 100, "a poem"), std::string(100, 'x'));
    EXPECT_EQ(read_whole(write_text("empty", ""), 0, "a poem"), "");
    // The kernel's files say that they have no bytes.
    EXPECT_NE(read_whole("/proc/self/status", 1 << 16, "a status").find("Name:"), std::string::npos);
}

TEST(WholeFile, AFileThatIsTooLargeTakesNoMemory)
{
    const auto file = write_text("vast", "");
    ASSERT_EQ(::truncate(file.c_str(), off_t(30) << 30), 0);
    rusage before, after;
    ::getrusage(RUSAGE_SELF, &before);
    const long read_before = bytes_read();
    EXPECT_NE(complaint([&] { read_whole(file, std::size_t(512) << 20, "a file"); }).find("larger than 512 MiB"),
        std::string::npos);
    EXPECT_LT(bytes_read() - read_before, 10'000) << "of the kernel's own count alone";
    ::getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 10'000) << "KiB";
}

TEST(WholeFile, AFileIsReadInPieces)
{
    RegularFile file(write_text("pieces", "abcdefg"));
    std::array<char, 3> piece;
    std::string all;
    while (const std::size_t got = file.read(piece))
        all += std::string(piece.data(), got) + "|";
    EXPECT_EQ(all, "abc|def|g|");
}

TEST(WholeFile, APlantedLinkIsNotFollowed)
{
    const auto victim = write_text("victim", "untouched");
    const auto folder = scratch("cache");
    std::filesystem::create_directory(folder);
    std::filesystem::create_symlink(victim, folder / "kept");
    // Temporary names can be guessed: process and number. Other tests may have written some files before.
    constexpr int names = 5000;
    const auto plant = [](const std::filesystem::path& to, const std::filesystem::path& at) {
        for (int i = 0; i < names; ++i)
            std::filesystem::create_symlink(
                to, at.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(i) + ".part");
    };
    plant(victim, folder / "kept");
    write_own(folder / "kept", std::array{bytes("own "), bytes("bytes")});
    EXPECT_EQ(read_text(victim), "untouched");
    EXPECT_EQ(read_text(folder / "kept"), "own bytes");
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "kept"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), names) << "one of the links is gone";

    // A file of the user's may be a link, and stays one; its temporary file is planted here.
    std::filesystem::create_symlink(victim, scratch("link"));
    const auto other = write_text("other", "untouched");
    plant(other, victim);
    write_whole(scratch("link"), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(scratch("link")));
    EXPECT_EQ(read_text(victim), "new");
    EXPECT_EQ(read_text(other), "untouched");
}

TEST(WholeFile, WritingWaitsForNobody)
{
    const auto refusal = [](const std::filesystem::path& file) {
        return complaint([&] { ::close(open_to_write(file, O_APPEND, "a log")); });
    };
    const auto pipe = fifo("writing");
    EXPECT_EQ(refusal(pipe), pipe.string() + ": is a FIFO, not a file; a log is right");
    EXPECT_EQ(refusal(scratch("")), scratch("").string() + ": is a folder; a log is right");
    const int null = open_to_write("/dev/null", O_APPEND, "a log");
    EXPECT_NE(::fcntl(null, F_GETFL) & O_NONBLOCK, 0);
    ::close(null);
}

} // namespace
} // namespace starbow::whole_file_test
