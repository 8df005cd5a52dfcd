#pragma once

#include <string>

namespace castor {

/// Empties OpenSSL's error queue in its constructor and destructor: the queue belongs to the
/// thread, so that errors left by one channel would be taken for errors of another. While this
/// object lives, the queue holds only errors of calls made since.
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
  /// OpenSSL's text of the latest error.
  std::string text() const;
};

} // namespace castor
