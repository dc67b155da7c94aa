#include "speaker.h"
#include "log.h"
#include <array>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace starbow {

Speaker::Speaker(std::string program)
    : program_(std::move(program))
{
}

Speaker::~Speaker() { end(); }

void Speaker::end()
{
    if (child_ == 0)
        return;
    kill(child_, SIGKILL); // one that has ended is still there, unreaped
    int status;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) { }
    child_ = 0;
}

void Speaker::say(const std::string& text, const std::string& language)
{
    end();
    if (text.empty() || fails_)
        return;
    const std::string words = " " + text; // so that no text is taken for an option
    std::array<const char*, 7> arguments{program_.c_str(), "-v", language.c_str(), "-s", "150", words.c_str(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    // The program ignores SIGPIPE; the other one may rely on it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t pipe_ends;
    sigemptyset(&pipe_ends);
    sigaddset(&pipe_ends, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &pipe_ends);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int error
        = posix_spawnp(&child_, program_.c_str(), &actions, &attributes, const_cast<char**>(arguments.data()), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error == 0)
        return;
    child_ = 0;
    fails_ = true;
    write_log(LogKind::speech_fails,
        program_ + " can't be started (" + std::strerror(error)
            + "); the package espeak-ng is right; nothing is read aloud");
}

} // namespace starbow
