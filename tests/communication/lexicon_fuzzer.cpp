// Feeds arbitrary text to the reader of lexica.

#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using castor::test::require;
  auto read =
    castor::communication::read_lexicon({reinterpret_cast<const char*>(data), size}, "fuzz.ccg");
  require((read.lexicon != nullptr) == read.problems.empty());
  for (auto& x : read.problems)
    require(!x.message.empty() && !x.remedy.empty() && render(x).find('\x1b') == std::string::npos);
  return 0;
}
