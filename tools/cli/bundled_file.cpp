#include "castor/tools/cli/bundled_file.hpp"

#include "castor/base/log.hpp"

#include <fmt/core.h>

#include <system_error>

namespace castor::cli {

namespace fs = std::filesystem;

std::vector<fs::path> bundled_folders() {
  std::error_code error;
  auto executable = fs::read_symlink("/proc/self/exe", error);
  if (error)
    return {};
  auto folder = executable.parent_path();
  // Installed, it is in bin; in a build tree it is at the top.
  return {folder.parent_path() / "share/castor", folder / "share/castor"};
}

std::string file_or_bundled(const std::string& file) {
  std::error_code error;
  if (fs::path{file}.is_absolute() || fs::exists(file, error))
    return file;
  for (auto& share : bundled_folders()) {
    auto bundled = (share / file).lexically_normal();
    if (!fs::is_regular_file(bundled, error))
      continue;
    log_runtime(LogLevel::info,
                fmt::format("{} is not in this folder: taking {}, which comes with Castor", file,
                            bundled.string()));
    return bundled.string();
  }
  return file;
}

} // namespace castor::cli
