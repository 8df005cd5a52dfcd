#include "castor/wm/entries/failure.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace castor::test {

namespace {

/// Whether the kind is thrown as exactly this type, with everything that the failure says.
template <class Exception>
void expect_thrown(FailureKind kind) {
  Failure failure{kind, "vision/0:3 is gone", {"vision", "0:3"}};
  try {
    throw_failure(failure);
  } catch (const WorkingMemoryException& e) {
    EXPECT_EQ(typeid(e), typeid(Exception));
    EXPECT_EQ(e.kind(), kind);
    EXPECT_EQ(e.address(), failure.address);
    EXPECT_STREQ(e.what(), "vision/0:3 is gone");
  }
}

} // namespace

TEST(Failure, IsThrownAsTheExceptionOfItsKind) {
  expect_thrown<DoesNotExistOnWM>(FailureKind::does_not_exist);
  expect_thrown<AlreadyExistsOnWM>(FailureKind::already_exists);
  expect_thrown<ConsistencyException>(FailureKind::inconsistent);
  expect_thrown<PermissionException>(FailureKind::not_permitted);
  expect_thrown<UnknownSubarchitectureException>(FailureKind::unknown_subarchitecture);
  expect_thrown<TypeMismatchException>(FailureKind::wrong_type);
  expect_thrown<DeadlineException>(FailureKind::no_answer);
  expect_thrown<WorkingMemoryLostException>(FailureKind::working_memory_lost);
}

TEST(Failure, OfAKindFromANewerReleaseIsThrownAsTheBase) {
  expect_thrown<WorkingMemoryException>(static_cast<FailureKind>(200));
}

TEST(Outcome, HoldsAResult) {
  Outcome<std::string> x{"text"};
  EXPECT_TRUE(x.ok());
  EXPECT_TRUE(x);
  EXPECT_EQ(*x, "text");
  EXPECT_EQ(x->size(), 4u);
}

TEST(Outcome, HoldsAFailure) {
  Outcome<std::string> x{Failure{FailureKind::wrong_type, "why", {}}};
  EXPECT_FALSE(x.ok());
  EXPECT_FALSE(x);
  EXPECT_EQ(x.failure().kind, FailureKind::wrong_type);
  EXPECT_EQ(x.failure().message, "why");
}

TEST(Outcome, IsThrownOrGivenBack) {
  EXPECT_EQ(value_or_throw(Outcome<int>{3}), 3);
  EXPECT_THROW(value_or_throw(Outcome<int>{Failure{FailureKind::already_exists, "", {}}}),
               AlreadyExistsOnWM);
}

TEST(Outcome, MovesItsResultOut) {
  Outcome<std::unique_ptr<int>> x{std::make_unique<int>(5)};
  auto taken = value_or_throw(std::move(x));
  EXPECT_EQ(*taken, 5);
}

} // namespace castor::test
