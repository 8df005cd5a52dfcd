#include "castor/tools/cli/signals.hpp"

#include "castor/actors/runtime/running_components.hpp"
#include "castor/tools/cli/end_requests.hpp"
#include "castor/tools/cli/exits.hpp"
#include "castor/tools/cli/progress.hpp"

#include <poll.h>
#include <semaphore.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace castor::cli {

namespace {

using Clock = EndRequests::Clock;
using Kind = EndRequests::Kind;
using Answer = EndRequests::Answer;
using namespace std::chrono_literals;

/// How often standard input is looked at.
constexpr auto poll_interval = 50ms;
/// Seconds that the end by force may take: what it says may block, as everything else.
constexpr unsigned last_words = 1;

/// Written by signal handlers, which may do no more than that, and post the semaphore. No
/// descriptor: a component may have closed all there are.
struct Received {
  std::atomic<int> interrupts{0};
  std::atomic<int> last_interrupt{0};
  std::atomic<bool> hangup{false};
  std::atomic<bool> broken_output{false};
  std::atomic<bool> listens{false};
  std::atomic<int> moved_output{-1};
  sem_t wake{};
};

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

Received received;

/// Never destroyed: requests may come until the very end of the process.
struct State {
  std::mutex mutex;
  EndRequests requests;
  int status_by_force = 1;
  std::list<std::function<void()>> at_forced_end;
  std::atomic<int> count{0};
  std::atomic<bool> output_ended{false};
};

State& state() {
  static auto* result = new State;
  return *result;
}

bool nobody_reads(int descriptor) {
  pollfd x{descriptor, 0, 0};
  return poll(&x, 1, 0) > 0 && (x.revents & POLLERR) != 0;
}

void on_interrupt(int signal) {
  received.last_interrupt = signal;
  ++received.interrupts;
  sem_post(&received.wake);
}

void on_hangup(int) {
  received.hangup = true;
  sem_post(&received.wake);
}

void on_broken_pipe(int) {
  auto error = errno;
  if (nobody_reads(STDOUT_FILENO) || nobody_reads(STDERR_FILENO) ||
      nobody_reads(received.moved_output)) {
    if (received.listens) {
      received.broken_output = true;
      sem_post(&received.wake);
    } else {
      // Taken when this handler returns.
      std::signal(SIGPIPE, SIG_DFL);
      std::raise(SIGPIPE);
    }
  }
  errno = error;
}

void handle(int signal, void (*f)(int)) {
  struct sigaction action {};
  action.sa_handler = f;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

/// Whether everybody who could write to our standard input is gone.
bool has_input_ended() {
  pollfd x{STDIN_FILENO, POLLIN, 0};
  if (poll(&x, 1, 0) <= 0)
    return false;
  std::array<char, 256> ignored;
  return read(STDIN_FILENO, ignored.data(), ignored.size()) <= 0;
}

std::atomic<int> status_of_alarm{1};

[[noreturn]] void end_by_force(int status) {
  status_of_alarm = status;
  handle(SIGALRM, [](int) { leave_process(status_of_alarm); });
  sigset_t alarm_only;
  sigemptyset(&alarm_only);
  sigaddset(&alarm_only, SIGALRM);
  pthread_sigmask(SIG_UNBLOCK, &alarm_only, nullptr);
  alarm(last_words);
  {
    auto& x = state();
    std::lock_guard guard{x.mutex};
    for (auto& f : x.at_forced_end)
      f();
  }
  std::string text = "castor: ended by force";
  std::string who;
  for (auto& x : components_in_own_code())
    who += (who.empty() ? "" : ", ") + x;
  text += who.empty() ? "\n" : "; still running: " + who + "\n";
  const ProgressPause pause;
  [[maybe_unused]] auto written = write(STDERR_FILENO, text.data(), text.size());
  leave_process(status);
}

/// Turns what handlers have noted into requests.
class SignalWatch {
public:
  SignalWatch(bool end_with_input, pid_t parent)
    : end_with_input_(end_with_input), parent_(parent) {}

  [[noreturn]] void run() {
    for (;;) {
      wait();
      look();
    }
  }

private:
  void wait() const {
    auto until = [&]() -> std::optional<Clock::time_point> {
      std::lock_guard guard{state().mutex};
      auto deadline = state().requests.deadline();
      if (!end_with_input_)
        return deadline;
      auto next = Clock::now() + poll_interval;
      return deadline ? std::min(*deadline, next) : next;
    }();
    if (!until) {
      sem_wait(&received.wake);
      return;
    }
    auto since_epoch = until->time_since_epoch();
    auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_epoch);
    timespec time{};
    time.tv_sec = seconds.count();
    time.tv_nsec = std::chrono::nanoseconds{since_epoch - seconds}.count();
    sem_clockwait(&received.wake, CLOCK_MONOTONIC, &time);
  }

  void look() {
    for (; interrupts_ < received.interrupts; ++interrupts_)
      request(Kind::interrupt);
    if (received.hangup.exchange(false))
      request(Kind::hangup);
    if (received.broken_output.exchange(false))
      end_output();
    if (end_with_input_ && has_input_ended()) {
      end_with_input_ = false;
      request(Kind::input_ended);
    }
    auto answer = [] {
      std::lock_guard guard{state().mutex};
      return state().requests.look(Clock::now());
    }();
    if (answer == Answer::by_force)
      end_by_force(state().status_by_force);
  }

  void end_output() {
    // A process that prints for another one lets that end the system.
    if (parent_ > 0) {
      if (getppid() == parent_)
        kill(parent_, SIGPIPE);
      return;
    }
    state().output_ended = true;
    request(Kind::output_ended);
  }

  void request(Kind kind) {
    auto& x = state();
    std::unique_lock guard{x.mutex};
    auto answer = x.requests.request(kind, Clock::now());
    guard.unlock();
    if (answer == Answer::in_order)
      ++x.count;
    if (answer == Answer::by_force)
      end_by_force(128 + received.last_interrupt);
  }

  bool end_with_input_;
  /// Whose output this process shares; 0 for nobody's.
  pid_t parent_;
  int interrupts_ = 0;
};

} // namespace

Signals::Signals(const Options& options) {
  static bool begun = false;
  if (begun)
    return;
  sem_init(&received.wake, 0, 0);
  state().requests = EndRequests{options.patience};
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    std::thread{[watch = SignalWatch{options.end_with_input,
                                     options.end_with_input ? getppid() : 0}]() mutable {
      watch.run();
    }}.detach();
  } catch (const std::system_error& e) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    throw std::runtime_error(std::string{"cannot create another thread ("} + e.code().message() +
                             "): raise `ulimit -u`, or the limit of the container");
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  begun = true;
  for (int x : {SIGINT, SIGTERM})
    handle(x, on_interrupt);
  // `nohup` has it ignored.
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN)
    handle(SIGHUP, on_hangup);
  received.listens = true;
}

int Signals::count() const {
  return state().count;
}

bool Signals::has_output_ended() const {
  return state().output_ended;
}

void TimeLimit::begin(std::chrono::milliseconds limit, int status_by_force) {
  if (!received.listens)
    return;
  {
    auto& x = state();
    std::lock_guard guard{x.mutex};
    x.status_by_force = status_by_force;
    x.requests.set_limit(Clock::now() + limit);
  }
  sem_post(&received.wake);
}

void TimeLimit::end() {
  auto& x = state();
  std::lock_guard guard{x.mutex};
  x.requests.set_limit({});
}

AtForcedEnd::AtForcedEnd(std::function<void()> f) {
  auto& x = state();
  std::lock_guard guard{x.mutex};
  position_ = x.at_forced_end.insert(x.at_forced_end.end(), std::move(f));
}

AtForcedEnd::~AtForcedEnd() {
  auto& x = state();
  std::lock_guard guard{x.mutex};
  x.at_forced_end.erase(position_);
}

void end_with_output() {
  handle(SIGPIPE, on_broken_pipe);
}

void set_moved_output(int descriptor) {
  received.moved_output = descriptor;
}

} // namespace castor::cli
