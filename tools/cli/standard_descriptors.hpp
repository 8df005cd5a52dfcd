#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace castor::cli {

/// Opens /dev/null for each of standard input, output and error that is closed (`castor run FILE
/// >&- 2>&- <&-`). Otherwise the next file or connection gets that descriptor, and output goes
/// there. To be called first.
inline void open_standard_descriptors() {
  for (int x : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The lowest free number is the one that is missing, since those below are open.
    if (::fcntl(x, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", O_RDWR) != x)
      std::abort();
}

} // namespace castor::cli
