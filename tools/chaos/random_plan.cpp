#include "castor/tools/chaos/random_plan.hpp"

#include "castor/tools/chaos/possible_faults.hpp"
#include "castor/tools/chaos/seeded_random.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace castor::faults {

namespace {

constexpr std::int64_t most_callbacks = 20;

/// Of the restarts that supervisors allow, those that faults have used.
class RestartBudget {
public:
  explicit RestartBudget(const FaultTargets& targets) : targets_(targets) {}

  /// Whether the supervisor of a component bears one more failure then.
  bool bears(const std::string& component, Timestamp at) const {
    auto supervisor = targets_.supervisor_of(component);
    auto failures = failures_.find(supervisor);
    if (failures == failures_.end())
      return targets_.limit_of(supervisor).restarts > 0;
    auto limit = targets_.limit_of(supervisor);
    // A failure may come some time after its fault: what is within two periods may be within one.
    auto recent = std::ranges::count_if(failures->second,
                                        [&](Timestamp x) { return at - x < 2 * limit.period; });
    return static_cast<std::uint64_t>(recent) < limit.restarts;
  }

  void spend(const std::string& component, Timestamp at) {
    failures_[targets_.supervisor_of(component)].push_back(at);
  }

private:
  const FaultTargets& targets_;
  std::map<std::string, std::vector<Timestamp>> failures_;
};

/// Whose failure a fault is, if it makes one.
std::string failing_component(const Fault& fault) {
  return std::visit(
    [](const auto& x) -> std::string {
      if constexpr (requires { x.memory; })
        return working_memory_of(x.memory.subarchitecture);
      else if constexpr (requires { x.component; })
        return x.component.name;
      else if constexpr (requires { x.process; })
        return x.process.name;
      else
        return {};
    },
    fault);
}

/// Draws one fault after the other.
class PlanDrawing {
public:
  PlanDrawing(const FaultTargets& targets, const RandomPlanOptions& options, SeededRandom& random)
    : targets_(targets), options_(options), random_(random), budget_(targets) {
    for (auto& kind : fault_kinds()) {
      if (options.failures_only && !kind.costs_restart)
        continue;
      Possible possible{&kind, {}};
      for (auto& fault : kind.for_each_target(targets))
        possible.faults.insert(possible.faults.end(), weight_of(kind, fault), fault);
      if (possible.faults.empty())
        continue;
      drawn_.insert(drawn_.end(), kind.weight, kinds_.size());
      kinds_.push_back(std::move(possible));
    }
  }

  bool has_any() const { return !kinds_.empty(); }

  /// A fault, and the crash that it needs. Nothing if what was drawn is more than a supervisor
  /// bears, again and again.
  std::vector<Fault> next(Timestamp at, Timestamp end) {
    constexpr int tries = 20;
    for (int i = 0; i < tries; ++i) {
      auto& [kind, faults] = kinds_[random_.one_of(drawn_)];
      auto fault = random_.one_of(faults);
      auto component = failing_component(fault);
      auto limited = (kind->costs_restart || kind->needs_crash) && options_.within_restart_limits;
      if (limited && !budget_.bears(component, at))
        continue;
      FaultDraws draws{random_, std::min(options_.longest, end - at),
                       callbacks_to_come(component, end - at)};
      kind->complete(fault, draws);
      if (limited)
        budget_.spend(component, at);
      if (kind->needs_crash)
        return {fault, Crash{{component, {}}}};
      return {fault};
    }
    return {};
  }

private:
  /// A kind, with its faults as often as they are to be drawn.
  struct Possible {
    const FaultKind* kind;
    std::vector<Fault> faults;
  };

  ComponentActivity activity_of(const std::string& component) const {
    auto i = options_.activity->find(component);
    return i == options_.activity->end() ? ComponentActivity{} : i->second;
  }

  /// From 0 to 8: coarse, so that it is the same from run to run.
  std::size_t weight_of(const FaultKind& kind, const Fault& fault) const {
    constexpr double per_minute = 60;
    if (!options_.activity)
      return 1;
    auto is_component = std::visit(
      [](const auto& x) {
        return requires {
          x.component;
        };
      },
      fault);
    if (!is_component)
      return 1;
    auto activity = activity_of(failing_component(fault));
    if (kind.needs_callback && activity.callbacks * per_minute < 1)
      return 0;
    auto all = (activity.callbacks + activity.operations) * per_minute;
    return 1 + static_cast<std::size_t>(std::clamp(std::log10(1 + all) * 2, 0.0, 7.0));
  }

  /// Of those that are to be expected about half, since not every minute is like the others;
  /// coarse, too.
  std::int64_t callbacks_to_come(const std::string& component, Timestamp rest) const {
    if (!options_.activity)
      return most_callbacks;
    auto expected =
      activity_of(component).callbacks * std::chrono::duration<double>(rest).count() / 2;
    auto coarse = std::bit_floor(static_cast<std::uint64_t>(expected));
    return std::clamp(static_cast<std::int64_t>(coarse), std::int64_t{1}, most_callbacks);
  }

  const FaultTargets& targets_;
  const RandomPlanOptions& options_;
  SeededRandom& random_;
  RestartBudget budget_;
  std::vector<Possible> kinds_;
  /// Places in `kinds_`, each as often as its kind is to be drawn.
  std::vector<std::size_t> drawn_;
};

} // namespace

FaultPlan random_plan(const FaultTargets& targets, std::uint64_t seed, Timestamp duration,
                      const RandomPlanOptions& options) {
  FaultPlan result;
  result.file = "seed " + std::to_string(seed);
  result.seed = seed;
  SeededRandom random{seed, "random plan"};
  PlanDrawing drawing{targets, options, random};
  if (!drawing.has_any())
    return result;
  auto end = duration - std::min(options.rest, duration / 4);
  auto most_pause = std::max<std::int64_t>(2 * (options.interval / millisecond), 1);
  for (Timestamp at{0};;) {
    at += random.between(1, most_pause) * millisecond;
    if (at >= end)
      return result;
    for (auto& fault : drawing.next(at, end))
      result.statements.push_back({At{at}, {std::move(fault)}, {}, {}});
  }
}

} // namespace castor::faults
