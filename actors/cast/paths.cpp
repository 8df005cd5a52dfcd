#include "castor/actors/cast/paths.hpp"

#include <algorithm>

namespace castor::cast {

namespace {

bool is_absolute(std::string_view path) noexcept {
  return !path.empty() && path.front() == '/';
}

std::string clean(std::string_view path) {
  std::string result = is_absolute(path) ? "/" : "";
  while (!path.empty()) {
    auto end = std::min(path.find('/'), path.size());
    auto segment = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    if (segment.empty() || segment == ".")
      continue;
    if (!result.empty() && result.back() != '/')
      result += '/';
    result += segment;
  }
  return result;
}

} // namespace

std::string_view directory_of(std::string_view file) noexcept {
  auto slash = file.rfind('/');
  if (slash == std::string_view::npos)
    return {};
  return file.substr(0, std::max<std::size_t>(slash, 1));
}

std::string include_target(std::string_view including_file, std::string_view path) {
  auto directory = directory_of(including_file);
  if (is_absolute(path) || directory.empty())
    return std::string(path);
  std::string result(directory);
  if (result.back() != '/')
    result += '/';
  return result.append(path);
}

std::string path_for_users(std::string_view path, std::string_view working_directory) {
  auto base = clean(working_directory);
  auto absolute = is_absolute(path) ? clean(path) : clean(base + "/" + std::string(path));
  if (absolute == base)
    return ".";
  if (base != "/")
    base += '/';
  if (absolute.compare(0, base.size(), base) == 0)
    return absolute.substr(base.size());
  return absolute;
}

std::string directory_for_users(std::string_view file, std::string_view working_directory) {
  return path_for_users(directory_of(file), working_directory);
}

} // namespace castor::cast
