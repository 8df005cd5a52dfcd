#include "castor/actors/cli/bundled_file.hpp"

#include "castor/actors/component/log.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <system_error>

namespace castor::cli {

std::string file_or_bundled(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::path{file}.is_absolute() || fs::exists(file, error))
    return file;
  auto executable = fs::read_symlink("/proc/self/exe", error);
  if (error)
    return file;
  auto folder = executable.parent_path();
  // Installed, it is in bin; in a build tree it is at the top.
  for (auto& share : {folder.parent_path() / "share/castor", folder / "share/castor"}) {
    auto bundled = (share / file).lexically_normal();
    if (!fs::is_regular_file(bundled, error))
      continue;
    note(LogLevel::info, fmt::format("{} is not in this folder: taking {}, which comes with Castor",
                                     file, bundled.string()));
    return bundled.string();
  }
  return file;
}

} // namespace castor::cli
