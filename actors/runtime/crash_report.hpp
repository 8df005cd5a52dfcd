#pragma once

#include "castor/actors/runtime/code_activity.hpp"

#include <cstddef>
#include <memory>
#include <string>

/// A message that names the component that was running when a signal such as SIGSEGV ends the
/// process. Reports are written by a signal handler, so their text is prepared beforehand.
namespace castor {

/// Installs the handlers: for SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT, as far as nobody else
/// handles them, and for std::terminate. After its report the process ends as it would have
/// without: with the same status, and a core dump if there is to be one. Does nothing under
/// sanitizers, which have handlers of their own.
void report_crashes();

/// Reports a call of exit() or the like by a component, or by a thread that it may have started;
/// `call` is the function's name. False, without a report, if the main thread made the call, or a
/// process that was forked. To be called by a replacement of the function.
bool report_exit(const char* call, int status);

/// Data on a component for its crash report. Written by the component's own thread; read by a
/// signal handler on the same thread.
class CrashNote {
public:
  explicit CrashNote(const CurrentActivity& activity) : activity_(activity) {}
  CrashNote(const CrashNote&) = delete;
  CrashNote& operator=(const CrashNote&) = delete;

  /// @param where its line in the `.cast` file; may be empty
  void describe(const std::string& component, const std::string& class_name,
                const std::string& where, bool isolated);

  const char* component() const { return component_; }
  const CodeActivity& activity() const { return activity_.own(); }
  bool is_isolated() const { return is_isolated_; }

private:
  static constexpr std::size_t longest = 300;

  /// "a.shaky (class Shaky, system.cast:5)", ends with a zero.
  char component_[longest] = {};
  bool is_isolated_ = false;
  const CurrentActivity& activity_;
};

/// While it lives, crashes of the calling thread are attributed to the component. Gives the thread
/// a stack for signal handlers, so that the overflow of its own can be reported.
class CrashWatch {
public:
  explicit CrashWatch(const CrashNote& note);
  /// For a thread that runs components in turn; `attribute` says which one.
  CrashWatch();
  CrashWatch(const CrashWatch&) = delete;
  CrashWatch& operator=(const CrashWatch&) = delete;
  ~CrashWatch();

  /// Attributes crashes of the calling thread to the component from now on; null for none. The note
  /// has to outlive that.
  static void attribute(const CrashNote* note);

private:
  std::unique_ptr<char[]> stack_;
};

} // namespace castor
