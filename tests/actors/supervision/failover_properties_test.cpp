#include "castor/actors/supervision/failover.hpp"
#include "castor/tests/actors/node/support.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using Names = std::vector<std::string>;

constexpr int hosts = 4;

std::string host(int i) {
  return "host" + std::to_string(i);
}

/// Components at random hosts, some of which may move to others.
ArchitectureDescription random_architecture() {
  std::string text;
  for (int i = 1; i <= 8; ++i) {
    auto name = "c" + std::to_string(i);
    text += "COMPONENT " + host(*rc::gen::inRange(1, hosts + 1)) + " CPP " + name + " C\n";
    auto others = *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(0, 3),
                                                        rc::gen::inRange(1, hosts + 1));
    if (others.empty())
      continue;
    text += "FAILOVER " + name + " TO";
    for (auto x : others)
      text += ' ' + host(x);
    text += '\n';
  }
  return architecture(text);
}

/// Processes that are lost and found at random, and a model of where everything is.
RC_GTEST_PROP(FailoverProperties, ChildrenOfALostProcessMoveOnceOrAwaitItsSuccessor, ()) {
  auto described = random_architecture();
  Placement placement;
  for (int i = 1; i <= hosts; ++i)
    placement.hosts[host(i)] = static_cast<ProcessNumber>(i);
  Names names;
  for (auto& x : described.standalone) {
    names.push_back(x.name);
    placement.of[x.name] = placement.hosts.at(x.host);
  }
  Failover failover;
  failover.set(placement);
  std::set<ProcessNumber> up{0, 1, 2, 3, 4};
  std::set<ProcessNumber> expected;
  std::map<std::string, ProcessNumber> where = placement.of;
  auto last = static_cast<ProcessNumber>(hosts);
  auto steps = *rc::gen::inRange(1, 40);
  for (int i = 0; i < steps; ++i) {
    if (!expected.empty() && *rc::gen::arbitrary<bool>()) {
      auto found =
        *rc::gen::elementOf(std::vector<ProcessNumber>(expected.begin(), expected.end()));
      expected.erase(found);
      up.insert(found);
      Names awaiting;
      for (auto& name : names)
        if (where.at(name) == found)
          awaiting.push_back(name);
      auto awaited = failover.take_awaited(found);
      RC_ASSERT((awaited ? awaited->names : Names{}) == awaiting);
      for (auto& name : awaiting)
        RC_ASSERT(!failover.is_between_processes(name));
      continue;
    }
    // Those that are expected may be lost as well, but not this one.
    std::vector<ProcessNumber> candidates(std::next(up.begin()), up.end());
    candidates.insert(candidates.end(), expected.begin(), expected.end());
    auto lost = *rc::gen::elementOf(candidates);
    up.erase(lost);
    expected.erase(lost);
    Names affected;
    for (auto& name : names)
      if (where.at(name) == lost)
        affected.push_back(name);
    auto loss =
      failover.lose(lost, affected, described, [&](ProcessNumber x) { return up.count(x) > 0; });
    Names all = loss.moved;
    all.insert(all.end(), loss.left.begin(), loss.left.end());
    std::sort(all.begin(), all.end());
    RC_ASSERT(all == affected);
    RC_ASSERT(loss.needs_successor || loss.left.empty());
    for (auto& name : loss.moved) {
      auto to = failover.process_of(name);
      RC_ASSERT(up.count(to) == 1);
      where[name] = to;
    }
    if (loss.needs_successor) {
      failover.set_successor(lost, ++last, {loss.left, {}});
      expected.insert(last);
      for (auto& name : loss.left)
        where[name] = last;
    }
    for (auto& name : names) {
      RC_ASSERT(failover.process_of(name) == where.at(name));
      RC_ASSERT(failover.is_awaited(name) == (expected.count(where.at(name)) == 1));
    }
    for (auto& [name, process] : failover.placement().hosts)
      RC_ASSERT(process != lost || !loss.needs_successor);
  }
}

} // namespace

} // namespace castor::test
