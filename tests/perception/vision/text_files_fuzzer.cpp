// Feeds arbitrary text to the readers of scenes and of cameras' calibrations: its first byte
// chooses which.

#include "castor/perception/vision/camera/camera_model_file.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace {

using namespace castor::vision;
using castor::test::require;

/// Each says what is wrong and what to do, on lines that cannot drive a terminal.
void check(const std::vector<castor::Diagnostic>& problems) {
  for (auto& x : problems)
    require(!x.message.empty() && !x.remedy.empty());
  auto text = render(problems);
  require(std::none_of(text.begin(), text.end(), [](char c) { return c == '\x1b'; }));
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'c') {
    auto read = parse_camera(text, "fuzz.camera");
    check(read.problems);
    require(read.camera.has_value() != castor::has_errors(read.problems));
  } else {
    check(parse_tabletop_scene(text, "fuzz.scene").problems);
  }
  return 0;
}
