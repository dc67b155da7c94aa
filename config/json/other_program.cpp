#include "other_program.h"
#include "reader.h"
#include "whole_file.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace starbow {
namespace {

/// The last line that is not empty.
std::string last_line(const std::string& said)
{
    const std::size_t end = said.find_last_not_of(" \r\n");
    if (end == said.npos)
        return "";
    const std::size_t begin = said.find_last_of("\r\n", end);
    return one_line(said.substr(begin == said.npos ? 0 : begin + 1, end - (begin == said.npos ? -1 : begin)));
}

} // namespace

int start_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int says, pid_t& child)
{
    std::vector<char*> pointers;
    for (const std::string& argument : arguments)
        pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    if (says < 0)
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    else
        posix_spawn_file_actions_adddup2(&actions, says, 2);
    if (!folder.empty())
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    // The program ignores SIGPIPE; the other one may rely on it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t pipe_ends;
    sigemptyset(&pipe_ends);
    sigaddset(&pipe_ends, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &pipe_ends);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawnp(&child, pointers[0], &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

Ended ran(const std::vector<std::string>& arguments, const std::filesystem::path& folder)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return {-1, errno, ""};
    pid_t child = 0;
    const int error = start_program(arguments, folder, ends[1], child);
    close(ends[1]);
    Ended ended{-1, error, ""};
    if (error == 0) {
        std::array<char, 4096> piece;
        for (ssize_t got; (got = ::read(ends[0], piece.data(), piece.size())) > 0 || (got < 0 && errno == EINTR);) {
            ended.said.append(piece.data(), std::size_t(std::max<ssize_t>(got, 0)));
            if (ended.said.size() > 65536)
                ended.said.erase(0, ended.said.size() - 32768);
        }
        while (waitpid(child, &ended.status, 0) < 0 && errno == EINTR) { }
    }
    close(ends[0]);
    return ended;
}

Ended make_whole(const std::filesystem::path& file, const std::function<Ended(const std::filesystem::path& part)>& make)
{
    const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
    std::filesystem::path part = whole;
    part += '.' + std::to_string(getpid()) + ".part";
    Ended ended = make(part);
    std::error_code error;
    if (ended.status == 0)
        std::filesystem::rename(part, whole, error);
    if (ended.status == 0 && !error)
        return ended;
    const int why = error.value();
    std::filesystem::remove(part, error);
    if (ended.status == 0)
        refuse_writing(file, why);
    return ended;
}

std::string how(const Ended& ended)
{
    if (ended.status == -1)
        return std::strerror(ended.error);
    if (const std::string said = last_line(ended.said); !said.empty())
        return said;
    return WIFSIGNALED(ended.status) ? "ended by signal " + std::to_string(WTERMSIG(ended.status))
                                     : "exit status " + std::to_string(WEXITSTATUS(ended.status));
}

} // namespace starbow
