#pragma once

#include <string>
#include <string_view>

namespace castor::cast {

/// The part before the last slash; empty for a bare file name, "/" for a file in the root.
std::string_view directory_of(std::string_view file) noexcept;

/// Where an INCLUDE line in `including_file` points to: an absolute path stays as it is, any other
/// is relative to the including file's directory.
std::string include_target(std::string_view including_file, std::string_view path);

/// A path without "." segments and doubled slashes, relative to the working directory if it lies in
/// it ("." if it is the working directory itself), otherwise absolute. Segments ".." stay, because
/// only the file system knows where they lead past a symbolic link.
std::string path_for_users(std::string_view path, std::string_view working_directory);

/// `path_for_users` of a file's directory: the form of CONFIG_DIR and MAIN_DIR.
std::string directory_for_users(std::string_view file, std::string_view working_directory);

} // namespace castor::cast
