#pragma once
#include <string>
#include <sys/types.h>

namespace starbow {

/// Has texts read aloud by espeak-ng, a program of its own, so that no frame waits for it. One text at a time: a new one
/// interrupts the one before.
class Speaker {
public:
    /// program: takes espeak-ng's arguments; a name is looked up in the PATH.
    explicit Speaker(std::string program = "espeak-ng");
    ~Speaker(); ///< falls silent
    Speaker(const Speaker&) = delete;

    /// language: such as "en". An empty text only ends the one before. Where the program can't be started, that is logged
    /// once, and nothing is said.
    void say(const std::string& text, const std::string& language);

private:
    void end();

    std::string program_;
    pid_t child_ = 0; ///< 0: silent
    bool fails_ = false;
};

} // namespace starbow
