#include "castor/mapping/logs/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>

namespace castor::mapping {

namespace {

constexpr int gzip_window = 16 + MAX_WBITS;

using Inflation = std::unique_ptr<z_stream, void (*)(z_stream*)>;

Inflation start_inflation(z_stream& stream) {
  if (inflateInit2(&stream, gzip_window) != Z_OK)
    throw GzipError("there is no memory to decompress it");
  return {&stream, [](z_stream* x) { inflateEnd(x); }};
}

} // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::string gunzip(std::string_view bytes, std::size_t most) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  std::string result;
  while (!bytes.empty()) {
    z_stream stream{};
    auto inflation = start_inflation(stream);
    // zlib does not write to its input.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), chunk << 9));
    int state = Z_OK;
    while (state != Z_STREAM_END) {
      auto before = result.size();
      if (before > most)
        throw GzipError("it has more than " + std::to_string(most) + " bytes when decompressed");
      result.resize(before + chunk);
      stream.next_out = reinterpret_cast<Bytef*>(result.data() + before);
      stream.avail_out = static_cast<uInt>(chunk);
      state = inflate(&stream, Z_NO_FLUSH);
      result.resize(before + chunk - stream.avail_out);
      if (state == Z_BUF_ERROR)
        throw GzipError("the compressed data end too early");
      if (state != Z_OK && state != Z_STREAM_END)
        throw GzipError("the compressed data are damaged");
    }
    bytes.remove_prefix(stream.total_in);
    // Other bytes after a member are padding.
    if (!is_gzip(bytes))
      break;
  }
  return result;
}

} // namespace castor::mapping
