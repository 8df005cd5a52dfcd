#include "castor/tests/wm/memory/working_memories.hpp"

#include <gtest/gtest.h>

#include <string>

/// Working memories that join a running system, and those that leave it.
namespace castor::test {

namespace {

class ChangingSystems : public WorkingMemories {
protected:
  void spawn(const std::string& name) {
    WorkingMemoryOptions options;
    options.subarchitecture = name;
    options.epoch = scheduler.clock().now();
    wm[name] = system.spawn(working_memory, options);
  }

  Peers peers(const std::set<std::string>& writers = {}) const {
    Peers result;
    for (auto& [name, actor] : wm)
      result.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(actor);
    result.writers = writers;
    return result;
  }

  void introduce_all() {
    auto all = peers();
    for (auto& [name, actor] : wm)
      ask<Acknowledged>(actor, all);
  }

  void remove_subarchitecture(const std::string& name) {
    caf::anon_send_exit(wm.at(name), caf::exit_reason::user_shutdown);
    wm.erase(name);
    introduce_all();
  }
};

TEST_F(ChangingSystems, FiltersForAllSubarchitecturesHoldForNewOnes) {
  auto& in_a = listen();
  subscribe(in_a, "a", 1, any_change().anywhere());
  spawn("d");
  introduce_all();
  ASSERT_TRUE(add({"d", "x"}));
  EXPECT_EQ(told(in_a), (Told{"ADD d/x"}));
  EXPECT_EQ(status("d").forwarded, 1u);
}

TEST_F(ChangingSystems, ANewOneIsAskedForEventsBeforeItWasIntroduced) {
  auto& in_a = listen();
  subscribe(in_a, "a", 1, any_change().anywhere());
  spawn("d");
  auto all = peers();
  auto told_a = outsider->request(wm.at("a"), caf::infinite, all);
  scheduler.run();
  told_a.receive([](Acknowledged) {}, [&](const caf::error& e) { FAIL() << system.render(e); });
  for (auto name : {"b", "c", "d"})
    ask<Acknowledged>(wm.at(name), all);
  add({"d", "x"});
  EXPECT_EQ(told(in_a), (Told{"ADD d/x"}));
}

TEST_F(ChangingSystems, IntroductionsAreAnsweredEvenIfTheNewOneHasEnded) {
  subscribe(listen(), "a", 1, any_change().anywhere());
  spawn("d");
  auto all = peers();
  caf::anon_send_exit(wm.at("d"), caf::exit_reason::kill);
  scheduler.run();
  ask<Acknowledged>(wm.at("a"), all);
}

TEST_F(ChangingSystems, WhatWasRemovedIsUnknown) {
  remove_subarchitecture("c");
  auto outcome = ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{{"c", "x"}, {}});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.failure().kind, FailureKind::unknown_subarchitecture);
  EXPECT_EQ(outcome.failure().message, "there is no subarchitecture c; there are: a, b");
}

TEST_F(ChangingSystems, NothingIsForwardedToWhatWasRemoved) {
  subscribe(listen(), "c", 1, any_change().anywhere());
  add({"a", "x"});
  remove_subarchitecture("c");
  add({"a", "y"});
  EXPECT_EQ(status("a").forwarded, 1u);
}

TEST_F(ChangingSystems, ANameMayComeAgain) {
  auto& in_a = listen();
  subscribe(in_a, "a", 1, any_change().in("c"));
  add({"c", "old"});
  remove_subarchitecture("c");
  spawn("c");
  introduce_all();
  auto& in_c = listen();
  subscribe(in_c, "c", 1, any_change().anywhere());
  add({"c", "new"});
  add({"a", "x"});
  EXPECT_EQ(told(in_a), (Told{"ADD c/old", "ADD c/new"}));
  EXPECT_EQ(told(in_c), (Told{"ADD c/new", "ADD a/x"}));
  EXPECT_FALSE(*ask<Outcome<bool>>(wm.at("a"), ExistsQuery{{"c", "old"}}));
}

TEST_F(ChangingSystems, WritersMayBeAdded) {
  WriteRequest request{Operation::add, {"c", "x"}, Value::of(Item{}), {}, {}};
  EXPECT_EQ(write("a", request).failure().kind, FailureKind::not_permitted);
  ask<Acknowledged>(wm.at("c"), peers({"a"}));
  EXPECT_TRUE(write("a", request));
}

} // namespace

} // namespace castor::test
