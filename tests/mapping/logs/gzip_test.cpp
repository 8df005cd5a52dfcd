#include "castor/mapping/logs/gzip.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace castor::mapping::test {

namespace {

constexpr std::size_t much = std::size_t{1} << 24;

std::string zipped(const std::string& text) {
  std::string result(text.size() + 1000, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

// Several of the pieces that are decompressed at once.
std::string long_text() {
  std::string result;
  for (int i = 0; result.size() < 3'000'000; ++i)
    result += std::to_string(i) + "\n";
  return result;
}

TEST(Gzip, IsKnownByItsFirstBytes) {
  EXPECT_TRUE(is_gzip(zipped("x")));
  EXPECT_FALSE(is_gzip("FLASER 180"));
  EXPECT_FALSE(is_gzip(""));
}

TEST(Gzip, TextComesBack) {
  EXPECT_EQ(gunzip(zipped(long_text()), much), long_text());
  EXPECT_EQ(gunzip(zipped(""), much), "");
}

TEST(Gzip, MembersFollowEachOther) {
  EXPECT_EQ(gunzip(zipped("one\n") + zipped("two\n"), much), "one\ntwo\n");
}

TEST(Gzip, BytesThatAreCutOffOrDamaged) {
  auto bytes = zipped(long_text());
  EXPECT_THROW(gunzip(bytes.substr(0, bytes.size() / 2), much), GzipError);
  EXPECT_THROW(gunzip(bytes.substr(0, 5), much), GzipError);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  EXPECT_THROW(gunzip(bytes, much), GzipError);
}

TEST(Gzip, MoreBytesThanAreWanted) {
  EXPECT_THROW(gunzip(zipped(long_text()), 1'000'000), GzipError);
}

} // namespace

} // namespace castor::mapping::test
