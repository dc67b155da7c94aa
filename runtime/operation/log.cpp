#include "log.h"
#include "config/json/reader.h"
#include "local_datagrams.h"
#include "messages.h"
#include <array>
#include <cstdlib>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace starbow {
namespace {

/// spdlog's levels follow each other as the log's do.
constexpr spdlog::level::level_enum spdlog_level(LogLevel level)
{
    return spdlog::level::level_enum(int(spdlog::level::debug) + int(level));
}
constexpr LogLevel level_of(const spdlog::details::log_msg& message)
{
    return LogLevel(int(message.level) - int(spdlog::level::debug));
}
static_assert(spdlog_level(LogLevel::info) == spdlog::level::info);
static_assert(spdlog_level(LogLevel::warning) == spdlog::level::warn);
static_assert(spdlog_level(LogLevel::error) == spdlog::level::err);

/// sd-daemon(3)'s priority of a line: SD_DEBUG 7, SD_INFO 6, SD_WARNING 4, SD_ERR 3.
char priority_of(LogLevel level) { return "7643"[std::size_t(level)]; }

/// Writes "warn" for spdlog's "warning": names of at most five letters align the parts below each other.
class LevelName : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override
    {
        static constexpr std::string_view names[]{"debug", "info", "warn", "error"};
        const std::string_view name = names[std::size_t(level_of(message))];
        out.append(name.begin(), name.end());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LevelName>(); }
};

/// Writes the priority of a line.
class Priority : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override
    {
        out.push_back('<');
        out.push_back(priority_of(level_of(message)));
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
            static constexpr const char* colours[]{"\033[36m", "\033[32m", "\033[33m\033[1m", "\033[31m\033[1m"};
            text.insert(message.color_range_end, "\033[m");
            text.insert(message.color_range_start, colours[std::size_t(level_of(message))]);
        }
        send_message(descriptor_, std::move(text));
    }
    void flush_() override { }

    int descriptor_;
    bool coloured_;
};

/// A line in the journal's own protocol (systemd.io/JOURNAL_NATIVE_PROTOCOL): one field NAME=VALUE a line. line: without
/// line breaks.
std::string journal_entry(const LogRule& rule, const std::string& line)
{
    std::string fields = "MESSAGE=" + line;
    fields.append("\nPRIORITY=").append(1, priority_of(rule.level));
    fields.append("\nSYSLOG_IDENTIFIER=starbow\nMESSAGE_ID=").append(rule.message_id);
    fields.append("\nSTARBOW_LINE=").append(rule.name).append("\n");
    return fields;
}

/// The destinations of the log's lines.
struct LogOutput {
    std::shared_ptr<spdlog::logger> stream;
    std::unique_ptr<LocalDatagrams> journal; ///< null: the journal does not read the stream
};

std::shared_ptr<const LogOutput> make_output(const LogOptions& options)
{
    std::FILE* stream = options.stream ? options.stream : stderr;
    const bool journal = is_journal(std::getenv("JOURNAL_STREAM"), stream);
    auto sink = std::make_shared<MessageSink>(fileno(stream), !journal && isatty(fileno(stream)));
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<LevelName>('*').add_flag<Priority>('&');
    formatter->set_pattern(journal ? "%&%v" : "%Y-%m-%d %H:%M:%S.%e %^%*%$ %v");
    sink->set_formatter(std::move(formatter));
    auto logger = std::make_shared<spdlog::logger>("starbow", std::move(sink));
    logger->set_level(spdlog_level(options.lowest));
    return std::make_shared<LogOutput>(
        LogOutput{std::move(logger), journal ? std::make_unique<LocalDatagrams>(options.journal.c_str()) : nullptr});
}

constexpr std::size_t most_last_lines = 50;

/// The present output. It is never destroyed, because a thread may log while the program ends.
struct Current {
    std::mutex mutex;
    std::deque<std::string> last; ///< lines
    std::shared_ptr<const LogOutput> output = make_output({});
};
Current& current()
{
    static auto& only = *new Current;
    return only;
}

} // namespace

void open_log(const LogOptions& options)
{
    Current& now = current();
    auto made = make_output(options);
    flush_messages(1); // the stream before may be closed on return
    const std::lock_guard lock(now.mutex);
    now.output = std::move(made);
}

void write_log(LogKind kind, std::string_view text)
{
    const LogRule& rule = rule_of(kind);
    Current& now = current();
    std::shared_ptr<const LogOutput> output;
    {
        const std::lock_guard lock(now.mutex);
        output = now.output;
    }
    const auto level = spdlog_level(rule.level);
    if (!output->stream->should_log(level))
        return;
    std::string line;
    line.reserve(rule.part.size() + 2 + text.size());
    line.append(rule.part).append(": ").append(text);
    line = plain_text(std::move(line));
    if (!output->journal || !output->journal->send(journal_entry(rule, line)))
        output->stream->log(level, spdlog::string_view_t(line.data(), line.size()));
    const std::lock_guard lock(now.mutex);
    now.last.push_back(std::move(line));
    if (now.last.size() > most_last_lines)
        now.last.pop_front();
}

void write_limited(LogKind kind, std::string_view text, std::chrono::steady_clock::time_point now)
{
    struct Limit {
        std::optional<std::chrono::steady_clock::time_point> began; ///< its minute
        int written = 0;
        long left_out = 0;
    };
    static std::mutex& mutex = *new std::mutex;
    static auto& limits = *new std::array<Limit, log_rules.size()>;
    long left_out = 0;
    {
        const std::lock_guard lock(mutex);
        Limit& limit = limits[std::size_t(kind)];
        if (!limit.began || now < *limit.began || now - *limit.began >= std::chrono::minutes(1))
            limit.began = now, limit.written = 0;
        if (limit.written == most_limited) {
            ++limit.left_out;
            return;
        }
        ++limit.written;
        left_out = std::exchange(limit.left_out, 0);
    }
    if (left_out == 0)
        return write_log(kind, text);
    write_log(kind, std::string(text) + " (" + std::to_string(left_out) + " such lines before are left out)");
}

std::vector<std::string> last_lines()
{
    Current& now = current();
    const std::lock_guard lock(now.mutex);
    return {now.last.begin(), now.last.end()};
}

bool is_journal(const char* journal_stream, std::FILE* stream)
{
    unsigned long long device = 0, inode = 0;
    struct stat found { };
    return journal_stream && std::sscanf(journal_stream, "%llu:%llu", &device, &inode) == 2
        && fstat(fileno(stream), &found) == 0 && found.st_dev == device && found.st_ino == inode;
}

} // namespace starbow
