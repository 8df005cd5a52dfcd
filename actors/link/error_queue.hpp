#pragma once

#include <string>

namespace castor {

/// OpenSSL's error queue belongs to the thread, and what one channel leaves there another takes for
/// an error of its own. While an object of this class lives, the queue holds only what was called
/// since; before and after that it is empty.
class ErrorQueue {
public:
  ErrorQueue();
  ErrorQueue(const ErrorQueue&) = delete;
  ErrorQueue& operator=(const ErrorQueue&) = delete;
  ~ErrorQueue();

  /// The SSL_R_ code of the latest error; 0 if it is none of libssl's.
  int ssl_reason() const;
  /// The PEM_R_ code of the latest error; 0 if it is none of the PEM reader's.
  int pem_reason() const;
  /// What OpenSSL says about the latest error.
  std::string text() const;
};

} // namespace castor
