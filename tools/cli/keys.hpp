#pragma once

#include "castor/tools/cli/signals.hpp"

#include <optional>

#include <termios.h>

namespace castor::cli {

/// Reads keys that are pressed in the terminal while a command runs, without Return and without
/// echo. The destructor restores the terminal's mode.
class Keys {
public:
  Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;
  ~Keys();

  /// Whether the command runs in the foreground of a terminal.
  bool are_read() const { return before_.has_value(); }

  /// The next key that was pressed, if any.
  std::optional<char> next() const;

private:
  std::optional<termios> before_;
  std::optional<AtForcedEnd> at_forced_end_;
};

} // namespace castor::cli
