#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace castor::cli {

/// Folders of files that come with the command: in its installation, and in its build tree.
std::vector<std::filesystem::path> bundled_folders();

/// The file itself if it exists, otherwise the file of that name in the command's installation or
/// source tree, such as configs/vision.cast. The file itself if there is neither.
std::string file_or_bundled(const std::string& file);

} // namespace castor::cli
