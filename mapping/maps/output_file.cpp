#include "castor/mapping/maps/output_file.hpp"

#include "castor/base/output_file.hpp"
#include "castor/mapping/maps/map_file_error.hpp"

namespace castor::mapping {

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
  if (!replace_file(path, bytes))
    throw MapFileError(path.string(), 0, {}, "the file cannot be written",
                       "Check that its folder exists, that you may write there, and that the disk "
                       "is not full.");
}

} // namespace castor::mapping
