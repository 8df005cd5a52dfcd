#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace castor {

/// Result of a file loader: the text, or an error.
struct FileContent {
  std::optional<std::string> text;
  /// Completes "cannot read x: ...".
  std::string error;
};

/// Reads a whole file. May stop after `max_bytes + 1` bytes: callers refuse longer files.
using FileLoader = std::function<FileContent(const std::string& path, std::size_t max_bytes)>;

/// Value of an environment variable, if it is set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The loader for real files. Devices and pipes are refused, because reading them may never end.
FileContent read_file(const std::string& path, std::size_t max_bytes);

/// The environment of this process.
std::optional<std::string> process_environment(const std::string& name);

} // namespace castor
