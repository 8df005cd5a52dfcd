#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::mapping {

/// Compressed bytes cannot be read. `what()` is the reason, without the file.
class GzipError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Whether these are the first bytes of a file that gzip has made (RFC 1952).
bool is_gzip(std::string_view bytes);

/// What was compressed, of all members of the file. Throws GzipError if the bytes are damaged or
/// cut off, and if there are more than `most` bytes in them.
std::string gunzip(std::string_view bytes, std::size_t most);

} // namespace castor::mapping
