#pragma once

#include <csignal>

namespace castor::cli {

/// Ctrl-C and the like, as a question to ask instead of an interruption. Made before any thread is.
class Signals {
public:
  Signals() {
    sigemptyset(&set_);
    for (int x : {SIGINT, SIGTERM, SIGHUP})
      sigaddset(&set_, x);
    pthread_sigmask(SIG_BLOCK, &set_, nullptr);
  }

  /// How often the user has asked for the end so far.
  int count() {
    timespec no_time{0, 0};
    while (sigtimedwait(&set_, nullptr, &no_time) > 0)
      ++count_;
    return count_;
  }

private:
  sigset_t set_;
  int count_ = 0;
};

} // namespace castor::cli
