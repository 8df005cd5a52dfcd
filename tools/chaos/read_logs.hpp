#pragma once

#include "castor/base/input_file.hpp"

#include <filesystem>
#include <fstream>
#include <istream>

namespace castor::faults {

/// Calls `read` with the log of each process in a folder.
/// \throws std::runtime_error if one cannot be read
template <class F>
void read_logs(const std::filesystem::path& folder, F&& read) {
  for (const auto& x : std::filesystem::directory_iterator{folder}) {
    require_input_file(x.path());
    std::ifstream in{x.path()};
    read(static_cast<std::istream&>(in));
  }
}

} // namespace castor::faults
