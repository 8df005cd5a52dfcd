#include "castor/tools/cli/output.hpp"

#include "castor/actors/system/inspection_json.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/signals.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::cli {

namespace {

/// What kept a line from being written to standard output (errno); 0 for nothing.
std::atomic<int> lost_output{0};

} // namespace

void print(const std::vector<Diagnostic>& problems) {
  std::fputs(render(problems, isatty(STDERR_FILENO) != 0).c_str(), stderr);
}

std::ofstream create(const std::filesystem::path& file) {
  errno = 0;
  std::ofstream result{file};
  if (!result)
    throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno) +
                             "; choose another file");
  return result;
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  auto out = create(file);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.flush();
  if (!out)
    throw std::runtime_error("cannot write " + file.string() + ": check that the disk is not full");
}

JsonOutput::JsonOutput() {
  std::fflush(stdout);
  output_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (output_ < 0)
    throw std::runtime_error(std::string{"--json needs standard output: "} + std::strerror(errno));
  dup2(STDERR_FILENO, STDOUT_FILENO);
  set_moved_output(output_);
}

JsonOutput::~JsonOutput() {
  std::fflush(stdout);
  dup2(output_, STDOUT_FILENO);
  set_moved_output(-1);
  close(output_);
}

void JsonOutput::print(const nlohmann::ordered_json& x) {
  auto line = as_line(x);
  const ProgressPause pause;
  std::lock_guard guard{mutex_};
  for (std::string_view rest = line; !rest.empty();) {
    auto written = write(output_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR)
      continue;
    if (written < 0) {
      lost_output = errno;
      return;
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

int finish_output(int status) {
  errno = 0;
  bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  int why = lost_output != 0 ? lost_output.load() : errno;
  if ((!failed && lost_output == 0) || why == EPIPE)
    return status;
  std::fprintf(stderr, "castor: the output is incomplete: %s\n",
               why != 0 ? std::strerror(why) : "standard output cannot be written");
  return status != 0 ? status : 1;
}

} // namespace castor::cli
