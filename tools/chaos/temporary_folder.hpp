#pragma once

#include <filesystem>
#include <string>

namespace castor::faults {

/// A folder among the temporary files of the system, which is gone with this object.
class TemporaryFolder {
public:
  /// @param purpose a part of its name, such as "operations"
  /// \throws std::runtime_error if it cannot be made
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();

  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace castor::faults
