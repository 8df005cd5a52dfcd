#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace castor::cli {

/// Gives the process /dev/null for what it was started without of standard input, output and error
/// (`castor run FILE >&- 2>&- <&-`). Otherwise the next file or connection that is opened takes
/// that number, and what is printed goes there. To be called first.
inline void open_standard_descriptors() {
  for (int x : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The lowest free number is the one that is missing, since those below are open.
    if (::fcntl(x, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", O_RDWR) != x)
      std::abort();
}

} // namespace castor::cli
