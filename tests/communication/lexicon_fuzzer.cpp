// Feeds arbitrary text to the reader of lexica.

#include "castor/communication/parsing/lexicon_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto read =
    castor::communication::read_lexicon({reinterpret_cast<const char*>(data), size}, "fuzz.ccg");
  if ((read.lexicon != nullptr) != read.problems.empty())
    std::abort();
  for (auto& x : read.problems)
    if (x.message.empty() || x.remedy.empty() || to_string(x).find('\x1b') != std::string::npos)
      std::abort();
  return 0;
}
