#include "trace.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "log.h"
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace starbow {
namespace {

constexpr int processor = 1, gpu_process = 2; // the format's process numbers, one group of tracks each
constexpr std::size_t most_waiting = 1 << 16; // bytes
constexpr std::int64_t longest_wait_ns = 250'000'000;

/// Microseconds, the format's unit, with three decimals.
std::string us(std::int64_t ns)
{
    const std::int64_t rest = std::abs(ns % 1000);
    char text[40];
    std::snprintf(text, sizeof text, "%s%lld.%03lld", ns < 0 ? "-" : "", static_cast<long long>(std::abs(ns / 1000)),
        static_cast<long long>(rest));
    return text;
}

/// A JSON string with its quotes. Bytes that are no UTF-8 become U+FFFD.
std::string quoted(std::string_view text)
{
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace

std::int64_t Trace::now_ns()
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Trace::Trace(const std::filesystem::path& file, std::int64_t largest_bytes, std::int64_t (*now)())
    : file_(file.string())
    , now_(now)
    , began_ns_(now())
    , written_ns_(began_ns_)
    , largest_bytes_(largest_bytes)
{
    std::error_code error;
    if (file.has_parent_path())
        std::filesystem::create_directories(file.parent_path(), error);
    stream_ = open_to_write(file, O_TRUNC, "a JSON file in a folder that can be written");
    waiting_ = "[\n";
    add_metadata("process_name", processor, 0, "processor");
    add_metadata("process_name", gpu_process, 0, "GPU");
    add_metadata("thread_name", gpu_process, 1, "queue");
    if (const std::string why = write_out(); !why.empty()) {
        close(stream_);
        throw InputError(file_, "", "can't be written (" + why + "); a JSON file on a disk with space is right");
    }
}

Trace::~Trace()
{
    const std::lock_guard lock(mutex_);
    close_array();
}

void Trace::name_thread(std::string_view name)
{
    const std::lock_guard lock(mutex_);
    thread_number(name);
}

void Trace::cpu(std::string_view name, std::int64_t begin_ns, std::int64_t duration_ns)
{
    const std::lock_guard lock(mutex_);
    add_span(name, processor, thread_number(), begin_ns, duration_ns);
}

void Trace::gpu(std::string_view name, std::int64_t begin_ns, std::int64_t duration_ns)
{
    const std::lock_guard lock(mutex_);
    add_span(name, gpu_process, 1, begin_ns, duration_ns);
}

void Trace::counter(std::string_view name, double value)
{
    if (!std::isfinite(value))
        return;
    const std::lock_guard lock(mutex_);
    add("{\"ph\":\"C\",\"name\":" + quoted(name) + ",\"pid\":" + std::to_string(processor)
        + ",\"ts\":" + us(now_() - began_ns_) + ",\"args\":{\"value\":" + nlohmann::json(value).dump() + "}}");
}

void Trace::instant(std::string_view name)
{
    const std::lock_guard lock(mutex_);
    const int thread = thread_number();
    add("{\"ph\":\"i\",\"s\":\"t\",\"name\":" + quoted(name) + ",\"pid\":" + std::to_string(processor)
        + ",\"tid\":" + std::to_string(thread) + ",\"ts\":" + us(now_() - began_ns_) + "}");
}

int Trace::thread_number(std::string_view name)
{
    const auto [at, fresh] = threads_.try_emplace(std::this_thread::get_id(), int(threads_.size()) + 1);
    const std::string track = !name.empty() ? std::string(name) : fresh ? "thread " + std::to_string(at->second) : "";
    if (!track.empty())
        add_metadata("thread_name", processor, at->second, track);
    return at->second;
}

void Trace::add_metadata(const char* what, int process, int thread, std::string_view name)
{
    add("{\"ph\":\"M\",\"name\":" + quoted(what) + ",\"pid\":" + std::to_string(process)
        + ",\"tid\":" + std::to_string(thread) + ",\"args\":{\"name\":" + quoted(name) + "}}");
}

void Trace::add_span(std::string_view name, int process, int thread, std::int64_t begin_ns, std::int64_t duration_ns)
{
    add("{\"ph\":\"X\",\"name\":" + quoted(name) + ",\"pid\":" + std::to_string(process)
        + ",\"tid\":" + std::to_string(thread) + ",\"ts\":" + us(begin_ns - began_ns_)
        + ",\"dur\":" + us(std::max<std::int64_t>(duration_ns, 0)) + "}");
}

void Trace::add(const std::string& event)
{
    if (stream_ < 0)
        return;
    constexpr std::int64_t closing = 8; // bytes that close the array
    if (bytes_ + std::int64_t(waiting_.size() + event.size()) + closing > largest_bytes_) {
        close_array();
        write_log(LogKind::trace_ended, file_ + ": is full; the trace ends here, the flight goes on");
        return;
    }
    // The separator comes before each event, so that a file that ends between two events lacks only its bracket.
    if (!waiting_.ends_with("[\n"))
        waiting_ += ",\n";
    waiting_ += event;
    if (waiting_.size() >= most_waiting || now_() - written_ns_ >= longest_wait_ns)
        if (const std::string why = write_out(); !why.empty())
            give_up(why);
}

std::string Trace::write_out()
{
    const char* from = waiting_.data();
    for (std::size_t left = waiting_.size(); left > 0;) {
        const ssize_t took = ::write(stream_, from, left);
        if (took < 0 && errno == EINTR)
            continue;
        if (took <= 0)
            return std::strerror(errno);
        from += took;
        left -= std::size_t(took);
    }
    bytes_ += std::int64_t(waiting_.size());
    waiting_.clear();
    written_ns_ = now_();
    return {};
}

void Trace::close_array()
{
    if (stream_ < 0)
        return;
    waiting_ += "\n]\n";
    if (const std::string why = write_out(); !why.empty())
        return give_up(why);
    close(stream_);
    stream_ = -1;
}

void Trace::give_up(const std::string& why)
{
    (void)!ftruncate(stream_, bytes_); // back to the last whole event
    close(stream_);
    stream_ = -1;
    waiting_.clear();
    write_log(LogKind::trace_ended, file_ + ": can't be written (" + why + "); the trace ends here, the flight goes on");
}

} // namespace starbow
