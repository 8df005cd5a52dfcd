#include "castor/tests/wm/memory/working_memories.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::test {

namespace {

/// Working memories whose events go to components that do not keep up.
class SlowComponents : public WorkingMemories {
protected:
  static constexpr std::uint32_t limit = 16;

  void overwrite_often(const Address& at, int times) {
    auto version = *ask<Outcome<Version>>(wm.at(at.subarchitecture), VersionQuery{at});
    for (int i = 1; i <= times; ++i)
      version = *overwrite(at, version, i);
  }

  /// Takes what has come, and what comes in its place, until no more does.
  void catch_up(Listener& who, const std::string& at) {
    std::size_t taken = 0;
    while (taken < who.notices.size()) {
      auto now = who.notices.size();
      take(who, at, now - std::exchange(taken, now));
    }
  }
};

TEST_F(SlowComponents, AreSentNoMoreThanTheyTake) {
  auto& slow = listen();
  auto& fast = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  subscribe(fast, "a", 1, any_change());
  Told expected;
  for (int i = 0; i < 30; ++i) {
    add({"a", std::to_string(i)});
    expected.push_back("ADD a/" + std::to_string(i));
  }
  EXPECT_EQ(slow.notices.size(), limit);
  EXPECT_EQ(told(fast), expected) << "others are none the worse for it";
  EXPECT_EQ(status("a").backlog, 30u - limit);
  take(slow, "a", 4);
  EXPECT_EQ(slow.notices.size(), limit + 4);
  take(slow, "a", limit);
  EXPECT_EQ(told(slow), expected);
  EXPECT_EQ(status("a").backlog, 0u);
}

TEST_F(SlowComponents, GetTheNewestStateOfWhatTheyMissed) {
  auto& slow = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  for (auto id : {"x", "y"})
    add({"a", id});
  overwrite_often({"a", "x"}, 100);
  overwrite_often({"a", "y"}, 100);
  remove({"a", "x"});
  add({"a", "z"});
  overwrite_often({"a", "z"}, 5);
  EXPECT_EQ(status("a").backlog, 3u);
  catch_up(slow, "a");
  ASSERT_EQ(slow.notices.size(), limit + 3);
  auto& y = *slow.notices[limit].event;
  EXPECT_EQ(to_string(y), "OVERWRITE Item a/y v100 by tester, changed number, coalesced");
  EXPECT_EQ(to_string(*slow.notices[limit + 1].event), "DELETE Item a/x v100 by tester, coalesced");
  EXPECT_EQ(to_string(*slow.notices[limit + 2].event), "ADD Item a/z v5 by tester, coalesced");
}

TEST_F(SlowComponents, GetEveryEventAgainOnceTheyHaveCaughtUp) {
  auto& slow = listen();
  subscribe(slow, "a", 1, overwritten<Item>(), limit);
  add({"a", "x"});
  overwrite_often({"a", "x"}, 100);
  catch_up(slow, "a");
  slow.notices.clear();
  add({"a", "y"});
  overwrite_often({"a", "x"}, 10);
  ASSERT_EQ(slow.notices.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(slow.notices[i].event->version, 101 + i);
    EXPECT_FALSE(slow.notices[i].event->coalesced);
  }
}

TEST_F(SlowComponents, AreNotGivenPartsOfAWriteUntilTheyAreFarBehind) {
  auto& slow = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  for (std::uint32_t i = 0; i < limit; ++i)
    add({"a", std::to_string(i)});
  BatchRequest batch{"a", {}};
  for (auto id : {"p", "q"})
    batch.writes.push_back({Operation::add,
                            {"a", id},
                            Value::of(Item{}),
                            {},
                            std::make_shared<const Client>(Client{"tester", "a"})});
  ASSERT_TRUE(ask<Outcome<std::vector<Version>>>(wm.at("a"), batch));
  EXPECT_EQ(status("a").backlog, 2u);
  EXPECT_EQ(slow.batches, 0);
  catch_up(slow, "a");
  EXPECT_EQ(slow.batches, 1);
}

TEST_F(SlowComponents, CostNothingWhenTheyHaveEnded) {
  auto& slow = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  for (int i = 0; i < 100; ++i)
    add({"a", std::to_string(i)});
  overwrite_often({"a", "50"}, 10);
  auto before = status("a");
  EXPECT_EQ(before.backlog, 100u - limit);
  caf::anon_send_exit(slow.actor, caf::exit_reason::user_shutdown);
  scheduler.run();
  auto after = status("a");
  EXPECT_EQ(after.backlog, 0u);
  EXPECT_EQ(after.suppressed, before.suppressed);
  // Its successor begins anew.
  auto& next = listen();
  subscribe(next, "a", 1, any_change(), limit);
  overwrite_often({"a", "1"}, 10);
  EXPECT_EQ(next.notices.size(), 10u);
}

TEST_F(SlowComponents, HearOfNothingThatTheyWantNoMore) {
  auto& slow = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  subscribe(slow, "a", 2, deleted<Item>(), limit);
  for (int i = 0; i < 40; ++i)
    add({"a", std::to_string(i)});
  remove({"a", "1"});
  caf::send_as(slow.actor, wm.at("a"), Unsubscribe{1});
  scheduler.run();
  EXPECT_EQ(status("a").backlog, 1u);
  catch_up(slow, "a");
  EXPECT_EQ(slow.notices.size(), limit + 1);
  EXPECT_EQ(slow.notices.back().filters, FilterIds{2});
}

TEST_F(SlowComponents, AreSentWhatTheirRuntimeNeedsAllTheSame) {
  auto& slow = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  caf::send_as(slow.actor, wm.at("a"), Subscribe{2, deleted<Item>(), EventStream::runtime, limit});
  scheduler.run();
  for (int i = 0; i < 100; ++i)
    add({"a", std::to_string(i)});
  EXPECT_EQ(slow.notices.size(), limit);
  remove({"a", "7"});
  ASSERT_EQ(slow.notices.size(), limit + 1);
  EXPECT_EQ(slow.notices.back().filters, FilterIds{2});
  // Acknowledgements of one stream are none of the other's.
  for (int i = 20; i < 50; ++i)
    remove({"a", std::to_string(i)});
  EXPECT_EQ(slow.notices.size(), 2 * limit);
  take(slow, "a", 3, EventStream::runtime);
  EXPECT_EQ(slow.notices.size(), 2 * limit + 3);
  for (auto i = 2 * limit; i < slow.notices.size(); ++i)
    EXPECT_EQ(slow.notices[i].filters, FilterIds{2});
  caf::send_as(slow.actor, wm.at("a"), Unsubscribe{2});
  scheduler.run();
  EXPECT_EQ(status("a").filters, 1u);
}

TEST_F(SlowComponents, AreSentWhatHappensElsewhereLikewise) {
  auto& slow = listen();
  subscribe(slow, "b", 1, any_change().anywhere(), limit);
  add({"a", "x"});
  overwrite_often({"a", "x"}, 50);
  add({"b", "y"});
  overwrite_often({"b", "y"}, 50);
  overwrite_often({"a", "x"}, 50);
  EXPECT_EQ(status("b").backlog, 2u);
  catch_up(slow, "b");
  ASSERT_EQ(slow.notices.size(), limit + 2);
  EXPECT_EQ(to_string(*slow.notices[limit].event), "ADD Item b/y v50 by tester, coalesced");
  EXPECT_EQ(slow.notices[limit + 1].event->version, 100u);
}

TEST_F(SlowComponents, CostNoMemoryForWhatIsNoMore) {
  auto& adds = listen();
  auto& deletions = listen();
  auto& overwrites = listen();
  subscribe(adds, "a", 1, added<Item>(), limit);
  subscribe(deletions, "a", 1, deleted<Item>(), limit);
  subscribe(overwrites, "a", 1, overwritten<Item>(), limit);
  for (int i = 0; i < 500; ++i) {
    Address address{"a", std::to_string(i)};
    add(address);
    overwrite_often(address, 1);
    remove(address);
    // Each keeps so many events before it merges, and merges with the next.
    EXPECT_LE(status("a").backlog, 3 * (Receipts::batch_for(limit) + 1));
  }
}

TEST_F(SlowComponents, AreCounted) {
  auto& slow = listen();
  auto& fast = listen();
  subscribe(slow, "a", 1, any_change(), limit);
  subscribe(fast, "a", 1, overwritten<Item>());
  add({"a", "x"});
  overwrite_often({"a", "x"}, 99);
  auto x = status("a");
  EXPECT_EQ(x.events, 100u);
  EXPECT_EQ(x.matched, 199u);
  EXPECT_EQ(x.delivered, 99u + limit);
  EXPECT_EQ(x.coalesced, 0u);
  EXPECT_EQ(x.suppressed, 100u - limit - 1);
  EXPECT_EQ(x.backlog, 1u);
  catch_up(slow, "a");
  x = status("a");
  EXPECT_EQ(x.delivered, 99u + limit + 1);
  EXPECT_EQ(x.coalesced, 1u);
  EXPECT_EQ(x.backlog, 0u);
  EXPECT_EQ(x.matched, x.delivered + x.suppressed);
}

} // namespace

} // namespace castor::test
