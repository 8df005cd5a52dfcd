#include "castor/tests/wm/memory/working_memories.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::test {

namespace {

/// Working memories one of which is started again.
class ReplacedPeers : public WorkingMemories {
protected:
  /// Another working memory of that name, which knows the others but not they it.
  WorkingMemoryActor make_successor(const std::string& name) {
    WorkingMemoryOptions options;
    options.subarchitecture = name;
    options.epoch = scheduler.clock().now();
    options.writers = {"*"};
    options.incarnation = ++incarnation;
    auto result = system.spawn(working_memory, options);
    auto now = peers();
    now.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(result);
    ask<Acknowledged>(result, now);
    return result;
  }

  /// What carries events to another process.
  struct Way {
    caf::actor actor;
    std::vector<RoutedEvent> events;
  };

  ~ReplacedPeers() override {
    for (auto& x : ways)
      caf::anon_send_exit(x->actor, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  Way& way() {
    auto& result = *ways.emplace_back(std::make_unique<Way>());
    result.actor = system.spawn([&result](caf::event_based_actor*) -> caf::behavior {
      return {[&result](const RoutedEvents& x) {
        result.events.insert(result.events.end(), x.events.begin(), x.events.end());
      }};
    });
    return result;
  }

  static Told carried(const Way& x) {
    Told result;
    for (auto& [event, receivers] : x.events)
      for (auto& [subarchitecture, interests] : receivers)
        result.push_back(std::string{to_string(event->operation)} + ' ' +
                         to_string(event->address) + " to " + subarchitecture);
    return result;
  }

  /// From now on the working memory is one that lives in another process, as far as the others
  /// know.
  void reach(const std::string& name, Way& by) {
    routes[name] = by.actor;
    replace(name, make_successor(name));
  }

  Peers peers() const {
    Peers result;
    for (auto& [name, actor] : routes)
      result.routes[name] = caf::actor_cast<caf::strong_actor_ptr>(actor);
    for (auto& [name, actor] : wm)
      result.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(actor);
    return result;
  }

  /// Puts it in the place of the one that was there, which ends.
  void replace(const std::string& name, const WorkingMemoryActor& successor) {
    caf::anon_send_exit(wm.at(name), caf::exit_reason::user_shutdown);
    wm[name] = successor;
    auto now = peers();
    for (auto& [other, actor] : wm)
      if (other != name)
        ask<Acknowledged>(actor, now);
  }

  std::uint64_t incarnation = 1;
  std::vector<std::unique_ptr<Way>> ways;
  /// To those that live in other processes.
  std::map<std::string, caf::actor> routes;
};

TEST_F(ReplacedPeers, AreToldWhatWasWantedOfThoseBefore) {
  auto& anywhere = listen();
  auto& there = listen();
  subscribe(anywhere, "a", 1, added<Item>().anywhere());
  subscribe(there, "a", 2, added<Item>().in("b"));
  add({"b", "x"});
  replace("b", make_successor("b"));
  add({"b", "x"});
  EXPECT_EQ(told(anywhere), (Told{"ADD b/x", "ADD b/x"}));
  EXPECT_EQ(told(there), told(anywhere));
  EXPECT_EQ(there.notices.back().event->version, Version{1} << 32);
}

TEST_F(ReplacedPeers, HearWhatTheyHaveAskedForBeforeTheyWereIntroduced) {
  auto successor = make_successor("b");
  auto& early = listen();
  caf::send_as(early.actor, successor, Subscribe{1, added<Item>().in("a")});
  scheduler.run();
  EXPECT_EQ(early.subscribed, 1);
  replace("b", successor);
  add({"a", "x"});
  EXPECT_EQ(told(early), Told{"ADD a/x"});
}

TEST_F(ReplacedPeers, HearNothingThatOnlyTheOneBeforeHasAskedFor) {
  auto& former = listen();
  subscribe(former, "b", 1, added<Item>().in("a"));
  auto successor = make_successor("b");
  auto& later = listen();
  caf::send_as(later.actor, successor, Subscribe{1, deleted<Item>().in("a")});
  scheduler.run();
  replace("b", successor);
  add({"a", "x"});
  remove({"a", "x"});
  EXPECT_EQ(told(later), Told{"DELETE a/x"});
}

TEST_F(ReplacedPeers, TakeNoEventsThatWereOnTheirWayToTheOneBefore) {
  // The first interest of a first life.
  constexpr InterestId first = 1;
  auto& later = listen();
  auto successor = make_successor("b");
  caf::send_as(later.actor, successor, Subscribe{1, deleted<Item>().in("a")});
  scheduler.run();
  auto event = std::make_shared<ChangeEvent>();
  event->operation = Operation::add;
  event->address = {"a", "x"};
  caf::anon_send(successor, ChangeNotices{{{event, {first}}}});
  scheduler.run();
  EXPECT_EQ(told(later), Told{});
  replace("b", successor);
}

TEST_F(ReplacedPeers, AreReachedOnTheWayToTheirOwnProcess) {
  auto& former = way();
  auto& later = way();
  reach("b", former);
  auto& before = listen();
  subscribe(before, "b", 1, added<Item>().in("a"));
  add({"a", "x"});
  EXPECT_EQ(carried(former), Told{"ADD a/x to b"});
  auto successor = make_successor("b");
  routes["b"] = later.actor;
  replace("b", successor);
  add({"a", "y"});
  EXPECT_EQ(carried(later), Told{}) << "nobody there has asked for anything yet";
  auto& after = listen();
  subscribe(after, "b", 1, added<Item>().in("a"));
  add({"a", "z"});
  EXPECT_EQ(carried(later), Told{"ADD a/z to b"});
  EXPECT_EQ(carried(former), Told{"ADD a/x to b"});
}

TEST_F(ReplacedPeers, MayHaveTheWayOfTheOneBefore) {
  auto& to_there = way();
  reach("b", to_there);
  auto& before = listen();
  subscribe(before, "b", 1, added<Item>().in("a"));
  replace("b", make_successor("b"));
  auto& after = listen();
  subscribe(after, "b", 1, deleted<Item>().in("a"));
  add({"a", "x"});
  remove({"a", "x"});
  EXPECT_EQ(carried(to_there), Told{"DELETE a/x to b"});
}

TEST_F(ReplacedPeers, AnswerWhatIsAskedOfThemThroughOthers) {
  add({"b", "x"});
  replace("b", make_successor("b"));
  EXPECT_FALSE(*ask<Outcome<bool>>(wm.at("a"), ExistsQuery{{"b", "x"}}));
  EXPECT_TRUE(write("a", {Operation::add, {"b", "x"}, Value::of(Item{1}), {}, {}}));
  EXPECT_TRUE(*ask<Outcome<bool>>(wm.at("c"), ExistsQuery{{"b", "x"}}));
}

} // namespace

} // namespace castor::test
