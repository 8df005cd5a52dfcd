#include "castor/wm/working_memory.hpp"

#include <caf/scheduler/test_coordinator.hpp>
#include <caf/scoped_actor.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

struct Thing {
  int number = 0;
};
CASTOR_REFLECT(Thing, number)

struct Gadget : Thing {
  bool on = false;
};
CASTOR_REFLECT_DERIVED(Gadget, Thing, on)

struct TestConfig : caf::actor_system_config {
  TestConfig() { set("scheduler.policy", caf::atom("testing")); }
};

/// What a stand-in for a component received.
struct Listener {
  caf::actor actor;
  std::vector<ChangeNotice> notices;
  int subscribed = 0;
};

/// Working memories of the subarchitectures a, b and c on CAF's test coordinator: nothing runs but
/// when the test says so, and time passes only there.
class WorkingMemories : public testing::Test {
protected:
  WorkingMemories()
    : scheduler(dynamic_cast<caf::scheduler::test_coordinator&>(system.scheduler())) {
    Peers peers;
    for (auto name : {"a", "b", "c"}) {
      WorkingMemoryOptions options;
      options.subarchitecture = name;
      options.epoch = scheduler.clock().now();
      if (name == std::string{"b"})
        options.writers = {"a"};
      wm[name] = system.spawn(working_memory, options);
      peers.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(wm[name]);
    }
    for (auto& [name, actor] : wm)
      ask<Acknowledged>(actor, peers);
  }

  ~WorkingMemories() override {
    for (auto& x : listeners)
      caf::anon_send_exit(x->actor, caf::exit_reason::user_shutdown);
    for (auto& [name, actor] : wm)
      caf::anon_send_exit(actor, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  template <class Reply, class Request>
  Reply ask(const WorkingMemoryActor& to, const Request& request) {
    std::optional<Reply> result;
    auto handle = self->request(to, caf::infinite, request);
    scheduler.run();
    handle.receive([&](const Reply& x) { result = x; },
                   [&](const caf::error& e) { ADD_FAILURE() << system.render(e); });
    return result.value();
  }

  Outcome<Version> write(const std::string& via, WriteRequest request) {
    request.client = std::make_shared<const Client>(Client{"tester", via});
    return ask<Outcome<Version>>(wm.at(via), request);
  }

  Outcome<Version> add(const Address& at, int number = 0) {
    return write(at.subarchitecture, {Operation::add, at, Value::of(Thing{number}), {}, {}});
  }

  Outcome<Version> overwrite(const Address& at, std::optional<Version> last_seen, int number = 0) {
    return write(at.subarchitecture,
                 {Operation::overwrite, at, Value::of(Thing{number}), last_seen, {}});
  }

  Outcome<Version> remove(const Address& at) {
    return write(at.subarchitecture, {Operation::remove, at, {}, {}, {}});
  }

  Listener& listen() {
    auto& result = *listeners.emplace_back(std::make_unique<Listener>());
    result.actor = system.spawn([&result](caf::event_based_actor*) -> caf::behavior {
      return {[&result](const ChangeNotice& x) { result.notices.push_back(x); },
              [&result](const Outcome<Acknowledged>&) { ++result.subscribed; },
              [](const Outcome<Lease>&) {}};
    });
    return result;
  }

  void subscribe(Listener& who, const std::string& at, FilterId id, const ChangeFilter& filter) {
    caf::send_as(who.actor, wm.at(at), Subscribe{id, filter});
    scheduler.run();
  }

  static std::vector<std::string> told(const Listener& x) {
    std::vector<std::string> result;
    for (auto& notice : x.notices)
      result.push_back(std::string{to_string(notice.event->operation)} + ' ' +
                       to_string(notice.event->address));
    return result;
  }

  WorkingMemoryStatus status(const std::string& name) {
    return ask<WorkingMemoryStatus>(wm.at(name), StatusQuery{});
  }

  TestConfig config;
  caf::actor_system system{config};
  caf::scheduler::test_coordinator& scheduler;
  caf::scoped_actor self{system};
  std::map<std::string, WorkingMemoryActor> wm;
  std::vector<std::unique_ptr<Listener>> listeners;
};

using Told = std::vector<std::string>;

TEST_F(WorkingMemories, TellOwnComponentsOfWhatTheyAskedFor) {
  auto& all = listen();
  auto& deletions = listen();
  subscribe(all, "a", 1, any_change());
  subscribe(deletions, "a", 1, deleted<Thing>());
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
  subscribe(listener, "a", 2, changed<Thing>());
  subscribe(listener, "a", 3, deleted<Thing>());
  add({"a", "x"});
  ASSERT_EQ(listener.notices.size(), 1u);
  EXPECT_EQ(listener.notices[0].filters, (std::vector<FilterId>{1, 2}));
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
  subscribe(in_b, "b", 1, changed<Thing>().anywhere());
  subscribe(also_in_b, "b", 1, changed<Thing>().anywhere());
  subscribe(in_c, "c", 1, changed<Thing>().in("b"));
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
  subscribe(in_b, "b", 1, added<Thing>().in("a"));
  write("a", {Operation::add, {"a", "g"}, Value::of(Gadget{}), {}, {}});
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
  subscribe(listener, "a", 1, added<Thing>());
  subscribe(listener, "a", 1, deleted<Thing>());
  add({"a", "x"});
  remove({"a", "x"});
  EXPECT_EQ(told(listener), (Told{"DELETE a/x"}));
  EXPECT_EQ(status("a").filters, 1u);
}

TEST_F(WorkingMemories, HandOperationsOnToTheirOwner) {
  ASSERT_TRUE(write("a", {Operation::add, {"b", "x"}, Value::of(Thing{4}), {}, {}}));
  auto entry = ask<Outcome<EntryPtr>>(wm.at("c"), ReadRequest{{"b", "x"}, {}});
  ASSERT_TRUE(entry);
  EXPECT_EQ((*entry)->value.as<Thing>()->number, 4);
  EXPECT_EQ((*entry)->address, (Address{"b", "x"}));
  EXPECT_TRUE(*ask<Outcome<bool>>(wm.at("c"), ExistsQuery{{"b", "x"}}));
  EXPECT_EQ(*ask<Outcome<Version>>(wm.at("c"), VersionQuery{{"b", "x"}}), 0u);
  EXPECT_EQ(
    ask<Outcome<std::vector<EntryPtr>>>(wm.at("c"), QueryRequest{{"b", "Thing", 0, false}, {}})
      ->size(),
    1u);
}

TEST_F(WorkingMemories, KeepWritersOutThatAreNotAllowed) {
  auto refused = write("c", {Operation::add, {"b", "x"}, Value::of(Thing{}), {}, {}});
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
  EXPECT_EQ(x.entries_by_type, (std::map<std::string, std::uint64_t>{{"Thing", 1}}));
  EXPECT_EQ(x.events, 3u);
  EXPECT_EQ(x.delivered, 3u);
}

TEST_F(WorkingMemories, SayThatThereIsAnEntryEvenIfItIsLeased) {
  add({"a", "x"});
  auto holder = std::make_shared<const Client>(Client{"holder", "a"});
  ASSERT_TRUE(ask<Outcome<Lease>>(wm.at("a"), LockRequest{{"a", "x"}, LockLevel::o, {holder, 1}}));
  EXPECT_EQ(add({"a", "x"}).failure().kind, FailureKind::already_exists);
}

TEST_F(WorkingMemories, LetReadersGoOnWhenTheHolderDies) {
  add({"a", "x"}, 7);
  auto& holder = listen();
  auto client = [](const char* name) { return std::make_shared<const Client>(Client{name, "a"}); };
  caf::send_as(holder.actor, wm.at("a"),
               LockRequest{{"a", "x"}, LockLevel::odr, {client("holder"), 1}});
  auto answer =
    self->request(wm.at("a"), caf::infinite, ReadRequest{{"a", "x"}, {client("reader"), 1, 1s}});
  scheduler.run();
  ASSERT_EQ(status("a").waiting, 1u);
  caf::anon_send_exit(holder.actor, caf::exit_reason::kill);
  scheduler.run();
  ASSERT_EQ(status("a").waiting, 0u);
  answer.receive([](const Outcome<EntryPtr>& x) { EXPECT_TRUE(x); },
                 [](const caf::error&) { ADD_FAILURE(); });
}

} // namespace

} // namespace castor
