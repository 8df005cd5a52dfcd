#include "castor/base/file_access.hpp"

#include "castor/base/input_file.hpp"

#include <cstdlib>

namespace castor {

FileContent read_file(const std::string& path, std::size_t max_bytes) {
  try {
    return {InputFile{path}.read(max_bytes + 1), {}};
  } catch (const InputFileError& e) {
    return {std::nullopt,
            e.reason() == InputFileError::Reason::missing ? "no such file" : e.what()};
  }
}

std::optional<std::string> process_environment(const std::string& name) {
  if (auto value = std::getenv(name.c_str()))
    return std::string(value);
  return std::nullopt;
}

} // namespace castor
