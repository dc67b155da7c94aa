#include "recorder.h"
#include "config/json/whole_file.h"
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace starbow {
namespace fs = std::filesystem;
namespace {

/// The limit of entries that wait for a hanging disk, some hours' worth: beyond it the record ends.
constexpr std::size_t most_waiting = std::size_t(64) << 20;

fs::path named_by_time(const fs::path& folder)
{
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char name[64];
    std::strftime(name, sizeof name, "flight-%Y-%m-%d-%H%M%S", &local);
    std::error_code ignored;
    fs::path file = folder / (std::string(name) + ".jsonl");
    for (int i = 2; fs::exists(file, ignored) && i < 1000; ++i)
        file = folder / (std::string(name) + "-" + std::to_string(i) + ".jsonl");
    return file;
}

} // namespace

void wait_in_real_time(std::condition_variable& changed, std::unique_lock<std::mutex>& lock, std::chrono::nanoseconds longest,
    const std::function<bool()>& over)
{
    changed.wait_for(lock, longest, over);
}

Recorder::Recorder(const fs::path& file, const RecordHeader& header, LogTo log, TimedWait wait)
    : log_(std::move(log))
    , wait_(std::move(wait))
{
    std::error_code ignored;
    file_ = fs::is_directory(file, ignored) ? named_by_time(file) : file;
    struct stat known { };
    const bool there = stat(file_.c_str(), &known) == 0;
    ordinary_ = !there || S_ISREG(known.st_mode);
    stream_ = open_to_write(file_, O_EXCL, "the name of a new file, or a folder,");
    add(text_of(header));
    try {
        writer_ = std::thread([this] { write(); });
    } catch (...) {
        close(stream_);
        throw;
    }
}

Recorder::~Recorder()
{
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    writer_.join();
    close(stream_);
}

bool Recorder::failed() const
{
    const std::lock_guard lock(mutex_);
    return failed_;
}

void Recorder::add(const std::string& text)
{
    const std::lock_guard lock(mutex_);
    if (failed_)
        return;
    waiting_ += text;
    if (waiting_.size() <= most_waiting)
        return;
    failed_ = true;
    waiting_.clear();
    log_(LogKind::record_ended, file_.string() + ": the disk does not keep up; the record ends here, the flight goes on");
}

void Recorder::keep(const RecordEntry& entry, const Flight& flight)
{
    std::string text = text_of(entry);
    if (flight.ticks / check_every_ticks != checked_ticks_ / check_every_ticks)
        text += text_of(RecordCheck{flight.ticks, digest(flight)});
    checked_ticks_ = flight.ticks;
    add(text);
}

void Recorder::end(const Flight& flight) { add(text_of(RecordCheck{flight.ticks, digest(flight), true})); }

/// Writes the waiting entries every second, until the record ends or there is no memory for it.
void Recorder::write() noexcept
try {
    for (std::unique_lock lock(mutex_);;) {
        wait_(changed_, lock, std::chrono::seconds(1), [this] { return ended_; });
        const bool last = ended_;
        const std::string text = std::exchange(waiting_, {});
        if (!text.empty()) {
            lock.unlock();
            write_out(text);
            lock.lock();
        }
        if (last || failed_)
            return;
    }
} catch (const std::bad_alloc&) {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    std::string().swap(waiting_);
}

void Recorder::write_out(const std::string& text)
{
    const auto fail = [this](const std::string& why) {
        const std::lock_guard lock(mutex_);
        if (!failed_)
            log_(LogKind::record_ended, file_.string() + ": " + why + "; the record ends here, the flight goes on");
        failed_ = true;
        waiting_.clear();
    };
    std::error_code ignored;
    const fs::space_info space = fs::space(file_, ignored); // -1 where it is unknown, which counts as plenty
    if (ordinary_ && space.available < least_free_bytes)
        return fail("less than " + std::to_string(least_free_bytes >> 20) + " MiB are free on its disk");
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t wrote = ::write(stream_, text.data() + done, text.size() - done);
        if (wrote < 0 && errno == EINTR)
            continue;
        if (wrote < 0)
            return fail(std::string("can't be written (") + std::strerror(errno) + ")");
        done += std::size_t(wrote);
    }
    if (ordinary_ && fdatasync(stream_) != 0)
        fail(std::string("can't be written (") + std::strerror(errno) + ")");
}

} // namespace starbow
