#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

/// One log for the whole process, on standard error: time, level, who, what.
namespace castor {

enum class LogLevel : std::uint8_t { trace, debug, info, warning, error, off };

/// Below this nothing is logged, unless a component asks for more of its own; if it is off, nothing
/// at all.
void set_log_level(LogLevel level);
LogLevel log_level();

/// Logs it whatever the level is.
void log(LogLevel level, std::string_view who, std::string_view what);

/// Logs what the runtime itself has to say of somebody, or of itself, unless that is below the
/// level.
void log_runtime(LogLevel level, std::string_view who, std::string_view what);
void log_runtime(LogLevel level, std::string_view what);

/// Logs what others cause, and could cause at will, such as those who connect: of messages that
/// differ in their digits only, a few are written every ten seconds, and the others are counted.
void note_repeated(LogLevel level, std::string_view what);

/// Writes what was counted, where it is time; to be called now and then.
void write_repeated();

/// What is made before each line and destroyed after it, such as something that keeps a line of
/// progress off the terminal meanwhile. Before any thread logs.
void guard_log_lines(std::shared_ptr<void> (*make)());

/// Writes out what is still buffered; before a process leaves without its destructors.
void flush_log();

} // namespace castor
