#include "interrupt.h"
#include <csignal>

namespace starbow {
namespace {

volatile std::sig_atomic_t arrived = 0;

} // namespace

void catch_interrupts()
{
    struct sigaction act { };
    act.sa_handler = [](int) { arrived = 1; };
    act.sa_flags = int(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    // The terminal closes; nohup has its way.
    struct sigaction before { };
    if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &act, nullptr);
}

bool interrupted() { return arrived; }

} // namespace starbow
