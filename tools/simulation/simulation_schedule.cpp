#include "castor/tools/simulation/simulation_schedule.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace castor::simulation {

namespace {

/// Far more than a run takes.
constexpr std::size_t most_steps = 400'000;

} // namespace

SimulationSchedule::SimulationSchedule(TestingSystem& stage, SystemWorld& world,
                                       SimulatedMachines& machines, std::uint64_t seed)
  : stage_(stage), world_(world), machines_(machines), seed_(seed),
    begin_(stage.scheduler.clock().now()) {}

Timestamp SimulationSchedule::time() const {
  return std::chrono::duration_cast<Timestamp>(stage_.scheduler.clock().now() - begin_);
}

void SimulationSchedule::add_fault(Timestamp at, faults::Fault fault) {
  due_.emplace(at, std::move(fault));
}

void SimulationSchedule::advance(Timestamp until) {
  advance_until(until, [] { return false; });
}

bool SimulationSchedule::advance_until(Timestamp until, const std::function<bool()>& enough) {
  auto& jobs = stage_.scheduler.jobs;
  for (;;) {
    if (++steps_ > most_steps)
      throw std::runtime_error{"it does not come to rest"};
    while (!due_.empty() && due_.begin()->first <= time()) {
      auto fault = due_.extract(due_.begin());
      machines_.inject(fault.mapped(), seed_);
    }
    machines_.catch_up();
    auto job = ready_job();
    if (job == jobs.size()) {
      if (enough())
        return true;
      if (time() >= until)
        return false;
      let_time_pass(std::max(Timestamp{1}, std::min(until, next_event()) - time()));
      continue;
    }
    if (world_.chance(1))
      let_time_pass(std::chrono::milliseconds{1 + world_.pick(5)});
    else
      stage_.run_one(job);
  }
}

/// One of those that may run; as many as there are if none may.
std::size_t SimulationSchedule::ready_job() {
  auto& jobs = stage_.scheduler.jobs;
  if (jobs.empty())
    return 0;
  auto first = world_.pick(jobs.size());
  if (machines_.all_may_run())
    return first;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (auto job = (first + i) % jobs.size(); machines_.may_run(jobs[job]))
      return job;
  return jobs.size();
}

Timestamp SimulationSchedule::next_event() {
  auto& clock = stage_.scheduler.clock();
  auto result = machines_.next_event();
  if (clock.has_pending_timeout())
    result = std::min(result, clock.schedule().begin()->first);
  auto next = result == caf::actor_clock::time_point::max()
                ? Timestamp::max()
                : std::chrono::ceil<Timestamp>(result - begin_);
  return due_.empty() ? next : std::min(next, due_.begin()->first);
}

void SimulationSchedule::run_jobs_of(Life x) {
  stage_.scheduler.run_jobs_filtered([&](caf::resumable* job) {
    auto owner = world_.owners.find(job);
    return owner != world_.owners.end() && owner->second == x;
  });
}

void SimulationSchedule::let_time_pass(Timestamp x) {
  stage_.scheduler.advance_time(x);
  world_.recorder.set_time(time());
}

} // namespace castor::simulation
