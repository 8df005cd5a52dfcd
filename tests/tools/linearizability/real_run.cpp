#include "castor/tests/tools/linearizability/real_run.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/linearizability/lease_expiries.hpp"

#include <algorithm>
#include <random>
#include <thread>

namespace castor::linearizability {

namespace {

using namespace std::chrono_literals;

/// Of the entries of a run and what is under way.
struct RunPlan {
  std::size_t subarchitectures = 1;
  std::size_t entries = 1;
  std::size_t players = 4;
  std::chrono::milliseconds lease{2000};
};

RunPlan plan_for(std::uint64_t seed) {
  std::mt19937_64 random{seed};
  RunPlan result;
  result.subarchitectures = 1 + random() % 3;
  result.entries = 1 + random() % 4;
  result.players = 4 + random() % 13;
  // In some runs leases run out.
  if (random() % 2 == 0)
    result.lease = std::chrono::milliseconds{2 + random() % 10};
  return result;
}

ArchitectureDescription architecture(const RunPlan& plan, const World& world) {
  std::string text;
  for (std::size_t i = 0; i < plan.subarchitectures; ++i) {
    text += "SUBARCHITECTURE " + subarchitecture_name(i) +
            " localhost\nCPP WM SubarchitectureWorkingMemory --lease " +
            std::to_string(plan.lease.count()) + "ms\nCPP TM AlwaysPositiveTaskManager\n";
    for (auto player = i; player < plan.players; player += plan.subarchitectures)
      text += "CPP UM p" + std::to_string(player + 1) + " Player --world " + world.path() + "\n";
  }
  text += "CPP UM closer Closer --world " + world.path() + "\n";
  return *cast::parse_string(text, "real_run.cast").architecture;
}

} // namespace

std::string subarchitecture_name(std::size_t subarchitecture) {
  return std::string(1, char('a' + subarchitecture));
}

bool await(const std::function<bool()>& condition, std::chrono::steady_clock::time_point until) {
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until)
      return false;
    std::this_thread::sleep_for(500us);
  }
  return true;
}

void judge(RealRunResult& result, const World& world, std::chrono::milliseconds lease,
           const std::map<Client, Tick>& ends) {
  std::ranges::copy(world.findings(), std::back_inserter(result.findings));
  result.history = world.operations();
  std::ranges::copy(possible_lease_expiries(result.history,
                                            Tick(std::chrono::nanoseconds{lease}.count()), ends,
                                            world.now()),
                    std::back_inserter(result.history));
  result.verdict = Checker{{.max_states = 4'000'000}}.check(result.history);
}

RealRunResult run_for_real(std::uint64_t seed) {
  // Components die on purpose, which is no news.
  set_log_level(LogLevel::off);
  auto plan = plan_for(seed);
  WorldSettings settings;
  settings.seed = seed;
  settings.players = plan.players;
  settings.longest_pause = plan.lease < 1s ? plan.lease * 3 / 2 : 300us;
  for (std::size_t i = 0; i < plan.entries; ++i)
    settings.homes += subarchitecture_name(i % plan.subarchitectures);
  World world{settings};
  RealRunResult result;
  result.description = std::to_string(plan.players) + " components in " +
                       std::to_string(plan.subarchitectures) + " subarchitectures, " +
                       std::to_string(plan.entries) + " entries, leases of " +
                       std::to_string(plan.lease.count()) + " ms";
  {
    SystemOptions options;
    options.open_access = true;
    options.restarts = false;
    System system{architecture(plan, world), options};
    system.start();
    auto until = std::chrono::steady_clock::now() + 30s;
    if (!await([&] { return world.all_have_left(); }, until))
      result.findings.push_back("the players did not come to an end within 30 s");
    world.let_close();
    if (!await([&] { return world.is_closed(); }, until + 15s))
      result.findings.push_back("nobody could look at how the entries stand in the end");
    system.stop();
  }
  judge(result, world, plan.lease, world.ends());
  return result;
}

} // namespace castor::linearizability
