#include "castor/actors/cast/parser.hpp"
#include "castor/actors/supervision/supervision_tree.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using Kind = SupervisionDecision::Kind;

/// Two subarchitectures with rules as chance has it.
ArchitectureDescription random_system() {
  std::string text;
  for (auto name : {"a", "b"}) {
    text += "SUBARCHITECTURE " + std::string{name} + "\nCPP WM W\nCPP TM T\n";
    for (int i = 0; i < 3; ++i)
      text += "CPP " + *rc::gen::element<std::string>("MG ", "UM ") + name + std::to_string(i) +
              " C --restart " +
              *rc::gen::element<std::string>("permanent", "transient", "temporary") + '\n';
  }
  text += "COMPONENT CPP camera C\n";
  for (auto who : {"a", "b", "SYSTEM"})
    text += "SUPERVISE " + std::string{who} + ' ' +
            *rc::gen::element<std::string>("one_for_one", "one_for_all", "rest_for_one") +
            " RESTARTS " + std::to_string(*rc::gen::inRange(0, 4)) + " IN " +
            std::to_string(*rc::gen::inRange(1, 20)) + "s\n";
  return *cast::parse_string(text, "test.cast").architecture;
}

bool is_in_order(const std::vector<std::string>& some, const std::vector<std::string>& all) {
  auto from = all.begin();
  for (auto& x : some) {
    from = std::find(from, all.end(), x);
    if (from == all.end())
      return false;
  }
  return true;
}

RC_GTEST_PROP(SupervisionTreeProperties, DecidesWithinItsLimits, ()) {
  auto architecture = random_system();
  SupervisionTree tree{*rc::gen::arbitrary<std::uint64_t>()};
  tree.set(architecture);
  Timestamp now{0};
  std::vector<Timestamp> restarts;
  auto steps = *rc::gen::inRange(1, 60);
  for (int i = 0; i < steps; ++i) {
    now += std::chrono::milliseconds{*rc::gen::inRange(0, 3000)};
    auto name = *rc::gen::elementOf(tree.order());
    auto type = tree.restart_type(name);
    auto decision = tree.failed(name, now);
    RC_ASSERT((decision.kind == Kind::leave) == (type == RestartType::temporary));
    if (decision.kind == Kind::leave)
      continue;
    RC_ASSERT(is_in_order(decision.stop, tree.order()));
    RC_ASSERT(is_in_order(decision.start, decision.stop));
    if (decision.kind == Kind::give_up)
      return;
    RC_ASSERT(std::count(decision.start.begin(), decision.start.end(), name) == 1);
    // A working memory never comes back alone: what the others know is about the old one.
    for (auto& x : architecture.subarchitectures)
      if (std::count(decision.stop.begin(), decision.stop.end(), x.working_memory.name))
        for (auto& y : x.components)
          RC_ASSERT(std::count(decision.stop.begin(), decision.stop.end(), y.name) == 1);
    restarts.push_back(now);
  }
  // No more than all supervisors together allow.
  std::size_t allowed = 0;
  for (auto who : {"a", "b", "SYSTEM"}) {
    auto policy = architecture.supervision_of(who);
    auto system = architecture.supervision_of("SYSTEM");
    auto periods = static_cast<std::size_t>(now / Timestamp{policy.period}) + 1;
    auto fresh_starts =
      system.restarts * (static_cast<std::size_t>(now / Timestamp{system.period}) + 1);
    allowed += policy.restarts * (periods + fresh_starts);
  }
  RC_ASSERT(restarts.size() <= allowed);
}

} // namespace

} // namespace castor::test
