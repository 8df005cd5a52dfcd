#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <optional>

/// How this process is asked to end, and how it ends when some of its threads do not.
namespace castor::cli {

/// Requests to end: Ctrl-C, SIGTERM, SIGHUP, an output that nobody reads any more and, if wanted,
/// the end of standard input. The first one is a question to be asked instead of an interruption.
/// After the second Ctrl-C or SIGTERM a thread of its own ends the process at once, whatever all
/// others do: status 128 + the signal's number. From the first object on, until the process ends.
class Signals {
public:
  struct Options {
    bool end_with_input = false;
    /// So long after the first request the process ends by force, with status 1; nothing for never.
    std::optional<std::chrono::milliseconds> patience = {};
  };

  /// Throws std::runtime_error if there may be no further thread.
  Signals() : Signals(Options{}) {}
  explicit Signals(const Options& options);

  /// 0 until the process is asked to end.
  int count() const;

  /// Whether it was asked to end because nobody reads its output.
  bool has_output_ended() const;
};

/// From `begin` to the end of its life, what a process does has a time limit: destructors of
/// components and libraries may block, too. Beyond that, the process ends by force. Does nothing
/// without `Signals`.
class TimeLimit {
public:
  TimeLimit() = default;
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit() { end(); }

  void begin(std::chrono::milliseconds limit, int status_by_force);
  void end();
};

/// For what is left to do when a system has stopped.
inline constexpr std::chrono::seconds destruction_limit{5};

/// The same, if what was recorded and still waits to be written is written then.
inline constexpr std::chrono::seconds recording_limit{60};

/// Something to be done if the process ends by force, for as long as the object lives: kill a
/// child, restore the terminal. Called by another thread; must not wait for anything.
class AtForcedEnd {
public:
  explicit AtForcedEnd(std::function<void()> f);
  AtForcedEnd(const AtForcedEnd&) = delete;
  AtForcedEnd& operator=(const AtForcedEnd&) = delete;
  ~AtForcedEnd();

private:
  std::list<std::function<void()>>::iterator position_;
};

/// A standard output or error that nobody reads is the end of a short command, as usual, and a
/// request to end where there are `Signals`. Other broken pipes are errors of whoever writes.
void end_with_output();

/// The descriptor that standard output has been moved to meanwhile; -1 for none.
void set_moved_output(int descriptor);

} // namespace castor::cli
