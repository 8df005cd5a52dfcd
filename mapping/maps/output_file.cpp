#include "castor/mapping/maps/output_file.hpp"

#include "castor/mapping/maps/map_file_error.hpp"

#include <fstream>
#include <system_error>

namespace castor::mapping {

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
  auto beside = path;
  beside += ".new";
  std::ofstream file(beside, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file)
    std::filesystem::rename(beside, path, error);
  if (!file || error) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw MapFileError(path.string(), 0, {}, "the file cannot be written",
                       "Check that its folder exists, that you may write there, and that the disk "
                       "is not full.");
  }
}

} // namespace castor::mapping
