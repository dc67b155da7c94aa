#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <thread>

namespace starbow {

/// Writes the times of the program's work in Chrome's trace event format, which ui.perfetto.dev and chrome://tracing
/// show. The file is a JSON array of one event a line. It grows during the flight. If the program dies, the array lacks
/// its last bracket, which both viewers accept; the events of the last quarter of a second may be missing. Every function
/// may be called from any thread. Times are nanoseconds of the steady clock (CLOCK_MONOTONIC on Linux).
class Trace {
public:
    /// Replaces the file; makes its folder. Throws InputError where it can't be written. largest_bytes: the trace ends
    /// before the file grows beyond this, and the log reports it. now: the clock that says when events are written out, and
    /// when counters and instants are; a test turns one of its own.
    explicit Trace(const std::filesystem::path& file, std::int64_t largest_bytes = std::int64_t(1) << 30,
        std::int64_t (*now)() = now_ns);
    /// Closes the array.
    ~Trace();
    Trace(const Trace&) = delete;

    static std::int64_t now_ns();

    /// Names the calling thread's track. A thread without a name is "thread 2", "thread 3", ...
    void name_thread(std::string_view name);

    /// Work on the processor, on the calling thread's track. Spans of one thread must nest.
    void cpu(std::string_view name, std::int64_t begin_ns, std::int64_t duration_ns);
    /// Work on the GPU, on a track of its own. The caller translates GPU time into the steady clock's.
    void gpu(std::string_view name, std::int64_t begin_ns, std::int64_t duration_ns);
    /// A number over time, drawn as a curve. A value that is not finite is left out.
    void counter(std::string_view name, double value);
    /// A moment on the calling thread's track.
    void instant(std::string_view name);

    /// The calling thread's work from here to the end of the scope. trace may be null: then no event is written and no
    /// clock is read. name must outlive the span.
    class Span {
    public:
        Span(Trace* trace, const char* name)
            : trace_(trace)
            , name_(name)
            , begin_ns_(trace ? now_ns() : 0)
        {
        }
        ~Span()
        {
            try {
                if (trace_)
                    trace_->cpu(name_, begin_ns_, now_ns() - begin_ns_);
            } catch (const std::bad_alloc&) { // the trace lacks this span
            }
        }
        Span(const Span&) = delete;

    private:
        Trace* trace_;
        const char* name_;
        std::int64_t begin_ns_;
    };

private:
    // mutex_ is held where these are called.
    int thread_number(std::string_view name = {}); ///< number of the calling thread; names its track if a name is given
    void add_metadata(const char* what, int process, int thread, std::string_view name);
    void add_span(std::string_view name, int process, int thread, std::int64_t begin_ns, std::int64_t duration_ns);
    void add(const std::string& event); ///< one JSON object
    std::string write_out(); ///< returns the reason of a failure, or ""
    void close_array();
    void give_up(const std::string& why);

    std::mutex mutex_;
    std::string file_;
    std::int64_t (*const now_)();
    int stream_ = -1; ///< below 0: the trace has ended
    std::int64_t began_ns_, written_ns_, largest_bytes_, bytes_ = 0;
    std::string waiting_; ///< whole events that are not in the file yet
    std::map<std::thread::id, int> threads_;
};

} // namespace starbow
