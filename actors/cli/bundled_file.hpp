#pragma once

#include <string>

namespace castor::cli {

/// The file itself if it is there, or else the one of that name that is installed with the command,
/// such as configs/vision.cast, or that its source tree has. The file itself if there is none
/// either.
std::string file_or_bundled(const std::string& file);

} // namespace castor::cli
