// exit() and its like, as all libraries that this executable loads find them: a component that ends
// the process is named, and the status says that something was wrong.
#include "castor/tools/cli/exits.hpp"

#include "castor/actors/runtime/crash_report.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>

namespace {

using Exit = void (*)(int);

/// That of the C library.
[[noreturn]] void call_real(const char* name, int status) {
  if (auto real = reinterpret_cast<Exit>(dlsym(RTLD_NEXT, name)))
    real(status);
  std::abort();
}

/// Looked up before it is needed, which may be in a signal handler.
const auto real_exit_at_once = reinterpret_cast<Exit>(dlsym(RTLD_NEXT, "_exit"));

[[noreturn]] void end_process(const char* name, int status) {
  // Handlers of exit() and destructors of globals would run while all other threads go on.
  if (castor::report_exit(name, status))
    castor::cli::leave_process(status == 0 ? 1 : status);
  call_real(name, status);
}

} // namespace

namespace castor::cli {

void leave_process(int status) {
  if (real_exit_at_once)
    real_exit_at_once(status);
  std::abort();
}

} // namespace castor::cli

extern "C" {

void exit(int status) noexcept {
  end_process("exit", status);
}

void quick_exit(int status) noexcept {
  end_process("quick_exit", status);
}

void _exit(int status) {
  end_process("_exit", status);
}

void _Exit(int status) noexcept {
  end_process("_Exit", status);
}
}
