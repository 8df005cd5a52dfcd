#include "castor/planning/continual/executors.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace castor::planning {
namespace {

TEST(Executors, AreFoundByTheLongestRule) {
  const Executors executors({"move=navigation", "ask-*=communication", "ask-val-is-*=navigation"},
                            "body");
  EXPECT_EQ(executors.executor_of("move"), "navigation");
  EXPECT_EQ(executors.executor_of("move-to-area"), "body");
  EXPECT_EQ(executors.executor_of("ask-val-area-of"), "communication");
  EXPECT_EQ(executors.executor_of("ask-val-is-in"), "navigation");
}

TEST(Executors, AreNotMadeOfRulesThatAreNone) {
  for (const auto* rule : {"move", "move=", "=navigation"})
    EXPECT_THROW(Executors({rule}, "body"), std::invalid_argument) << rule;
}

} // namespace
} // namespace castor::planning
