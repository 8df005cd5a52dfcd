#include "castor/wm/values/crc32.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::test {

namespace {

TEST(Crc32, IsThatOfTheStandard) {
  Crc32 crc;
  EXPECT_EQ(crc.value(), 0u);
  crc.add("123456789", 9);
  EXPECT_EQ(crc.value(), 0xCBF43926u);
}

TEST(Crc32, DoesNotDependOnThePiecesInWhichBytesCome) {
  std::string text;
  for (int i = 0; i < 1000; ++i)
    text += static_cast<char>(i * 7);
  Crc32 whole;
  whole.add(text.data(), text.size());
  for (std::size_t size : {1u, 3u, 8u, 13u}) {
    Crc32 pieces;
    for (std::size_t i = 0; i < text.size(); i += size)
      pieces.add(text.data() + i, std::min(size, text.size() - i));
    EXPECT_EQ(pieces.value(), whole.value());
  }
}

} // namespace

} // namespace castor::test
