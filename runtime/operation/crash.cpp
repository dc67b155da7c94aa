#include "crash.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <execinfo.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <ucontext.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace starbow {
namespace {

constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr std::array<const char*, 5> names = {"SIGSEGV", "SIGBUS", "SIGILL", "SIGFPE", "SIGABRT"};

// All that the handler needs is prepared, because it may neither allocate nor lock.
char folder_path[3072], version_line[64];
alignas(16) char handler_stack[64 << 10]; // a crash may be an overflow of the usual stack

/// Text of a fixed size, put together without the library.
struct Text {
    char text[4096];
    std::size_t length = 0;

    Text& operator<<(const char* more)
    {
        while (*more && length + 1 < sizeof text)
            text[length++] = *more++;
        text[length] = '\0';
        return *this;
    }
    Text& number(unsigned long long n, unsigned base = 10)
    {
        char digits[24], *at = digits + sizeof digits - 1;
        *at = '\0';
        do
            *--at = "0123456789abcdef"[n % base];
        while (n /= base);
        return *this << at;
    }
};

void write_out(int file, const Text& text)
{
    for (std::size_t done = 0; done < text.length;) {
        const ssize_t wrote = write(file, text.text + done, text.length - done);
        if (wrote <= 0 && errno != EINTR)
            return;
        done += wrote > 0 ? std::size_t(wrote) : 0;
    }
}

void make_folders()
{
    for (char* at = folder_path + 1; *at; ++at)
        if (*at == '/') {
            *at = '\0';
            mkdir(folder_path, 0755);
            *at = '/';
        }
    mkdir(folder_path, 0750);
}

/// The address of the instruction at which the signal came.
unsigned long long instruction([[maybe_unused]] const void* context)
{
#if defined(__x86_64__)
    return static_cast<unsigned long long>(static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
    return static_cast<const ucontext_t*>(context)->uc_mcontext.pc;
#else
    return 0;
#endif
}

/// Copies the process's map of files to addresses, with which the addresses find their functions.
void write_maps(int file)
{
    const int maps = open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
    char part[4096];
    for (ssize_t got; maps >= 0 && (got = read(maps, part, sizeof part)) > 0;)
        if (write(file, part, std::size_t(got)) != got)
            break;
    close(maps);
}

void leave_trace(int signal, siginfo_t* info, void* context)
{
    // The stack is read with the loader's locks. If the crash happened while they were held, the alarm ends the process.
    std::signal(SIGALRM, SIG_DFL);
    alarm(2);
    make_folders();
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    Text path, head;
    path << folder_path << "/";
    path.number((unsigned long long)(now.tv_sec)) << "-";
    path.number((unsigned long long)(getpid())) << ".txt";
    const int file = open(path.text, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0640);
    if (file >= 0) {
        head << "Starbow " << version_line << " ended by ";
        for (std::size_t i = 0; i < crashes.size(); ++i)
            if (crashes[i] == signal)
                head << names[i];
        head << " at Unix time ";
        head.number((unsigned long long)(now.tv_sec)) << "\ninstruction 0x";
        head.number(instruction(context), 16);
        // The sender of a signal that came from a process, and else the address that could not be used.
        if (info->si_code <= 0)
            (head << "\nsent by process ").number((unsigned long long)(info->si_pid));
        else
            (head << "\naddress 0x").number((unsigned long long)(info->si_addr), 16);
        head << "\n\n";
        write_out(file, head);
        std::array<void*, 64> stack;
        backtrace_symbols_fd(stack.data(), backtrace(stack.data(), int(stack.size())), file);
        Text gap;
        write_out(file, gap << "\n");
        write_maps(file);
        fsync(file);
        close(file);
        Text said;
        said << "starbow: ended by a crash; its trace is " << path.text << "\n";
        write_out(STDERR_FILENO, said);
    }
    alarm(0);
    raise(signal); // the handler is gone (SA_RESETHAND): the signal ends the process once it returns
}

void keep_newest(const std::filesystem::path& folder, std::size_t count)
{
    std::error_code ignored;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".txt")
            files.push_back(entry.path());
    // Their names begin with the time. Where the clock was set back, those of a time to come are the oldest.
    std::ranges::sort(files, {}, [now = std::time(nullptr)](const std::filesystem::path& file) {
        return std::pair(std::strtoll(file.filename().c_str(), nullptr, 10) <= now, file);
    });
    for (std::size_t i = 0; i + count < files.size(); ++i)
        std::filesystem::remove(files[i], ignored);
}

} // namespace

void keep_crash_traces(const std::filesystem::path& folder, const std::string& version)
{
    if (folder.empty() || folder.native().size() >= sizeof folder_path)
        return;
    keep_newest(folder, most_crash_traces);
    std::strcpy(folder_path, folder.c_str());
    std::strncpy(version_line, version.c_str(), sizeof version_line - 1);
    std::array<void*, 1> first;
    backtrace(first.data(), 1); // loads what later calls need, which a handler may not
    const stack_t own{handler_stack, 0, sizeof handler_stack};
    sigaltstack(&own, nullptr);
    struct sigaction act { };
    act.sa_sigaction = leave_trace;
    act.sa_flags = int(SA_SIGINFO | SA_ONSTACK | SA_RESETHAND);
    for (const int signal : crashes)
        sigaction(signal, &act, nullptr);
}

} // namespace starbow
