#pragma once
#include "config/model/log_kinds.h"
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// The program's log: one line a message, on standard error. A line holds the time, the level, the part and the text:
/// "2026-11-22 13:40:01.123 warn exhibit: output 'left' is not shown: ...". The level has a colour on a terminal.
/// Under the journal a line goes to its socket, with the fields MESSAGE ("part: text"), PRIORITY, MESSAGE_ID and
/// STARBOW_LINE, the identifier of its kind. Where the socket does not take it at once, it goes to standard error with
/// sd-daemon(3)'s priority "<4>" instead of time, level and colour.
/// Every function here may be called from any thread.
struct LogOptions {
    LogLevel lowest = LogLevel::info; ///< lower levels are left out
    std::FILE* stream = nullptr; ///< null: standard error. It must stay open until the next open_log
    std::string journal = "/run/systemd/journal/socket"; ///< is used only where the journal reads the stream
};

/// Opens the log anew. Until the first call it is open with LogOptions{}.
void open_log(const LogOptions& options);

/// The text is written as plain_text (config/json/reader.h), so that a message stays one line and a name can't steer the
/// terminal. Nothing here waits for the reader.
void write_log(LogKind kind, std::string_view text);

/// The same for a kind that others than this machine's people can cause, such as by messages of a network: at most
/// most_limited lines of a kind a minute, and the next one says how many were left out.
constexpr int most_limited = 10;
void write_limited(
    LogKind kind, std::string_view text, std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now());

/// The last lines of the log, oldest first, without time and level; at most fifty.
std::vector<std::string> last_lines();

/// True if the journal reads a stream. journal_stream: the environment's JOURNAL_STREAM, "device:inode" of the stream
/// that the service manager connected (systemd.exec(5)), or null.
bool is_journal(const char* journal_stream, std::FILE* stream);

} // namespace starbow
