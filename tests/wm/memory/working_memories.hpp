#pragma once

#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Working memory actors on CAF's test coordinator.
namespace castor::test {

using namespace std::chrono_literals;

struct Item {
  int number = 0;
};
CASTOR_REFLECT(Item, number)

struct FlaggedItem : Item {
  bool on = false;
};
CASTOR_REFLECT_DERIVED(FlaggedItem, Item, on)

/// What a stand-in for a component received.
struct Listener {
  caf::actor actor;
  std::vector<ChangeNotice> notices;
  int subscribed = 0;
  /// How often several came in one piece.
  int batches = 0;
};

/// Working memories of the subarchitectures a, b and c.
class WorkingMemories : public testing::Test, protected simulation::TestingSystem {
protected:
  WorkingMemories() {
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
    auto result = answer_of<Reply>(to, request);
    if (!result)
      throw std::runtime_error(system.render(result.error()));
    return *std::move(result);
  }

  Outcome<Version> write(const std::string& via, WriteRequest request) {
    request.client = std::make_shared<const Client>(Client{"tester", via});
    return ask<Outcome<Version>>(wm.at(via), request);
  }

  Outcome<Version> add(const Address& at, int number = 0) {
    return write(at.subarchitecture, {Operation::add, at, Value::of(Item{number}), {}, {}});
  }

  Outcome<Version> overwrite(const Address& at, std::optional<Version> last_seen, int number = 0) {
    return write(at.subarchitecture,
                 {Operation::overwrite, at, Value::of(Item{number}), last_seen, {}});
  }

  Outcome<Version> remove(const Address& at) {
    return write(at.subarchitecture, {Operation::remove, at, {}, {}, {}});
  }

  Listener& listen() {
    auto& result = *listeners.emplace_back(std::make_unique<Listener>());
    result.actor = system.spawn([&result](caf::event_based_actor*) -> caf::behavior {
      return {[&result](const ChangeNotice& x) { result.notices.push_back(x); },
              [&result](const ChangeNotices& x) {
                ++result.batches;
                result.notices.insert(result.notices.end(), x.notices.begin(), x.notices.end());
              },
              [&result](const Outcome<Acknowledged>&) { ++result.subscribed; }};
    });
    return result;
  }

  void subscribe(Listener& who, const std::string& at, FilterId id, const ChangeFilter& filter,
                 std::uint32_t queue_limit = standard_queue_limit) {
    caf::send_as(who.actor, wm.at(at), Subscribe{id, filter, EventStream::component, queue_limit});
    scheduler.run();
  }

  /// The stand-in says that it has taken so many events.
  void take(Listener& who, const std::string& at, std::uint64_t count,
            EventStream stream = EventStream::component) {
    caf::send_as(who.actor, wm.at(at), EventsTaken{stream, count});
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

  std::map<std::string, WorkingMemoryActor> wm;
  std::vector<std::unique_ptr<Listener>> listeners;
};

using Told = std::vector<std::string>;

} // namespace castor::test
