#include "speaker.h"
#include "config/json/other_program.h"
#include "log.h"
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sys/wait.h>

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
    const int error = start_program({program_, "-v", language, "-s", "150", words}, {}, -1, child_);
    if (error == 0)
        return;
    child_ = 0;
    fails_ = true;
    write_log(LogKind::speech_fails,
        program_ + " can't be started (" + std::strerror(error)
            + "); the package espeak-ng is right; nothing is read aloud");
}

} // namespace starbow
