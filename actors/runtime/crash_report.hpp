#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

/// A message that names the component that was running when a signal such as SIGSEGV ends the
/// process. Reports are written by a signal handler, so all that they say is prepared beforehand.
namespace castor {

/// Installs the handlers: for SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT, as far as nobody else
/// handles them, and for std::terminate. After its report the process ends as it would have
/// without: with the same status, and a core dump if there is to be one. Does nothing under
/// sanitizers, which have handlers of their own.
void report_crashes();

/// Says who ends the process, if a component does so with exit() or the like, or a thread that it
/// may have started; `call` is the function's name. False if it is not such a call: it was made by
/// the main thread, or in a process that was forked. To be called instead of the function itself,
/// which says nothing.
bool report_exit(const char* call, int status);

/// What is known of a component when it crashes. Written by the component's own thread; read by a
/// signal handler on the same thread.
class CrashNote {
public:
  CrashNote() = default;
  CrashNote(const CrashNote&) = delete;
  CrashNote& operator=(const CrashNote&) = delete;

  /// @param where its line in the `.cast` file; may be empty
  void describe(const std::string& component, const std::string& class_name,
                const std::string& where, bool isolated);

  /// What its own code was called for. The text must stay as it is until the next call.
  void set_doing(std::string_view what) {
    doing_size_ = 0;
    doing_ = what.data();
    doing_size_ = what.size();
  }

  const char* component() const { return component_; }
  std::string_view doing() const { return {doing_, doing_size_}; }
  bool is_isolated() const { return is_isolated_; }

private:
  static constexpr std::size_t longest = 300;

  /// "a.shaky (class Shaky, system.cast:5)", ends with a zero.
  char component_[longest] = {};
  bool is_isolated_ = false;
  // In this order for a handler that comes in between.
  const char* volatile doing_ = nullptr;
  volatile std::size_t doing_size_ = 0;
};

/// While it lives, crashes of the calling thread are those of the component. Gives the thread a
/// stack for signal handlers, so that the overflow of its own can be reported.
class CrashWatch {
public:
  explicit CrashWatch(const CrashNote& note);
  CrashWatch(const CrashWatch&) = delete;
  CrashWatch& operator=(const CrashWatch&) = delete;
  ~CrashWatch();

private:
  std::unique_ptr<char[]> stack_;
};

} // namespace castor
