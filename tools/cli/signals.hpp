#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <optional>

/// Requests to end this process, and its end by force if threads block.
namespace castor::cli {

/// Requests to end: Ctrl-C, SIGTERM, SIGHUP, an output closed by its reader and, if
/// `end_with_input`, the end of standard input. The first one is only counted (`count`), to be
/// polled. After the second Ctrl-C or SIGTERM a separate thread ends the process at once, whatever
/// other threads do: status 128 + the signal's number. In effect from the first object on until the
/// process ends.
class Signals {
public:
  struct Options {
    bool end_with_input = false;
    /// Time after the first request after which the process ends by force, with status 1; nothing
    /// for never.
    std::optional<std::chrono::milliseconds> patience = {};
  };

  /// Throws std::runtime_error if no further thread can be created.
  Signals() : Signals(Options{}) {}
  explicit Signals(const Options& options);

  /// 0 until the process is asked to end.
  int count() const;

  /// Whether it was asked to end because the reader has closed its output.
  bool has_output_ended() const;
};

/// A time limit from `begin` to `end` or destruction, after which the process ends by force:
/// destructors of components and libraries may block, too. No effect without `Signals`.
class TimeLimit {
public:
  TimeLimit() = default;
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit() { end(); }

  void begin(std::chrono::milliseconds limit, int status_by_force);
  void end();
};

/// Limit for the destruction of a stopped system.
inline constexpr std::chrono::seconds destruction_limit{5};

/// The same, if pending recordings are written meanwhile.
inline constexpr std::chrono::seconds recording_limit{60};

/// A function to call if the process ends by force during the object's lifetime: to kill a child,
/// to restore the terminal. Called by another thread; must not block.
class AtForcedEnd {
public:
  explicit AtForcedEnd(std::function<void()> f);
  AtForcedEnd(const AtForcedEnd&) = delete;
  AtForcedEnd& operator=(const AtForcedEnd&) = delete;
  ~AtForcedEnd();

private:
  std::list<std::function<void()>>::iterator position_;
};

/// A closed standard output or error ends the process, as usual, or is a request to end if there
/// are `Signals`. Other broken pipes are errors of the writing function.
void end_with_output();

/// Sets the descriptor that standard output was temporarily moved to; -1 for none.
void set_moved_output(int descriptor);

} // namespace castor::cli
