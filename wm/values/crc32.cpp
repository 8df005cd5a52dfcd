#include "castor/wm/values/crc32.hpp"

#include <zlib.h>

namespace castor {

void Crc32::add(const void* data, std::size_t size) {
  // Without data, zlib would begin anew.
  if (size > 0)
    value_ = static_cast<std::uint32_t>(crc32_z(value_, static_cast<const Bytef*>(data), size));
}

} // namespace castor
