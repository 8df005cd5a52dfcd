#include "castor/base/log.hpp"

#include "castor/base/repeated_messages.hpp"
#include "castor/base/text.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>

namespace castor {

namespace {

std::atomic<LogLevel> threshold{LogLevel::info};

std::shared_ptr<void> (*make_guard)() = nullptr;

/// Never destroyed: components may log until the very end of the process.
spdlog::logger& logger() {
  static auto* result = [] {
    auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    auto* created = new spdlog::logger("castor", std::move(sink));
    created->set_level(spdlog::level::trace);
    created->set_pattern("%H:%M:%S.%e %^%-7l%$ %v");
    return created;
  }();
  return *result;
}

spdlog::level::level_enum to_spdlog(LogLevel x) {
  switch (x) {
    case LogLevel::trace:
      return spdlog::level::trace;
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::off:
      return spdlog::level::off;
  }
  return spdlog::level::info;
}

/// What begins the further lines of a message, so that none of them looks like a message.
constexpr std::string_view continuation = "\n    ";

/// Text of components and of other processes, which may be anything: it can neither drive the
/// terminal nor pass for further messages.
std::string as_logged(std::string_view text) {
  std::string result;
  for (auto rest = text;;) {
    auto end = rest.find('\n');
    result += printable(rest.substr(0, end));
    if (end == rest.npos || rest.substr(end + 1).empty())
      return result;
    result += continuation;
    rest.remove_prefix(end + 1);
  }
}

} // namespace

void set_log_level(LogLevel level) {
  threshold = level;
}

LogLevel log_level() {
  return threshold;
}

void log(LogLevel level, std::string_view who, std::string_view what) {
  if (log_level() == LogLevel::off)
    return;
  auto guard = make_guard ? make_guard() : nullptr;
  logger().log(to_spdlog(level), "[{}] {}", printable(who), as_logged(what));
}

void log_runtime(LogLevel level, std::string_view who, std::string_view what) {
  if (level >= log_level())
    log(level, who, what);
}

void log_runtime(LogLevel level, std::string_view what) {
  log_runtime(level, "castor", what);
}

namespace {

/// By level.
struct Repeated {
  std::mutex mutex;
  std::map<LogLevel, RepeatedMessages> messages;
};

/// Never destroyed, as the logger.
Repeated& repeated() {
  static auto* result = new Repeated;
  return *result;
}

} // namespace

void log_repeated(LogLevel level, std::string_view what) {
  if (level < log_level())
    return;
  auto& all = repeated();
  std::unique_lock guard{all.mutex};
  auto text = all.messages[level].add(what, std::chrono::steady_clock::now());
  guard.unlock();
  if (text)
    log_runtime(level, *text);
}

void write_repeated() {
  auto now = std::chrono::steady_clock::now();
  auto& all = repeated();
  std::lock_guard guard{all.mutex};
  for (auto& [level, messages] : all.messages)
    for (auto& text : messages.take_due(now))
      log_runtime(level, text);
}

void guard_log_lines(std::shared_ptr<void> (*make)()) {
  make_guard = make;
}

void flush_log() {
  {
    auto& all = repeated();
    // Whoever holds it may never go on.
    std::unique_lock guard{all.mutex, std::try_to_lock};
    if (guard)
      for (auto& [level, messages] : all.messages)
        for (auto& text : messages.take_all())
          log_runtime(level, text);
  }
  logger().flush();
}

} // namespace castor
