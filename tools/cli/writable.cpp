#include "castor/tools/cli/writable.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

/// Why no file can be made in a folder; empty if one can. Permissions alone do not tell.
std::string why_no_file_in(const fs::path& folder) {
  auto name = (folder / (".castor-" + std::to_string(getpid()) + "-XXXXXX")).string();
  auto file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0)
    return errno == ENOENT ? "no files can be made there" : std::strerror(errno);
  close(file);
  unlink(name.c_str());
  return {};
}

fs::path folder_of(const fs::path& file) {
  auto result = file.parent_path();
  return result.empty() ? fs::path{"."} : result;
}

} // namespace

std::string check_output_file(const std::string& file) {
  std::error_code error;
  if (file.empty())
    return "write the name of a file";
  auto status = fs::status(file, error);
  if (fs::is_directory(status))
    return file + " is a folder; write the name of a file in it";
  if (fs::exists(status)) {
    // Neither is anything cut off, nor does a pipe without a reader hold us up.
    auto opened = open(file.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC);
    if (opened < 0 && errno != ENXIO)
      return "cannot write " + file + ": " + std::strerror(errno) + "; choose another file";
    if (opened >= 0)
      close(opened);
    return {};
  }
  const auto folder = folder_of(file);
  status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status))
    return "cannot write " + file + ": " + folder.string() + " is no folder; choose another place";
  if (!fs::exists(status))
    return "there is no folder " + folder.string() + " to write " +
           fs::path{file}.filename().string() + " into; make it first";
  if (auto problem = why_no_file_in(folder); !problem.empty())
    return "cannot write into the folder " + folder.string() + ": " + problem +
           "; choose another place";
  return {};
}

std::string check_output_folder(const std::string& folder) {
  if (folder.empty())
    return "write the name of a folder";
  std::error_code error;
  // The one that is there.
  auto nearest = fs::path{folder};
  while (!fs::exists(fs::symlink_status(nearest, error)) && nearest != folder_of(nearest))
    nearest = folder_of(nearest);
  if (!fs::is_directory(nearest, error))
    return (nearest == folder
              ? folder + " is no folder"
              : "cannot make the folder " + folder + ": " + nearest.string() + " is no folder") +
           "; choose another place";
  if (auto problem = why_no_file_in(nearest); !problem.empty())
    return "cannot write into the folder " + nearest.string() + ": " + problem +
           "; choose another place";
  return {};
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error("cannot make the folder " + folder.string() + ": " + error.message() +
                             "; choose another place");
}

} // namespace castor::cli
