#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/planning/motivation/motive_file.hpp"
#include "castor/planning/motivation/occasions.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;

bool is_over(const Motive& x) {
  return x.status == MotiveStatus::completed || x.status == MotiveStatus::rejected ||
         x.status == MotiveStatus::dropped;
}

/// Proposes motives that facts of contributors, or idleness, occasion.
class FactMotives final : public ManagedComponent {
  void configure() override { occasions_.emplace(load_motives(file_), again_.get()); }

  void run() override {
    do
      look();
    while (sleep_for(period_.get()));
  }

  void look() {
    std::vector<std::string> facts;
    for (const auto& name : contributors_.get()) {
      try {
        auto reply = call<StateRequest, StateReply>(name, {}, {.timeout = patience_.get()});
        facts.insert(facts.end(), reply.facts.begin(), reply.facts.end());
      } catch (const WorkingMemoryException& e) {
        // What is not known now has not become false.
        warning("{} did not say what it knows: {}", name, e.what());
        return;
      }
    }
    const auto motives = read_all<Motive>();
    const auto is_open = [](const EntryOf<Motive>& x) { return !is_over(*x); };
    const bool is_idle = std::ranges::none_of(motives, is_open);
    for (auto& x : occasions_->look(facts, is_idle, now())) {
      // A predecessor may have proposed it.
      const auto is_same = [&](const EntryOf<Motive>& y) {
        return is_open(y) && y->kind == x.kind && y->goal.goal == x.goal.goal;
      };
      if (std::ranges::none_of(motives, is_same))
        add(std::move(x));
    }
  }

  Option<std::string> file_{this, "motives", "", "file of motives"};
  Option<std::vector<std::string>> contributors_{
    this, "contributors", {}, "subarchitectures that are asked what they know"};
  Option<std::chrono::milliseconds> period_{this, "period", 1s, "how often it asks"};
  Option<std::chrono::milliseconds> again_{
    this, "again", 1min, "when facts that are still true occasion their motive again; 0s: never"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 2s,
                                              "how long it waits for a contributor"};

  std::optional<Occasions> occasions_;
};

CASTOR_COMPONENT(FactMotives, "proposes motives that facts or idleness occasion")

} // namespace

} // namespace castor::planning
