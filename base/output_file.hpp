#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace castor {

/// Writes a whole file: who reads it meanwhile, or after this process has died, finds the old
/// contents or the new ones. False if it cannot be written. Header only, as input_file.hpp.
[[nodiscard]] inline bool replace_file(const std::filesystem::path& path, std::string_view bytes) {
  auto beside = path;
  beside += ".new";
  std::ofstream file(beside, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file)
    std::filesystem::rename(beside, path, error);
  if (file && !error)
    return true;
  std::filesystem::remove(beside, error);
  return false;
}

} // namespace castor
