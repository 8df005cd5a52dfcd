#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

/// One log for the whole process, on standard error: time, level, who, what.
namespace castor {

enum class LogLevel : std::uint8_t { trace, debug, info, warning, error, off };

/// Minimum level of log lines. A component may set a lower level for itself; with `off`, nothing is
/// logged at all.
void set_log_level(LogLevel level);
LogLevel log_level();

/// Logs regardless of the level.
void log(LogLevel level, std::string_view who, std::string_view what);

/// Logs a message of the runtime, about `who` or about itself, unless it is below the level.
void log_runtime(LogLevel level, std::string_view who, std::string_view what);
void log_runtime(LogLevel level, std::string_view what);

/// Logs a message that others (such as connecting clients) can cause without limit: of messages
/// that differ in their digits only, a few are written every ten seconds, and the others are
/// counted.
void log_repeated(LogLevel level, std::string_view what);

/// Writes the counts whose ten seconds are over; to be called regularly.
void write_repeated();

/// Sets a factory whose object is created before each log line and destroyed after it, for instance
/// to hide a progress line meanwhile. To be called before any thread logs.
void guard_log_lines(std::shared_ptr<void> (*make)());

/// Flushes the buffer; needed before a process exits without running destructors.
void flush_log();

} // namespace castor
