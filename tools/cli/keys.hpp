#pragma once

#include "castor/tools/cli/signals.hpp"

#include <optional>

#include <termios.h>

namespace castor::cli {

/// Keys that are pressed while a command runs in a terminal: without Return, and not echoed. The
/// terminal is as it was before once this object is gone.
class Keys {
public:
  Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;
  ~Keys();

  /// Whether there is a terminal to press keys in, in the foreground.
  bool are_read() const { return before_.has_value(); }

  /// The next key that was pressed, if any.
  std::optional<char> next() const;

private:
  std::optional<termios> before_;
  std::optional<AtForcedEnd> at_forced_end_;
};

} // namespace castor::cli
