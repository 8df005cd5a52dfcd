#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace castor {

/// The file that an option names: in the working directory or else in the folder `base`, which may
/// be empty. One that is in neither of them is that in the working directory.
inline std::filesystem::path file_named(const std::string& name,
                                        const std::filesystem::path& base) {
  std::filesystem::path path{name};
  std::error_code ignored;
  if (path.is_absolute() || base.empty() || std::filesystem::exists(path, ignored))
    return path;
  auto based = base / path;
  return std::filesystem::exists(based, ignored) ? based : path;
}

} // namespace castor
