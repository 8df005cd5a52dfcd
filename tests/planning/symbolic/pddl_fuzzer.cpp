// Feeds arbitrary text to the reader of PDDL; what it accepts is planned for a little while.

#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using castor::test::require;
  // A domain and a problem in one text: the second begins at the last (define.
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto begin = std::min(text.rfind("(define"), text.size());
  auto read = castor::planning::parse_pddl("fuzz-domain.pddl", text.substr(0, begin),
                                           "fuzz-problem.pddl", text.substr(begin));
  for (const auto& x : read.problems)
    require(!x.message.empty() && !x.remedy.empty());
  const auto problems = render(read.problems);
  require(std::ranges::none_of(problems, [](char c) { return c == '\x1b'; }));
  if (castor::has_errors(read.problems))
    return 0;
  castor::planning::PlanningOptions options;
  options.limits.time = std::chrono::milliseconds(50);
  options.limits.groundings = 2000;
  options.limits.memory_bytes = std::size_t{64} << 20;
  castor::planning::find_plan(read.task, options);
  return 0;
}
