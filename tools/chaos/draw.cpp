#include "castor/tools/chaos/draw.hpp"

#include <stdexcept>
#include <utility>

namespace castor::faults {

namespace {

template <class Items>
const auto& one_of(const Items& items, SeededRandom& random) {
  if (items.empty())
    throw std::invalid_argument{"the system has no target of the kind that a fault needs"};
  return random.one_of(items);
}

class TargetDrawing {
public:
  TargetDrawing(const FaultTargets& targets, SeededRandom& random)
    : targets_(targets), random_(random) {}

  template <class T>
  void operator()(T& x) {
    if constexpr (requires { x.component; })
      draw(x.component);
    else if constexpr (requires { x.process; })
      draw(x.process);
    else if constexpr (requires { x.link; })
      draw(x.link);
  }

  void operator()(FailJournal& x) { draw_journal(x.memory); }
  void operator()(SlowJournal& x) { draw_journal(x.memory); }
  void operator()(RemoveJournal& x) { draw_journal(x.memory); }
  void operator()(ClaimJournal& x) { draw_journal(x.memory); }

  void operator()(JumpClock& x) {
    if (x.memory.is_any())
      x.memory.subarchitecture = one_of(targets_.subarchitectures, random_).name;
  }

private:
  void draw(ComponentTarget& x) {
    if (!x.is_any())
      return;
    std::vector<std::string> names;
    for (auto& y : targets_.components)
      if (y.is_any() && (x.subarchitecture.empty() || x.subarchitecture == y.subarchitecture))
        names.push_back(y.name);
    x = {one_of(names, random_), {}};
  }

  void draw(ProcessTarget& x) {
    if (x.is_any())
      x.name = one_of(targets_.nodes, random_);
  }

  void draw(LinkTarget& x) {
    if (!x.is_any())
      return;
    x.first = one_of(targets_.nodes, random_);
    std::vector<std::string> others{std::string{coordinator}};
    for (auto& y : targets_.nodes)
      if (y != x.first)
        others.push_back(y);
    x.second = random_.one_of(others);
  }

  void draw_journal(MemoryTarget& x) {
    if (!x.is_any())
      return;
    std::vector<std::string> names;
    for (auto& y : targets_.subarchitectures)
      if (y.has_journal)
        names.push_back(y.name);
    x.subarchitecture = one_of(names, random_);
  }

  const FaultTargets& targets_;
  SeededRandom& random_;
};

} // namespace

Fault draw_targets(Fault fault, const FaultTargets& targets, SeededRandom& random) {
  std::visit(TargetDrawing{targets, random}, fault);
  return fault;
}

} // namespace castor::faults
