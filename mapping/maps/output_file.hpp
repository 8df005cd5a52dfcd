#pragma once

#include <filesystem>
#include <string_view>

namespace castor::mapping {

/// Writes a whole file: it has its old contents or the new ones at any time.
/// @throws MapFileError if it cannot be written
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

} // namespace castor::mapping
