#include "castor/wm/values/known_types.hpp"

#include "castor/wm/values/descriptor_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

struct UsedInCodeThatNeverRuns {
  int number = 0;
};
CASTOR_REFLECT(UsedInCodeThatNeverRuns, number)

struct NeverUsed {
  int number = 0;
};
CASTOR_REFLECT(NeverUsed, number)

} // namespace

const TypeDescriptorPtr& never_called();
const TypeDescriptorPtr& never_called() {
  return descriptor_of<UsedInCodeThatNeverRuns>();
}

TEST(KnownTypes, AreThoseThatLoadedCodeUsesEvenIfItHasNotRun) {
  auto types = known_types();
  auto found = types.find("UsedInCodeThatNeverRuns");
  ASSERT_NE(found, types.end());
  ASSERT_EQ(found->second->records.front().fields.size(), 1U);
  EXPECT_EQ(found->second->records.front().fields.front().name, "number");
  EXPECT_EQ(types.count("NeverUsed"), 0U);
}

TEST(KnownTypes, AreTheSameForAllWhoAskAtOnce) {
  std::vector<TypeCatalogue> answers(8);
  {
    std::vector<std::jthread> threads;
    for (auto& x : answers)
      threads.emplace_back([&x] { x = known_types(); });
  }
  EXPECT_TRUE(std::ranges::all_of(answers, [&](auto& x) { return x == answers.front(); }));
}

} // namespace castor::test
