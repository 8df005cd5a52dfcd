#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace castor::cli {

/// Where files that come with the command may be: where it is installed, and in its build tree.
std::vector<std::filesystem::path> bundled_folders();

/// The file itself if it is there, or else the one of that name that is installed with the command,
/// such as configs/vision.cast, or that its source tree has. The file itself if there is none
/// either.
std::string file_or_bundled(const std::string& file);

} // namespace castor::cli
