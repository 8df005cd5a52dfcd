#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace castor::mapping {

/// The file, in the working directory or else in the folder `base`.
inline std::filesystem::path file_named(const std::string& name, const std::string& base) {
  const std::filesystem::path path(name);
  std::error_code ignored;
  if (path.is_absolute() || base.empty() || std::filesystem::exists(path, ignored))
    return path;
  const auto based = std::filesystem::path(base) / path;
  return std::filesystem::exists(based, ignored) ? based : path;
}

} // namespace castor::mapping
