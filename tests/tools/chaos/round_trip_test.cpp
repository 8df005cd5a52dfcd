#include "castor/tests/tools/chaos/random_faults.hpp"
#include "castor/tests/tools/chaos/support.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace castor::faults {

namespace {

RC_GTEST_PROP(RoundTrip, OfAPlanThroughItsTextChangesNothing, ()) {
  auto plan = *test::any_plan();
  auto text = to_string(plan);
  auto result = test::parse(text);
  RC_ASSERT(render(result.diagnostics) == "");
  RC_ASSERT(*result.plan == plan);
  RC_ASSERT(to_string(*result.plan) == text);
}

/// What comes back is either a plan or an error.
RC_GTEST_PROP(AnyText, IsAPlanOrRefused, ()) {
  auto piece =
    rc::gen::oneOf(rc::gen::element<std::string>(
                     "\n", " ", "at 1s ", "every 2s ", "rate 1/s ", "after ", "added A", ": ",
                     "crash ", "any ", "component ", "of ", "node ", "or ", "for 1s", "by 2ms ",
                     "partition ", ", ", "from ", "drop 1% ", "on any link", "between ", "and ",
                     "journal ", "clock ", "throw in callback 2 ", "\"", "\\", "#", "seed 1"),
                   rc::gen::arbitrary<std::string>());
  std::string text;
  for (const auto& each : *rc::gen::container<std::vector<std::string>>(piece))
    text += each;
  auto result = test::parse(text);
  RC_ASSERT(result.ok() == result.diagnostics.empty());
  if (result.ok())
    RC_ASSERT(test::plan_of(to_string(*result.plan)) == *result.plan);
}

} // namespace

} // namespace castor::faults
