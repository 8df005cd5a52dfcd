#include "castor/actors/cli/output.hpp"

#include "castor/actors/cli/progress.hpp"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

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

JsonOutput::JsonOutput() {
  std::fflush(stdout);
  output_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (output_ < 0)
    throw std::runtime_error(std::string{"--json needs standard output: "} + std::strerror(errno));
  dup2(STDERR_FILENO, STDOUT_FILENO);
}

JsonOutput::~JsonOutput() {
  std::fflush(stdout);
  dup2(output_, STDOUT_FILENO);
  close(output_);
}

void JsonOutput::print(const nlohmann::ordered_json& x) {
  auto line = x.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  const ProgressPause pause;
  std::lock_guard guard{mutex_};
  for (std::string_view rest = line; !rest.empty();) {
    auto written = write(output_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR)
      continue;
    // Who does not read any more does not want to know.
    if (written < 0)
      return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

} // namespace castor::cli
