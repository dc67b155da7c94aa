#pragma once
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// The program's log: one line a message, on standard error. A line holds the time, the level, the part and the text:
/// "2026-11-22 13:40:01.123 warn exhibit: output 'left' is not shown: ...". The level has a colour on a terminal.
/// Under the journal a line has sd-daemon(3)'s priority "<4>" instead of time, level and colour.
/// Every function here may be called from any thread.
enum class LogLevel { debug, info, warning, error };

struct LogOptions {
    LogLevel lowest = LogLevel::info; ///< lower levels are left out
    std::FILE* stream = nullptr; ///< null: standard error. It must stay open until the next open_log
};

/// Opens the log anew. Until the first call it is open with LogOptions{}.
void open_log(const LogOptions& options);

/// part: the part of the program that speaks, one word. The text is written as plain_text (config/json/reader.h), so that a
/// message stays one line and a name can't steer the terminal. Nothing here waits for the stream's reader (messages.h).
/// The last lines of the log, oldest first, without time and level; at most fifty.
std::vector<std::string> last_lines();

void log_debug(std::string_view part, std::string_view text);
void log_info(std::string_view part, std::string_view text);
void log_warning(std::string_view part, std::string_view text);
void log_error(std::string_view part, std::string_view text);

/// A function that logs its argument at level info, for the rooms below, which take a callback.
std::function<void(const std::string&)> info_log(std::string part);

/// True if the journal reads a stream. journal_stream: the environment's JOURNAL_STREAM, "device:inode" of the stream
/// that the service manager connected (systemd.exec(5)), or null.
bool is_journal(const char* journal_stream, std::FILE* stream);

} // namespace starbow
