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
    const int error
        = posix_spawnp(&child_, program_.c_str(), &actions, nullptr, const_cast<char**>(arguments.data()), environ);
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
