#include "castor/tests/planning/symbolic/validator.hpp"

#include "castor/tests/planning/symbolic/domains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> right{"go hall kitchen", "take red kitchen", "go kitchen hall",
                                     "go hall study",   "put red study",    "take blue study",
                                     "go study hall",   "go hall kitchen",  "put blue kitchen"};

TEST(ValidatorTest, AcceptsARightPlan) {
  const PddlModel model(cups_domain, cups_problem);
  EXPECT_EQ(validate(model, right, 14), "");
}

TEST(ValidatorTest, RefusesWrongPlans) {
  const PddlModel model(cups_domain, cups_problem);
  EXPECT_THAT(validate(model, right, 13), HasSubstr("costs 14, not 13"));
  for (std::size_t i = 0; i < right.size(); ++i) {
    auto shorter = right;
    shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_NE(validate(model, shorter, 14), "") << i;
  }
  auto wrong = right;
  wrong[1] = "take red"; // too few arguments
  EXPECT_THAT(validate(model, wrong, 14), HasSubstr("action 2 is not applicable"));
  wrong[1] = "take kitchen kitchen"; // of another type
  EXPECT_THAT(validate(model, wrong, 14), HasSubstr("action 2 is not applicable"));
  EXPECT_THAT(validate(model, {"fly hall kitchen"}, 1), HasSubstr("action 1 is not applicable"));
  EXPECT_THAT(validate(model, {}, 0), HasSubstr("the goal is not reached"));
}

TEST(ValidatorTest, AppliesConditionalEffectsAndAxioms) {
  const PddlModel model(
    lamps_domain, "(define (problem p) (:domain lamps) (:objects a b c - node)"
                  "(:init (source a) (wire a b) (wire b c)) (:goal (and (live c) (not (dark)))))");
  EXPECT_EQ(validate(model, {"switch b c", "switch a b"}, 2), "");
  EXPECT_NE(validate(model, {"switch b c", "switch a b", "switch a b"}, 3), "");
  EXPECT_NE(validate(model, {"switch b c", "switch a b", "cut-all"}, 3), "");
  EXPECT_THAT(validate(model, {"cut-all"}, 1), HasSubstr("not applicable"));
}

} // namespace
} // namespace castor::test
