#pragma once

#include <filesystem>
#include <string>

/// Checks, before a command begins, whether its output files can be written.
namespace castor::cli {

/// For CLI11's `check` of options that name an output file: an error message, or empty. Leaves no
/// file behind.
std::string check_output_file(const std::string& file);

/// The same for a folder, which is made if it does not exist.
std::string check_output_folder(const std::string& folder);

/// Makes a folder and its parent folders. Throws std::runtime_error.
void make_folder(const std::filesystem::path& folder);

} // namespace castor::cli
