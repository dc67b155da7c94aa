#include "log.h"
#include "config/json/reader.h"
#include "messages.h"
#include <cstdlib>
#include <deque>
#include <memory>
#include <mutex>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <sys/stat.h>
#include <unistd.h>

namespace starbow {
namespace {

/// Writes "warn" for spdlog's "warning": names of at most five letters align the parts below each other.
class LevelName : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override
    {
        const char* name = message.level == spdlog::level::debug ? "debug"
            : message.level == spdlog::level::info               ? "info"
            : message.level == spdlog::level::warn               ? "warn"
                                                                 : "error";
        out.append(name, name + std::char_traits<char>::length(name));
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LevelName>(); }
};

/// Writes sd-daemon(3)'s priority of a line: SD_DEBUG 7, SD_INFO 6, SD_WARNING 4, SD_ERR 3.
class Priority : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override
    {
        out.push_back('<');
        out.push_back(message.level == spdlog::level::debug ? '7'
                : message.level == spdlog::level::info      ? '6'
                : message.level == spdlog::level::warn      ? '4'
                                                            : '3');
        out.push_back('>');
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<Priority>(); }
};

/// Hands the lines to the thread that writes messages.
class MessageSink : public spdlog::sinks::base_sink<std::mutex> {
public:
    MessageSink(int descriptor, bool coloured)
        : descriptor_(descriptor)
        , coloured_(coloured)
    {
    }

private:
    void sink_it_(const spdlog::details::log_msg& message) override
    {
        spdlog::memory_buf_t line;
        formatter_->format(message, line);
        std::string text(line.data(), line.size());
        if (coloured_ && message.color_range_end > message.color_range_start) {
            // ECMA-48, SGR: cyan, green, bold yellow, bold red.
            const char* colour = message.level == spdlog::level::debug ? "\033[36m"
                : message.level == spdlog::level::info                 ? "\033[32m"
                : message.level == spdlog::level::warn                 ? "\033[33m\033[1m"
                                                                       : "\033[31m\033[1m";
            text.insert(message.color_range_end, "\033[m");
            text.insert(message.color_range_start, colour);
        }
        send_message(descriptor_, std::move(text));
    }
    void flush_() override { }

    int descriptor_;
    bool coloured_;
};

std::shared_ptr<spdlog::logger> make_logger(const LogOptions& options)
{
    std::FILE* stream = options.stream ? options.stream : stderr;
    const bool journal = is_journal(std::getenv("JOURNAL_STREAM"), stream);
    auto sink = std::make_shared<MessageSink>(fileno(stream), !journal && isatty(fileno(stream)));
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<LevelName>('*').add_flag<Priority>('&');
    formatter->set_pattern(journal ? "%&%v" : "%Y-%m-%d %H:%M:%S.%e %^%*%$ %v");
    sink->set_formatter(std::move(formatter));
    auto logger = std::make_shared<spdlog::logger>("starbow", std::move(sink));
    logger->set_level(options.lowest == LogLevel::debug ? spdlog::level::debug
            : options.lowest == LogLevel::info          ? spdlog::level::info
            : options.lowest == LogLevel::warning       ? spdlog::level::warn
                                                        : spdlog::level::err);
    return logger;
}

constexpr std::size_t most_last_lines = 50;

/// The present logger. It is never destroyed, because a thread may log while the program ends.
struct Current {
    std::mutex mutex;
    std::deque<std::string> last; ///< lines
    std::shared_ptr<spdlog::logger> logger = make_logger({});
};
Current& current()
{
    static auto& only = *new Current;
    return only;
}

std::shared_ptr<spdlog::logger> logger()
{
    Current& now = current();
    const std::lock_guard lock(now.mutex);
    return now.logger;
}

void log(spdlog::level::level_enum level, std::string_view part, std::string_view text)
{
    const auto to = logger();
    if (!to->should_log(level))
        return;
    std::string line;
    line.reserve(part.size() + 2 + text.size());
    line.append(part).append(": ").append(text);
    line = plain_text(std::move(line));
    to->log(level, spdlog::string_view_t(line.data(), line.size()));
    Current& now = current();
    const std::lock_guard lock(now.mutex);
    now.last.push_back(std::move(line));
    if (now.last.size() > most_last_lines)
        now.last.pop_front();
}

} // namespace

void open_log(const LogOptions& options)
{
    Current& now = current();
    auto made = make_logger(options);
    flush_messages(1); // the stream before may be closed on return
    const std::lock_guard lock(now.mutex);
    now.logger = std::move(made);
}

std::vector<std::string> last_lines()
{
    Current& now = current();
    const std::lock_guard lock(now.mutex);
    return {now.last.begin(), now.last.end()};
}

void log_debug(std::string_view part, std::string_view text) { log(spdlog::level::debug, part, text); }
void log_info(std::string_view part, std::string_view text) { log(spdlog::level::info, part, text); }
void log_warning(std::string_view part, std::string_view text) { log(spdlog::level::warn, part, text); }
void log_error(std::string_view part, std::string_view text) { log(spdlog::level::err, part, text); }

std::function<void(const std::string&)> info_log(std::string part)
{
    return [part = std::move(part)](const std::string& text) { log_info(part, text); };
}

bool is_journal(const char* journal_stream, std::FILE* stream)
{
    unsigned long long device = 0, inode = 0;
    struct stat found { };
    return journal_stream && std::sscanf(journal_stream, "%llu:%llu", &device, &inode) == 2
        && fstat(fileno(stream), &found) == 0 && found.st_dev == device && found.st_ino == inode;
}

} // namespace starbow
