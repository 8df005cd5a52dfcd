// Scorer, judge and binder over working memory, while monitors make up their minds at random and
// components fail: what comes of it is what BindingCore makes of the same proxies.
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/tests/binding/chance.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <set>
#include <string>

namespace castor::binding::test {

struct MonitorDone {
  std::string monitor;
};
CASTOR_REFLECT(MonitorDone, monitor)

namespace {

using namespace std::chrono_literals;
using Unions = std::map<std::string, BindingUnion>;

/// Tells of things and relations as chance has it, changes its mind, and takes back what it said.
class RandomMonitor final : public BindingMonitor {
  void start() override {
    BindingMonitor::start();
    // What a predecessor may have left is none of this one's words.
    for (auto& [id, x] : own_proxies())
      withdraw(id);
    publish();
  }

  void run() override {
    Chance chance{seed_};
    for (int change = 0; change < changes_; ++change) {
      auto id = proxy_id(chance.below(proxies_));
      if (chance.once_in(4)) {
        withdraw(id);
      } else {
        auto proxy = chance.some_proxy(proxies_);
        for (auto& port : proxy.out_ports)
          port.proxy = "m" + std::to_string(1 + chance.below(2)) + port.proxy;
        tell(id, std::move(proxy));
      }
      if (chance.once_in(2))
        publish();
      if (!sleep_for(std::chrono::microseconds{chance.below(2000)}))
        return;
    }
    publish();
    add(MonitorDone{component_name()});
  }

  std::string proxy_id(int number) const { return component_name() + Chance::id(number); }

  Option<int> seed_{this, "seed", 1, "what chance begins with"};
  Option<int> proxies_{this, "proxies", 6, "how many there are at most"};
  Option<int> changes_{this, "changes", 60, "how often it changes its mind"};
};

CASTOR_COMPONENT(RandomMonitor, "tells binding something at random")

std::string with_monitors(int seed) {
  auto number = [](int x) { return std::to_string(x); };
  return "HOST localhost\n"
         "SUBARCHITECTURE binding\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM scorer BindingScorer\n"
         "CPP UM judge BindingJudge\n"
         "CPP UM binder Binder --tombstones 100ms\n"
         "SUBARCHITECTURE one\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM m1 RandomMonitor --seed " +
         number(2 * seed) +
         "\n"
         "SUBARCHITECTURE two\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM m2 RandomMonitor --seed " +
         number(2 * seed + 1) +
         "\n"
         "ACCESS one WRITES binding\n"
         "ACCESS two WRITES binding\n"
         "SUPERVISE * RESTARTS 1000 IN 10s\n";
}

/// The content of the binding working memory.
struct Content {
  Unions unions;
  Proxies proxies;
  /// Proxies that there are scores or judgements of.
  std::set<std::string> described;
  int deletions = 0;
};

Content content_of(TestSystem& system) {
  Content result;
  for (auto& entry : system.system().entries("binding")) {
    if (auto x = entry->value.as<BindingUnion>())
      result.unions[entry->address.id] = *x;
    else if (auto proxy = entry->value.as<BindingProxy>())
      result.proxies[entry->address.id] = *proxy;
    else if (auto scores = entry->value.as<ProxyUnionScores>())
      result.described.insert(scores->proxy);
    else if (auto best = entry->value.as<BestUnionsForProxy>())
      result.described.insert(best->proxy);
    else if (auto ambiguity = entry->value.as<Ambiguity>())
      result.described.insert(ambiguity->proxy);
    else if (entry->value.as<BindingProxyDeletionTask>())
      ++result.deletions;
  }
  return result;
}

Unions canonical(const Proxies& proxies) {
  BindingCore core;
  for (auto& [id, x] : proxies)
    core.set(id, x);
  return without_counters(core.unions());
}

std::string members(const Unions& unions, const std::string& id) {
  auto found = unions.find(id);
  if (found == unions.end())
    return "nothing";
  std::string result;
  for (auto& proxy : found->second.proxy_ids)
    result += (result.empty() ? "" : ", ") + proxy;
  return result;
}

std::string difference(const Unions& there, const Unions& wanted) {
  std::set<std::string> ids;
  for (auto* unions : {&there, &wanted})
    for (auto& [id, x] : *unions)
      ids.insert(id);
  std::string result;
  for (auto& id : ids)
    if (members(there, id) != members(wanted, id))
      result += "\n" + id + " is " + members(there, id) + " and not " + members(wanted, id);
  return result.empty() ? "the same members say something else" : result;
}

/// Empty if binding is through with what it was told.
std::string what_is_wrong(const Content& x) {
  if (x.deletions > 0)
    return "something is still to be deleted";
  if (auto wanted = canonical(x.proxies); without_counters(x.unions) != wanted)
    return "the unions are not what they have to be: " + difference(x.unions, wanted);
  for (auto& [id, proxy] : x.proxies) {
    auto in = x.unions.find(proxy.union_id);
    if (in == x.unions.end() || proxy.proxy_ids != in->second.proxy_ids)
      return id + " does not know where it is";
  }
  for (auto& id : x.described)
    if (!x.proxies.contains(id))
      return id + " is gone, but what was said of it is not";
  return {};
}

void expect_binding_to_end_well(TestSystem& system) {
  system.expect_entry("MonitorDone in one", 60s);
  system.expect_entry("MonitorDone in two", 60s);
  Content last;
  try {
    system.wait_until("the unions are what they have to be", [&] {
      last = content_of(system);
      return what_is_wrong(last).empty();
    });
  } catch (const ExpectationFailed& e) {
    FAIL() << e.what() << '\n' << what_is_wrong(last);
  }
  EXPECT_GT(last.proxies.size(), 3u);
  system.expect_entry("BinderStatus in binding where stable");
}

class BindingSystem : public testing::TestWithParam<int> {};

TEST_P(BindingSystem, EndsWithTheUnionsOfTheCore) {
  TestSystem system{with_monitors(GetParam())};
  expect_binding_to_end_well(system);
  system.expect_nobody_else_down();
}

TEST_P(BindingSystem, EndsWithThemWhoeverFails) {
  TestSystem system{with_monitors(100 + GetParam())};
  std::uint64_t life = 1;
  for (int round = 0; round < 3; ++round) {
    ++life;
    for (auto* name : {"scorer", "judge", "binder", "m1"}) {
      system.inject(std::string{"crash "} + name);
      system.expect_back(name, life);
    }
  }
  expect_binding_to_end_well(system);
}

TEST_P(BindingSystem, EndsWithThemWhenItsWorkingMemoryIsLost) {
  TestSystem system{with_monitors(200 + GetParam())};
  system.inject("crash binding_wm");
  system.expect_back("scorer");
  expect_binding_to_end_well(system);
}

INSTANTIATE_TEST_SUITE_P(, BindingSystem, testing::Range(1, 4));

} // namespace

} // namespace castor::binding::test
