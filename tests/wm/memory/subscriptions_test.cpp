#include "castor/wm/memory/subscriptions.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

namespace {

using Sent = std::vector<std::pair<Subscriptions::Number, std::vector<std::uint64_t>>>;

/// Of the subarchitecture a; changes in `ignored` are.
class SubscriptionsTest : public testing::Test {
protected:
  ChangeEventPtr change(const std::string& id, const std::string& in = "a") {
    auto event = std::make_shared<ChangeEvent>();
    event->operation = Operation::overwrite;
    event->address = {in, id};
    event->type = descriptor_of<Box>();
    event->sequence = ++sequence;
    return event;
  }

  void record(Subscriptions::Number to, const Subscriptions::Batch& batch) {
    auto& numbers = sent.emplace_back(to, std::vector<std::uint64_t>{}).second;
    for (auto& notice : batch)
      numbers.push_back(notice.event->sequence);
  }

  auto recorder() {
    return
      [this](Subscriptions::Number to, const Subscriptions::Batch& batch) { record(to, batch); };
  }

  /// Writes entries of the subarchitecture at once.
  void write(const std::vector<std::string>& ids) {
    Subscriptions::Notices notices;
    for (auto& id : ids) {
      auto event = change(id);
      subscriptions.collect(event, subscriptions.match(*event, Value::of(Box{})), notices);
    }
    subscriptions.push(std::move(notices), usage, recorder());
  }

  static ChangeFilter any_in(const std::string& subarchitecture) {
    return any_change().in(subarchitecture);
  }

  Subscriptions subscriptions{"a", {"ignored"}, 0};
  UsageLog usage;
  std::uint64_t sequence = 0;
  Sent sent;
};

} // namespace

TEST_F(SubscriptionsTest, SendTheEventsOfAWriteTogetherToWhoWantsThem) {
  auto all = subscriptions.add("ann", standard_queue_limit);
  auto one = subscriptions.add("bob", standard_queue_limit);
  subscriptions.subscribe(all, 1, any_in("a"));
  subscriptions.subscribe(one, 1, any_in("a").at({"a", "y"}));
  write({"x", "y"});
  EXPECT_THAT(sent, ElementsAre(Pair(all, ElementsAre(1u, 2u)), Pair(one, ElementsAre(2u))));
  auto counters = subscriptions.counters();
  EXPECT_EQ(counters.matched, 3u);
  EXPECT_EQ(counters.delivered, 3u);
  ASSERT_EQ(usage.all().size(), 2u);
  EXPECT_EQ(usage.all()[0].events, 2u);
}

TEST_F(SubscriptionsTest, SayWhatToAnnounceToOtherWorkingMemories) {
  auto number = subscriptions.add("ann", standard_queue_limit);
  EXPECT_FALSE(subscriptions.subscribe(number, 1, any_in("a"))) << "it is the own subarchitecture";
  auto interest = subscriptions.subscribe(number, 2, any_in("b"));
  EXPECT_TRUE(interest);
  EXPECT_EQ(subscriptions.subscribe(number, 3, any_in("b")), interest);
  EXPECT_FALSE(subscriptions.unsubscribe(number, 1));
  EXPECT_FALSE(subscriptions.unsubscribe(number, 2)) << "filter 3 wants the same";
  auto withdrawn = subscriptions.unsubscribe(number, 3);
  ASSERT_TRUE(withdrawn);
  EXPECT_EQ(withdrawn->id, interest);
  EXPECT_EQ(withdrawn->filter, any_in("b"));
  EXPECT_FALSE(subscriptions.unsubscribe(number, 3)) << "it is gone";
}

TEST_F(SubscriptionsTest, TellOfChangesElsewhereByInterest) {
  auto ann = subscriptions.add("ann", standard_queue_limit);
  auto bob = subscriptions.add("bob", standard_queue_limit);
  auto interest = *subscriptions.subscribe(ann, 1, any_in("b"));
  subscriptions.subscribe(bob, 1, any_in("b"));
  auto unknown = interest + 1;
  subscriptions.push(subscriptions.receive({{{change("x", "b"), {interest}},
                                             {change("y", "b"), {unknown}},
                                             {change("z", "ignored"), {interest}}}}),
                     usage, recorder());
  EXPECT_THAT(sent, ElementsAre(Pair(ann, ElementsAre(1u)), Pair(bob, ElementsAre(1u))));
}

TEST_F(SubscriptionsTest, NothingIgnoredMatches) {
  auto number = subscriptions.add("ann", standard_queue_limit);
  subscriptions.subscribe(number, 1, any_change().anywhere());
  auto event = change("x", "ignored");
  EXPECT_THAT(subscriptions.match(*event, Value::of(Box{})), IsEmpty());
}

TEST_F(SubscriptionsTest, SendNoMoreThanIsTakenAndMergeTheRest) {
  auto number = subscriptions.add("ann", least_queue_limit);
  subscriptions.subscribe(number, 1, any_in("a"));
  for (std::uint32_t i = 0; i < 2 * least_queue_limit; ++i)
    write({"x"});
  EXPECT_EQ(sent.size(), least_queue_limit);
  EXPECT_EQ(subscriptions.counters().backlog, 1u);
  sent.clear();
  subscriptions.acknowledge(number, least_queue_limit, recorder());
  EXPECT_THAT(sent, ElementsAre(Pair(number, ElementsAre(2u * least_queue_limit))));
  EXPECT_EQ(subscriptions.counters().coalesced, 1u);
  EXPECT_EQ(subscriptions.counters().suppressed, least_queue_limit - 1u);
}

TEST_F(SubscriptionsTest, AreGoneWithTheSubscriberButForTheirCounts) {
  auto number = subscriptions.add("ann", least_queue_limit);
  subscriptions.subscribe(number, 1, any_in("a"));
  auto interest = subscriptions.subscribe(number, 2, any_in("b"));
  for (std::uint32_t i = 0; i < 2 * least_queue_limit; ++i)
    write({"x"});
  auto withdrawn = subscriptions.remove(number);
  ASSERT_EQ(withdrawn.size(), 1u);
  EXPECT_EQ(withdrawn[0].id, interest);
  EXPECT_EQ(subscriptions.size(), 0u);
  EXPECT_EQ(subscriptions.counters().suppressed, least_queue_limit - 1u);
  sent.clear();
  write({"x"});
  EXPECT_THAT(sent, IsEmpty());
}

} // namespace castor::test
