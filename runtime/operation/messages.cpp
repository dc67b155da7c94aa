#include "messages.h"
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <poll.h>
#include <pthread.h>
#include <string_view>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace starbow {
namespace {

/// Writes a whole text, however long the reader takes. Returns false if it never can.
bool write_text(int to, std::string_view text)
{
    while (!text.empty()) {
        const ssize_t wrote = ::write(to, text.data(), text.size());
        if (wrote > 0)
            text.remove_prefix(std::size_t(wrote));
        else if (wrote < 0 && errno == EAGAIN) {
            pollfd room{to, POLLOUT, 0};
            ::poll(&room, 1, 1000);
        } else if (wrote == 0 || errno != EINTR)
            return false;
    }
    return true;
}

/// A stream with its own thread, so that one without a reader does not hold the other. It is never destroyed: the thread may
/// be held in a write for ever, and the process ends all the same.
class Channel {
public:
    explicit Channel(int descriptor)
        : descriptor_(descriptor)
    {
        // A signal is for the threads that fly.
        sigset_t all, before;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
        try {
            std::thread([this] { write(); }).detach();
        } catch (const std::system_error&) {
            alone_ = true;
        }
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }

    void send(std::string text)
    {
        if (alone_) {
            write_text(descriptor_, text);
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            if (waiting_.size() + text.size() > most_waiting_messages)
                ++dropped_;
            else
                waiting_ += text;
        }
        changed_.notify_all();
    }

    bool flush(std::chrono::steady_clock::time_point until)
    {
        std::unique_lock lock(mutex_);
        return changed_.wait_until(lock, until, [this] { return waiting_.empty() && dropped_ == 0 && !writes_; });
    }

private:
    void write()
    {
        for (std::unique_lock lock(mutex_);;) {
            changed_.wait(lock, [this] { return !waiting_.empty() || dropped_ > 0; });
            std::string text = std::exchange(waiting_, {});
            // The dropped messages came after all that wait.
            if (const long dropped = std::exchange(dropped_, 0); dropped > 0)
                text += "starbow: " + std::to_string(dropped) + (dropped == 1 ? " message is" : " messages are")
                    + " dropped here, because nobody read them in time\n";
            writes_ = true;
            lock.unlock();
            write_text(descriptor_, text);
            lock.lock();
            writes_ = false;
            changed_.notify_all();
        }
    }

    const int descriptor_;
    bool alone_ = false; ///< the system has no thread for this stream: the callers write
    std::mutex mutex_;
    std::condition_variable changed_;
    std::string waiting_;
    long dropped_ = 0;
    bool writes_ = false;
};

struct Channels {
    std::mutex mutex;
    std::map<int, Channel*> by_descriptor;
    Channels()
    {
        std::atexit([] { flush_messages(1); });
    }
};
Channels& channels()
{
    static auto& only = *new Channels;
    return only;
}

} // namespace

void send_message(int descriptor, std::string text)
{
    Channel* channel;
    {
        Channels& all = channels();
        const std::lock_guard lock(all.mutex);
        Channel*& kept = all.by_descriptor[descriptor];
        if (!kept)
            kept = new Channel(descriptor);
        channel = kept;
    }
    channel->send(std::move(text));
}

void print_message(std::string text) { send_message(STDOUT_FILENO, std::move(text += '\n')); }

bool flush_messages(double longest_s)
{
    const auto until = std::chrono::steady_clock::now()
        + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(longest_s));
    std::map<int, Channel*> all;
    {
        const std::lock_guard lock(channels().mutex);
        all = channels().by_descriptor;
    }
    bool done = true;
    for (const auto& [descriptor, channel] : all)
        done &= channel->flush(until);
    return done;
}

void guard_streams()
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        if (fcntl(stream, F_GETFD) < 0)
            (void)!::open("/dev/null", O_RDWR); // takes the lowest free number, which is this one
    std::signal(SIGPIPE, SIG_IGN);
}

std::string size_text(double bytes)
{
    const char* unit = "B";
    for (const char* next : {"KiB", "MiB", "GiB", "TiB"})
        if (bytes >= 1024)
            bytes /= 1024, unit = next;
    char text[40];
    std::snprintf(text, sizeof text, bytes < 10 && *unit != 'B' ? "%.1f %s" : "%.0f %s", bytes, unit);
    return text;
}

} // namespace starbow
