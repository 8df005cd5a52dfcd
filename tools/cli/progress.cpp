#include "castor/tools/cli/progress.hpp"

#include "castor/tools/cli/progress_line.hpp"

#include <sys/ioctl.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <utility>

namespace castor::cli {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// What is over before that needs no progress.
constexpr auto first_drawn = 300ms;
constexpr auto redrawn = 100ms;

constexpr std::string_view erase_line = "\r\x1b[K";

/// Held by whoever writes to the terminal.
std::recursive_mutex& terminal_mutex() {
  static auto* result = new std::recursive_mutex;
  return *result;
}

/// Where a line of progress stands just now, or -1.
std::atomic<int> drawn_on{-1};

void write_to(int output, std::string_view text) {
  // A terminal that has gone away is noticed by others.
  [[maybe_unused]] auto written = write(output, text.data(), text.size());
}

/// Safe in a signal handler.
void erase() {
  if (int output = drawn_on.exchange(-1); output >= 0)
    write_to(output, erase_line);
}

std::size_t columns_of(int output) {
  winsize size{};
  if (ioctl(output, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return size.ws_col;
  return 80;
}

/// Ctrl-C and the like erase the line before they end the process, for those that nobody else
/// handles or blocks.
class EraseAtSignals {
public:
  EraseAtSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) {
      sigaction(signals[i], nullptr, &before_[i]);
      if (before_[i].sa_handler != SIG_DFL)
        continue;
      struct sigaction action {};
      action.sa_handler = [](int signal) {
        erase();
        // This handler was there only once.
        std::raise(signal);
      };
      action.sa_flags = SA_RESETHAND;
      sigaction(signals[i], &action, nullptr);
    }
  }
  EraseAtSignals(const EraseAtSignals&) = delete;
  EraseAtSignals& operator=(const EraseAtSignals&) = delete;
  ~EraseAtSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i)
      if (before_[i].sa_handler == SIG_DFL)
        sigaction(signals[i], &before_[i], nullptr);
  }

private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT};
  std::array<struct sigaction, signals.size()> before_{};
};

} // namespace

class Progress::Display {
public:
  Display(std::string task, int output, std::atomic<bool>& due)
    : output_(output), due_(due), begin_(Clock::now()) {
    state_.task = std::move(task);
    {
      std::lock_guard terminal{terminal_mutex()};
      outer_ = std::exchange(current, this);
    }
    // Signals are for other threads.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread{[this] { run(); }};
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  ~Display() {
    {
      std::lock_guard guard{mutex_};
      ended_ = true;
    }
    wake_.notify_all();
    thread_.join();
    std::lock_guard terminal{terminal_mutex()};
    erase();
    current = outer_;
  }

  template <class F>
  void change(F&& f) {
    std::lock_guard guard{mutex_};
    f(state_);
    due_.store(false, std::memory_order_relaxed);
  }

private:
  void run() {
    std::unique_lock guard{mutex_};
    auto next = begin_ + first_drawn;
    due_ = true;
    while (!wake_.wait_until(guard, next, [this] { return ended_; })) {
      state_.elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin_);
      auto state = state_;
      due_ = true;
      // Those who pause progress may want to update it at the same time.
      guard.unlock();
      draw(state);
      next = Clock::now() + redrawn;
      guard.lock();
    }
  }

  void draw(const ProgressState& state) {
    std::lock_guard terminal{terminal_mutex()};
    // In the background, the terminal belongs to somebody else.
    if (auto group = tcgetpgrp(output_); current != this || (group >= 0 && group != getpgrp()))
      return;
    // The last column stays free: a cursor behind it is on the next line on some terminals.
    auto line = progress_line(state, columns_of(output_) - 1);
    drawn_on = output_;
    write_to(output_, '\r' + line + "\x1b[K");
  }

  /// The one that is shown; guarded by the mutex of the terminal.
  static Display* current;

  const int output_;
  std::atomic<bool>& due_;
  const Clock::time_point begin_;
  EraseAtSignals erase_at_signals_;
  Display* outer_ = nullptr;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  ProgressState state_;
  std::thread thread_;
};

Progress::Display* Progress::Display::current = nullptr;

Progress::Progress(std::string task, int output) {
  if (is_shown_on(output))
    display_ = std::make_unique<Display>(std::move(task), output, due_);
}

Progress::~Progress() = default;

void Progress::update(double done, std::optional<double> total, std::string text) {
  if (display_)
    display_->change([&](ProgressState& state) {
      state.done = done;
      state.total = total;
      state.text = std::move(text);
    });
}

void Progress::update(std::string text) {
  if (display_)
    display_->change([&](ProgressState& state) { state.text = std::move(text); });
}

bool Progress::is_shown_on(int output) {
  if (isatty(output) == 0)
    return false;
  const auto* terminal = std::getenv("TERM");
  return terminal && *terminal != '\0' && std::string_view{terminal} != "dumb";
}

ProgressPause::ProgressPause() : lock_(terminal_mutex()) {
  erase();
}

} // namespace castor::cli
