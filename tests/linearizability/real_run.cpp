#include "castor/tests/linearizability/real_run.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/log.hpp"
#include "castor/actors/node/system.hpp"
#include "castor/tests/linearizability/player.hpp"

#include <algorithm>
#include <random>

namespace castor::linearizability {

namespace {

using namespace std::chrono_literals;

/// Of the entries of a run and what is under way.
struct Plan {
  std::size_t subarchitectures = 1;
  std::size_t entries = 1;
  std::size_t players = 4;
  std::chrono::milliseconds lease{2000};
};

Plan plan_for(std::uint64_t seed) {
  std::mt19937_64 random{seed};
  Plan result;
  result.subarchitectures = 1 + random() % 3;
  result.entries = 1 + random() % 4;
  result.players = 4 + random() % 13;
  // In some runs leases run out.
  if (random() % 2 == 0)
    result.lease = std::chrono::milliseconds{2 + random() % 10};
  return result;
}

std::string name_of(std::size_t subarchitecture) {
  return std::string(1, char('a' + subarchitecture));
}

ArchitectureDescription architecture(const Plan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.subarchitectures; ++i) {
    text += "SUBARCHITECTURE " + name_of(i) +
            " localhost\nCPP WM SubarchitectureWorkingMemory --lease " +
            std::to_string(plan.lease.count()) + "ms\nCPP TM AlwaysPositiveTaskManager\n";
    for (auto player = i; player < plan.players; player += plan.subarchitectures)
      text += "CPP UM p" + std::to_string(player + 1) + " Player\n";
  }
  return *cast::parse_string(text, "real_run.cast").architecture;
}

/// How the entries stand in the end.
void look_at_what_is_left(System& system, const Plan& plan, RealWorld& world) {
  std::vector<EntryPtr> left;
  for (std::size_t i = 0; i < plan.subarchitectures; ++i)
    std::ranges::copy(system.entries(name_of(i)), std::back_inserter(left));
  for (std::uint32_t entry = 0; entry < world.entries.size(); ++entry) {
    auto found = std::ranges::find(left, world.entries[entry], [](auto& x) { return x->address; });
    OperationRecord x;
    x.entry = entry;
    // No read: the last holders may not have ended for the working memory.
    x.kind = found == left.end() ? OperationKind::exists : OperationKind::version;
    x.result =
      found == left.end() ? Result{Status::does_not_exist} : Result{Status::ok, (*found)->version};
    x.invoked = x.returned = world.now();
    world.history.push_back(x);
  }
}

/// Lapses end with the run.
History finished(History history, Tick end) {
  std::erase_if(history,
                [&](auto& x) { return x.kind == OperationKind::lapse && x.invoked > end; });
  for (auto& x : history)
    if (x.kind == OperationKind::lapse)
      x.returned = end;
  return history;
}

} // namespace

RealRunResult run_for_real(std::uint64_t seed) {
  // Components die on purpose, which is no news.
  set_log_level(LogLevel::off);
  auto plan = plan_for(seed);
  RealWorld world;
  world.seed = seed;
  world.players = plan.players;
  world.lease_duration = plan.lease;
  world.longest_pause = plan.lease < 1s ? plan.lease * 3 / 2 : 300us;
  for (std::size_t i = 0; i < plan.entries; ++i)
    world.entries.push_back({name_of(i % plan.subarchitectures), std::string(1, char('w' + i))});
  Player::world = &world;
  RealRunResult result;
  result.description = std::to_string(plan.players) + " components in " +
                       std::to_string(plan.subarchitectures) + " subarchitectures, " +
                       std::to_string(plan.entries) + " entries, leases of " +
                       std::to_string(plan.lease.count()) + " ms";
  {
    SystemOptions options;
    options.open_access = true;
    System system{architecture(plan), options};
    system.start();
    if (system.wait({30s, {}}) != EndReason::ended_by_component)
      result.findings.push_back("it did not come to an end within 30 s");
    system.stop();
    look_at_what_is_left(system, plan, world);
  }
  std::ranges::copy(world.findings, std::back_inserter(result.findings));
  result.history = finished(std::move(world.history), world.now());
  result.verdict = Checker{{.max_states = 4'000'000}}.check(result.history);
  return result;
}

} // namespace castor::linearizability
