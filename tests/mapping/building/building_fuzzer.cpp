// Feeds arbitrary text to the reader of buildings.

#include "castor/mapping/building/building_file.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using castor::test::require;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  auto read = castor::mapping::parse_building(text, "fuzz.building");
  // Each says what is wrong and what to do, on lines that cannot drive a terminal.
  for (auto& x : read.problems)
    require(!x.message.empty() && !x.remedy.empty());
  auto problems = render(read.problems);
  require(std::none_of(problems.begin(), problems.end(), [](char c) { return c == '\x1b'; }));
  if (!castor::has_errors(read.problems))
    for (auto& room : read.building.rooms)
      require(room.area > 0 && castor::mapping::contains(room.outline, room.inside));
  return 0;
}
