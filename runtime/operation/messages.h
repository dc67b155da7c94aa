#pragma once
#include <string>

namespace starbow {

/// The bytes of messages that wait for a stream's reader; beyond them messages are dropped.
inline constexpr std::size_t most_waiting_messages = 256 << 10;

/// Hands a whole message to the thread that writes to a stream. It never waits: where nobody reads the stream, as with a
/// full pipe or a stopped terminal, messages are dropped, and the next one that gets through follows a line with their
/// number. descriptor: of standard output or standard error, or any that stays open until flush_messages has returned. Any
/// thread may call.
void send_message(int descriptor, std::string text);

/// A line on standard output, of a flight: printf would wait for the reader.
void print_message(std::string text);

/// Waits until all messages are written, at most so long, s. Returns false where some are left. The end of the program calls
/// it with a second.
bool flush_messages(double longest_s);

/// Opens /dev/null for each of the three standard streams that is closed, so that no file takes its number and then its
/// messages; and ignores SIGPIPE, so that a reader's end ends nothing. First of all in main.
void guard_streams();

/// A size for people: "3.9 GiB".
std::string size_text(double bytes);

} // namespace starbow
