#include "castor/actors/component/registry.hpp"
#include "castor/mapping/body/components/drives.hpp"
#include "castor/mapping/body/key_steering.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string_view>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// The terminal without echo, and with each key as it is pressed. The destructor restores it.
class TerminalKeys {
public:
  TerminalKeys() {
    // A process in the background would be stopped by changing the terminal.
    if (isatty(STDIN_FILENO) == 0 || tcgetpgrp(STDIN_FILENO) != getpgrp())
      return;
    termios mode{};
    if (tcgetattr(STDIN_FILENO, &mode) != 0)
      return;
    before_ = mode;
    mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(STDIN_FILENO, TCSANOW, &mode);
  }
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;
  ~TerminalKeys() {
    if (before_)
      tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
  }

private:
  std::optional<termios> before_;
};

/// Drives a robot by the keys that are typed, or by characters that are piped in.
class KeyDriver final : public Drives {
  void run() override {
    take_seat();
    std::puts("Drive with w a s d or the arrows; the space bar stops, q ends.");
    std::fflush(stdout);
    TerminalKeys keys;
    KeySteering steering({.forward_step = forward_step_, .turn_step = turn_step_});
    bool is_open = true;
    while (!steering.is_ended() && sleep_for(period_.get())) {
      if (is_open)
        is_open = take_keys(steering);
      drive(steering.velocity());
    }
    drive({});
    leave_seat();
    if (is_running())
      end_system(0, "the driver has ended the drive");
  }

  /// Takes all that was typed, without waiting. False at the end of the input, where the
  /// robot stops.
  bool take_keys(KeySteering& steering) {
    std::array<char, 64> typed{};
    for (pollfd input{STDIN_FILENO, POLLIN, 0}; poll(&input, 1, 0) > 0;) {
      const auto count = read_input(typed);
      if (count <= 0) {
        steering.take(" ");
        return false;
      }
      steering.take(std::string_view(typed.data(), static_cast<std::size_t>(count)));
    }
    return true;
  }

  static ssize_t read_input(std::array<char, 64>& out) {
    return ::read(STDIN_FILENO, out.data(), out.size());
  }

  Option<double> forward_step_{this, "forward-step", 0.1, "what a key changes, m/s"};
  Option<double> turn_step_{this, "turn-step", 0.2, "what a key changes, rad/s"};
  Option<std::chrono::milliseconds> period_{this, "period", 50ms, "time between commands"};
};

CASTOR_COMPONENT(KeyDriver, "drives a robot by the keys w a s d of the terminal")

} // namespace

} // namespace castor::mapping
