#include "castor/actors/cast/surroundings.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace castor::cast {

FileContent read_file(const std::string& path, std::size_t max_bytes) {
  std::error_code error;
  auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    return {std::nullopt, status.type() == std::filesystem::file_type::not_found ? "no such file"
                                                                                 : error.message()};
  if (std::filesystem::is_directory(status))
    return {std::nullopt, "it is a directory"};
  if (!std::filesystem::is_regular_file(status))
    return {std::nullopt, "it is not a regular file"};
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return {std::nullopt, std::generic_category().message(errno)};
  std::string text;
  constexpr std::size_t chunk = std::size_t{64} << 10;
  while (file && text.size() <= max_bytes) {
    auto old_size = text.size();
    auto wanted = std::min(chunk, max_bytes + 1 - old_size);
    text.resize(old_size + wanted);
    file.read(text.data() + old_size, static_cast<std::streamsize>(wanted));
    text.resize(old_size + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad())
    return {std::nullopt, "reading failed"};
  return {std::move(text), {}};
}

std::optional<std::string> process_environment(const std::string& name) {
  if (auto value = std::getenv(name.c_str()))
    return std::string(value);
  return std::nullopt;
}

} // namespace castor::cast
