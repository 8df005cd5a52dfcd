#include "castor/actors/cli/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace castor::cli {

void print(const std::vector<cast::Diagnostic>& problems) {
  std::fputs(cast::render(problems, isatty(STDERR_FILENO) != 0).c_str(), stderr);
}

std::ofstream create(const std::filesystem::path& file) {
  errno = 0;
  std::ofstream result{file};
  if (!result)
    throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno) +
                             "; choose another file");
  return result;
}

} // namespace castor::cli
