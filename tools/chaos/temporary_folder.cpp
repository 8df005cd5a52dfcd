#include "castor/tools/chaos/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace castor::faults {

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
  std::error_code error;
  auto temporary = std::filesystem::temp_directory_path(error);
  auto name =
    ((error ? std::filesystem::path{"/tmp"} : temporary) / ("castor-" + purpose + "-XXXXXX"))
      .string();
  if (!mkdtemp(name.data()))
    throw std::runtime_error("cannot make the folder " + name + ": " + std::strerror(errno) +
                             "; give the variable TMPDIR a folder that you may write to");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

} // namespace castor::faults
