#include "castor/tests/wm/memory/working_memories.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

TEST_F(WorkingMemories, TellOwnComponentsOfWhatTheyAskedFor) {
  auto& all = listen();
  auto& deletions = listen();
  subscribe(all, "a", 1, any_change());
  subscribe(deletions, "a", 1, deleted<Item>());
  EXPECT_EQ(all.subscribed, 1);
  ASSERT_TRUE(add({"a", "x"}));
  ASSERT_TRUE(overwrite({"a", "x"}, 0));
  ASSERT_TRUE(remove({"a", "x"}));
  EXPECT_EQ(told(all), (Told{"ADD a/x", "OVERWRITE a/x", "DELETE a/x"}));
  EXPECT_EQ(told(deletions), (Told{"DELETE a/x"}));
  EXPECT_EQ(all.notices.back().event->version, 1u);
  EXPECT_EQ(all.notices.back().event->source, "tester");
}

TEST_F(WorkingMemories, SendOneNoticeHoweverManyFiltersMatch) {
  auto& listener = listen();
  subscribe(listener, "a", 1, any_change());
  subscribe(listener, "a", 2, changed<Item>());
  subscribe(listener, "a", 3, deleted<Item>());
  add({"a", "x"});
  ASSERT_EQ(listener.notices.size(), 1u);
  EXPECT_EQ(listener.notices[0].filters, (FilterIds{1, 2}));
}

TEST_F(WorkingMemories, SayNothingOfWhatWasRefused) {
  auto& listener = listen();
  subscribe(listener, "a", 1, any_change());
  EXPECT_EQ(overwrite({"a", "x"}, 0).failure().kind, FailureKind::does_not_exist);
  add({"a", "x"});
  EXPECT_EQ(add({"a", "x"}).failure().kind, FailureKind::already_exists);
  EXPECT_EQ(overwrite({"a", "x"}, 7).failure().kind, FailureKind::inconsistent);
  EXPECT_EQ(told(listener), (Told{"ADD a/x"}));
  EXPECT_EQ(status("a").refused, 3u);
}

TEST_F(WorkingMemories, ForwardToThoseSubarchitecturesThatWantIt) {
  auto& in_b = listen();
  auto& also_in_b = listen();
  auto& in_c = listen();
  subscribe(in_b, "b", 1, changed<Item>().anywhere());
  subscribe(also_in_b, "b", 1, changed<Item>().anywhere());
  subscribe(in_c, "c", 1, changed<Item>().in("b"));
  add({"a", "x"});
  EXPECT_EQ(told(in_b), (Told{"ADD a/x"}));
  EXPECT_EQ(told(also_in_b), (Told{"ADD a/x"}));
  EXPECT_TRUE(in_c.notices.empty());
  EXPECT_EQ(status("a").forwarded, 1u) << "one copy, for b";
  add({"b", "y"});
  EXPECT_EQ(told(in_c), (Told{"ADD b/y"}));
}

TEST_F(WorkingMemories, ForwardSuperTypesToo) {
  auto& in_b = listen();
  subscribe(in_b, "b", 1, added<Item>().in("a"));
  write("a", {Operation::add, {"a", "g"}, Value::of(FlaggedItem{}), {}, {}});
  EXPECT_EQ(told(in_b), (Told{"ADD a/g"}));
}

TEST_F(WorkingMemories, AnswerASubscriptionOnlyWhenItIsInForceEverywhere) {
  auto& in_b = listen();
  caf::send_as(in_b.actor, wm.at("b"), Subscribe{1, any_change().anywhere()});
  // b itself has taken note, the others have not been run yet.
  scheduler.run_once();
  EXPECT_EQ(in_b.subscribed, 0);
  scheduler.run();
  EXPECT_EQ(in_b.subscribed, 1);
}

TEST_F(WorkingMemories, SaySoWhenAnotherOneDoesNotTakeNote) {
  caf::anon_send_exit(wm.at("c"), caf::exit_reason::kill);
  scheduler.run();
  auto outcome = ask<Outcome<Acknowledged>>(wm.at("b"), Subscribe{1, any_change().in("c")});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.failure().kind, FailureKind::no_answer);
  EXPECT_NE(outcome.failure().message.find("c did not"), std::string::npos);
}

TEST_F(WorkingMemories, StopForwardingWhenNobodyWantsItAnyMore) {
  auto& one = listen();
  auto& two = listen();
  subscribe(one, "b", 1, any_change().in("a"));
  subscribe(two, "b", 5, any_change().in("a"));
  caf::send_as(one.actor, wm.at("b"), Unsubscribe{1});
  scheduler.run();
  add({"a", "x"});
  EXPECT_TRUE(one.notices.empty());
  EXPECT_EQ(two.notices.size(), 1u);
  // The other leaves by dying.
  caf::anon_send_exit(two.actor, caf::exit_reason::user_shutdown);
  scheduler.run();
  EXPECT_EQ(status("b").filters, 0u);
  add({"a", "y"});
  EXPECT_EQ(status("a").forwarded, 1u);
}

TEST_F(WorkingMemories, LetAFilterBeReplacedUnderItsId) {
  auto& listener = listen();
  subscribe(listener, "a", 1, added<Item>());
  subscribe(listener, "a", 1, deleted<Item>());
  add({"a", "x"});
  remove({"a", "x"});
  EXPECT_EQ(told(listener), (Told{"DELETE a/x"}));
  EXPECT_EQ(status("a").filters, 1u);
}

TEST_F(WorkingMemories, HandOperationsOnToTheirOwner) {
  ASSERT_TRUE(write("a", {Operation::add, {"b", "x"}, Value::of(Item{4}), {}, {}}));
  auto entry = ask<Outcome<EntryPtr>>(wm.at("c"), ReadRequest{{"b", "x"}, {}});
  ASSERT_TRUE(entry);
  EXPECT_EQ((*entry)->value.as<Item>()->number, 4);
  EXPECT_EQ((*entry)->address, (Address{"b", "x"}));
  EXPECT_TRUE(*ask<Outcome<bool>>(wm.at("c"), ExistsQuery{{"b", "x"}}));
  EXPECT_EQ(*ask<Outcome<Version>>(wm.at("c"), VersionQuery{{"b", "x"}}), 0u);
  EXPECT_EQ(
    ask<Outcome<std::vector<EntryPtr>>>(wm.at("c"), QueryRequest{{"b", "Item", 0, false}, {}})
      ->size(),
    1u);
}

TEST_F(WorkingMemories, KeepWritersOutThatAreNotAllowed) {
  auto refused = write("c", {Operation::add, {"b", "x"}, Value::of(Item{}), {}, {}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().kind, FailureKind::not_permitted);
  EXPECT_NE(refused.failure().message.find("tester of c"), std::string::npos);
  EXPECT_NE(refused.failure().message.find("ACCESS c WRITES b"), std::string::npos);
}

TEST_F(WorkingMemories, NameTheSubarchitecturesThereAre) {
  auto outcome = ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{{"vison", "x"}, {}});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.failure().kind, FailureKind::unknown_subarchitecture);
  EXPECT_NE(outcome.failure().message.find("a, b, c"), std::string::npos);
}

TEST_F(WorkingMemories, StampEventsWithTimeSinceTheEpoch) {
  auto& listener = listen();
  subscribe(listener, "a", 1, any_change());
  scheduler.advance_time(1500ms);
  add({"a", "x"});
  EXPECT_EQ(listener.notices.at(0).event->time, 1500ms);
}

TEST_F(WorkingMemories, IgnoreWhatTheyWereToldToIgnore) {
  WorkingMemoryOptions options;
  options.subarchitecture = "deaf";
  options.ignored = {"deaf"};
  wm["deaf"] = system.spawn(working_memory, options);
  auto& listener = listen();
  subscribe(listener, "deaf", 1, any_change());
  ASSERT_TRUE(add({"deaf", "x"}));
  EXPECT_TRUE(listener.notices.empty());
}

TEST_F(WorkingMemories, CountWhatTheyDo) {
  auto& listener = listen();
  subscribe(listener, "a", 1, any_change());
  add({"a", "x"});
  add({"a", "y"});
  remove({"a", "y"});
  auto x = status("a");
  EXPECT_EQ(x.entries, 1u);
  EXPECT_EQ(x.entries_by_type, (std::map<std::string, std::uint64_t>{{"Item", 1}}));
  EXPECT_EQ(x.events, 3u);
  EXPECT_EQ(x.delivered, 3u);
}

TEST_F(WorkingMemories, SayThatThereIsAnEntryEvenIfItIsLeased) {
  add({"a", "x"});
  auto holder = std::make_shared<const Client>(Client{"holder", "a"});
  ASSERT_TRUE(ask<Outcome<Lease>>(wm.at("a"), LockRequest{{"a", "x"}, LockLevel::o, {holder, 1}}));
  EXPECT_EQ(add({"a", "x"}).failure().kind, FailureKind::already_exists);
}

} // namespace

} // namespace castor::test
