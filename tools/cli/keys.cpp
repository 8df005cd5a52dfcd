#include "castor/tools/cli/keys.hpp"

#include <poll.h>
#include <unistd.h>

namespace castor::cli {

Keys::Keys() {
  // A process in the background would be stopped by changing the terminal.
  if (isatty(STDIN_FILENO) == 0 || tcgetpgrp(STDIN_FILENO) != getpgrp())
    return;
  termios now{};
  if (tcgetattr(STDIN_FILENO, &now) != 0)
    return;
  auto before = now;
  now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  if (tcsetattr(STDIN_FILENO, TCSANOW, &now) != 0)
    return;
  before_ = before;
  at_forced_end_.emplace([before] { tcsetattr(STDIN_FILENO, TCSANOW, &before); });
}

Keys::~Keys() {
  if (before_)
    tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

std::optional<char> Keys::next() const {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char key = 0;
  if (!before_ || poll(&input, 1, 0) <= 0 || read(STDIN_FILENO, &key, 1) != 1)
    return std::nullopt;
  return key;
}

} // namespace castor::cli
