#pragma once

#include <filesystem>
#include <string>

/// Whether what a command is to write can be written: asked before it begins, not when it is over.
namespace castor::cli {

/// For CLI11's `check` of options that name a file to be written: what is in the way, if anything
/// is. Nothing is left behind.
std::string check_output_file(const std::string& file);

/// The same for a folder that is made if it is not there.
std::string check_output_folder(const std::string& folder);

/// Makes a folder, with those around it. Throws std::runtime_error.
void make_folder(const std::filesystem::path& folder);

} // namespace castor::cli
