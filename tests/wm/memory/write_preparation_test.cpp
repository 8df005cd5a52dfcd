#include "castor/tests/wm/memory/working_memories.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::test {

namespace {

/// What is wrong with a write.
struct Wrongs {
  bool version = false;
  bool leased = false;
  bool missing = false;
  bool type = false;
  bool permission = false;
};

/// What such a write fails with, or nothing.
std::optional<FailureKind> expected(Operation operation, const Wrongs& x) {
  if (operation != Operation::add && x.leased && !x.missing)
    return FailureKind::leased;
  if (x.permission)
    return FailureKind::not_permitted;
  if (operation == Operation::add)
    return x.missing ? std::nullopt : std::optional{FailureKind::already_exists};
  if (x.missing)
    return FailureKind::does_not_exist;
  if (x.version)
    return FailureKind::inconsistent;
  if (operation == Operation::overwrite && x.type)
    return FailureKind::wrong_type;
  return std::nullopt;
}

std::vector<Wrongs> combinations() {
  std::vector<Wrongs> result;
  for (unsigned bits = 0; bits < 32; ++bits)
    result.push_back(
      {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0});
  return result;
}

std::string text_of(Operation operation, const Wrongs& x) {
  return std::string{to_string(operation)} + (x.version ? ", version" : "") +
         (x.leased ? ", leased" : "") + (x.missing ? ", missing" : "") + (x.type ? ", type" : "") +
         (x.permission ? ", permission" : "");
}

/// Entries of a, `leased` by another and `free`.
class WritePreparation : public WorkingMemories {
protected:
  WritePreparation() {
    for (auto id : {"leased", "free"})
      EXPECT_TRUE(add({"a", id}));
    auto other = std::make_shared<const Client>(Client{"other", "a", 1});
    EXPECT_TRUE(
      ask<Outcome<Lease>>(wm.at("a"), LockRequest{{"a", "leased"}, LockLevel::od, {other, 1, 0s}}));
  }

  static WriteRequest request(Operation operation, const Wrongs& x) {
    WriteRequest result;
    result.operation = operation;
    result.address = {"a", x.missing ? "missing" : x.leased ? "leased" : "free"};
    if (operation != Operation::remove)
      result.value = x.type ? Value::of(FlaggedItem{}) : Value::of(Item{});
    result.last_seen = x.version ? 99 : 0;
    result.client = std::make_shared<const Client>(Client{"tester", x.permission ? "c" : "a", 1});
    return result;
  }
};

} // namespace

TEST_F(WritePreparation, AWriteAloneAndOneInABatchFailAlike) {
  for (auto operation : {Operation::add, Operation::overwrite, Operation::remove})
    for (auto& wrongs : combinations()) {
      SCOPED_TRACE(text_of(operation, wrongs));
      auto kind = expected(operation, wrongs);
      // A write that succeeds would change what the others meet.
      if (!kind)
        continue;
      auto x = request(operation, wrongs);
      auto alone = ask<Outcome<Version>>(wm.at("a"), x);
      auto batch = ask<Outcome<std::vector<Version>>>(wm.at("a"), BatchRequest{"a", {x}});
      ASSERT_FALSE(alone);
      ASSERT_FALSE(batch);
      EXPECT_EQ(alone.failure().kind, *kind) << alone.failure().message;
      EXPECT_EQ(alone.failure().kind, batch.failure().kind);
      EXPECT_EQ(alone.failure().message, batch.failure().message);
      EXPECT_EQ(alone.failure().address, batch.failure().address);
    }
}

TEST_F(WritePreparation, ABatchFailsWithTheFirstWriteThatFails) {
  Wrongs leased, outdated;
  leased.leased = outdated.version = true;
  auto kind = [&](const Wrongs& first, const Wrongs& second) {
    BatchRequest batch{
      "a", {request(Operation::overwrite, first), request(Operation::overwrite, second)}};
    return ask<Outcome<std::vector<Version>>>(wm.at("a"), batch).failure().kind;
  };
  EXPECT_EQ(kind(leased, outdated), FailureKind::leased);
  EXPECT_EQ(kind(outdated, leased), FailureKind::inconsistent);
}

} // namespace castor::test
