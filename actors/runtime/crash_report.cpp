#include "castor/actors/runtime/crash_report.hpp"

#include "castor/base/plain_words.hpp"

#include <cxxabi.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <typeinfo>

namespace castor {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitizers_report = true;
#else
constexpr bool sanitizers_report = false;
#endif

/// What a handler knows of the thread that it interrupts.
struct ThreadNote {
  /// Null if no component runs there.
  const CrashNote* component = nullptr;
  /// Just below the stack, where an overflow ends; both 0 if not known.
  std::uintptr_t guard_begin = 0;
  std::uintptr_t guard_end = 0;
};

/// Present in every thread from its beginning: a handler cannot allocate it.
[[gnu::tls_model("initial-exec")]] thread_local ThreadNote this_thread;

std::atomic<bool> installed{false};

/// In one that was forked nobody is to be told.
std::atomic<pid_t> reporting_process{-1};

/// Of an exception that nobody has caught; empty if the process was aborted for another reason.
std::array<char, 400> uncaught{};
std::atomic<bool> has_uncaught{false};

// -- what is safe in a signal handler

/// A text of limited length, on the stack.
class SafeText {
public:
  SafeText& operator<<(std::string_view x) {
    // What comes from a file must not write escape sequences.
    for (char c : x)
      if (size_ < text_.size())
        text_[size_++] = static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
    return *this;
  }

  SafeText& operator<<(std::uintptr_t x) {
    std::array<char, 20> digits{};
    auto begin = digits.size();
    do {
      digits[--begin] = static_cast<char>('0' + x % 10);
      x /= 10;
    } while (x > 0);
    return *this << std::string_view{digits.data() + begin, digits.size() - begin};
  }

  SafeText& hexadecimal(std::uintptr_t x) {
    std::array<char, 16> digits{};
    auto begin = digits.size();
    do {
      digits[--begin] = "0123456789abcdef"[x % 16];
      x /= 16;
    } while (x > 0);
    return *this << "0x" << std::string_view{digits.data() + begin, digits.size() - begin};
  }

  void print() const {
    for (std::size_t done = 0; done < size_;) {
      auto n = write(STDERR_FILENO, text_.data() + done, size_ - done);
      if (n < 0 && errno == EINTR)
        continue;
      if (n <= 0)
        return;
      done += static_cast<std::size_t>(n);
    }
  }

private:
  std::array<char, 2000> text_{};
  std::size_t size_ = 0;
};

constexpr std::string_view isolation_remedy =
  "castor: This ends the process with all its components. With --isolate on its line in the .cast "
  "file, the component has a process of its own, and the others go on.\n";

std::string_view name_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault (SIGSEGV)";
    case SIGBUS:
      return "bus error (SIGBUS)";
    case SIGFPE:
      return "arithmetic error (SIGFPE)";
    case SIGILL:
      return "illegal instruction (SIGILL)";
    default:
      return "abort (SIGABRT)";
  }
}

/// Accesses beside null are those of members of what is not there.
constexpr std::uintptr_t near_null = 4096;

void add_cause(SafeText& text, int signal, const siginfo_t& info) {
  text << name_of(signal);
  if (info.si_code == SI_USER) {
    text << ", sent by process " << static_cast<std::uintptr_t>(info.si_pid) << ",";
  } else if (signal == SIGABRT) {
    if (has_uncaught)
      text << ", " << std::string_view{uncaught.data()} << ",";
  } else if (signal == SIGSEGV || signal == SIGBUS) {
    auto address = reinterpret_cast<std::uintptr_t>(info.si_addr);
    if (address >= this_thread.guard_begin && address < this_thread.guard_end)
      text << ", stack overflow,";
    else if (address < near_null)
      text << ", null pointer (address ", text.hexadecimal(address) << "),";
    else
      text << ", address ", text.hexadecimal(address) << ",";
  } else if (signal == SIGFPE && info.si_code == FPE_INTDIV) {
    text << ", division by zero,";
  }
}

void add_place(SafeText& text) {
  if (const auto* component = this_thread.component) {
    text << " in component " << component->component();
    if (auto& activity = component->activity(); !activity.what.empty()) {
      text << ", in ";
      activity.for_each_part([&](std::string_view part) { text << part; });
    }
    return;
  }
  std::array<char, 17> name{};
  prctl(PR_GET_NAME, name.data());
  if (gettid() == getpid())
    text << " in the main thread, which runs no component";
  else
    text << " in the thread '" << std::string_view{name.data()}
         << "', which is not that of a component: a component or a library has started it, or the "
            "runtime has";
}

void report(int signal, siginfo_t* info, void*) {
  auto error = errno;
  SafeText text;
  text << "castor: ";
  add_cause(text, signal, *info);
  add_place(text);
  text << "\n";
  const auto* component = this_thread.component;
  if (info->si_code != SI_USER && component && !component->is_isolated())
    text << isolation_remedy;
  text.print();
  errno = error;
  // The default action was restored when the handler was called: what has faulted faults again, and
  // what was sent is sent again.
  if (info->si_code <= 0)
    raise(signal);
}

// -- what prepares it

std::size_t handler_stack_size() {
  constexpr long least = 64 * 1024;
  return static_cast<std::size_t>(std::max(least, sysconf(_SC_SIGSTKSZ)));
}

void set_handler_stack(char* stack, std::size_t size) {
  stack_t x{};
  x.ss_sp = stack;
  x.ss_size = size;
  x.ss_flags = stack ? 0 : SS_DISABLE;
  sigaltstack(&x, nullptr);
}

/// Where an overflow of the calling thread's stack ends.
void find_guard(ThreadNote& thread) {
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0)
    return;
  void* stack = nullptr;
  std::size_t size = 0;
  std::size_t guard = 0;
  pthread_attr_getstack(&attributes, &stack, &size);
  pthread_attr_getguardsize(&attributes, &guard);
  pthread_attr_destroy(&attributes);
  // glibc counts the guard as part of the stack, or not, depending on its version.
  auto begin = reinterpret_cast<std::uintptr_t>(stack);
  thread.guard_begin = begin - guard;
  thread.guard_end = begin + guard;
}

/// Keeps what was thrown for the report of the SIGABRT that follows.
[[noreturn]] void terminate() {
  static std::atomic<bool> entered{false};
  if (!entered.exchange(true)) {
    std::string text = "std::terminate was called";
    if (auto* type = abi::__cxa_current_exception_type()) {
      int status = 0;
      std::unique_ptr<char, decltype(&std::free)> name{
        abi::__cxa_demangle(type->name(), nullptr, nullptr, &status), std::free};
      text = std::string{"uncaught exception "} + (name ? name.get() : type->name());
      try {
        throw;
      } catch (const std::exception& e) {
        text += ": " + plain_words(e);
      } catch (...) {
        // It says no more than its type.
      }
    }
    text.copy(uncaught.data(), uncaught.size() - 1);
    has_uncaught = true;
  }
  std::abort();
}

} // namespace

void report_crashes() {
  reporting_process = getpid();
  if (sanitizers_report || installed.exchange(true))
    return;
  std::set_terminate(terminate);
  static const auto stack = std::make_unique<char[]>(handler_stack_size());
  set_handler_stack(stack.get(), handler_stack_size());
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_DFL)
      continue;
    struct sigaction action {};
    action.sa_sigaction = report;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

bool report_exit(const char* call, int status) {
  const auto* component = this_thread.component;
  if (getpid() != reporting_process || (!component && gettid() == getpid()))
    return false;
  SafeText text;
  text << "castor: " << call << "(" << (status < 0 ? "-" : "")
       << static_cast<std::uintptr_t>(std::abs(status)) << ") was called";
  add_place(text);
  text << "\n";
  if (component && !component->is_isolated())
    text << isolation_remedy;
  text.print();
  return true;
}

void CrashNote::describe(const std::string& component, const std::string& class_name,
                         const std::string& where, bool isolated) {
  auto text = component + " (class " + class_name + (where.empty() ? "" : ", " + where) + ")";
  component_[text.copy(component_, longest - 1)] = '\0';
  is_isolated_ = isolated;
}

CrashWatch::CrashWatch(const CrashNote& note) : CrashWatch() {
  attribute(&note);
}

void CrashWatch::attribute(const CrashNote* note) {
  this_thread.component = note;
}

CrashWatch::CrashWatch() {
  if (!installed)
    return;
  stack_ = std::make_unique<char[]>(handler_stack_size());
  set_handler_stack(stack_.get(), handler_stack_size());
  find_guard(this_thread);
}

CrashWatch::~CrashWatch() {
  this_thread = {};
  if (!stack_)
    return;
  set_handler_stack(nullptr, 0);
}

} // namespace castor
