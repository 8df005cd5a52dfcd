#include "castor/tools/simulation/campaign.hpp"

#include "castor/tools/simulation/system_simulation.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace castor::simulation {

namespace {

using Clock = std::chrono::steady_clock;

/// A tenth of a second's work for one thread.
constexpr std::uint64_t batch_size = 50;

CampaignReport simulate(SystemSimulation& simulation, Seeds seeds, std::size_t most_violations) {
  CampaignReport report;
  report.seeds = seeds;
  for (auto seed = seeds.from;
       report.done < seeds.size() && report.violations.size() < most_violations; ++seed) {
    auto result = simulation.run(seed);
    report.add(result);
    if (result.is_wrong())
      report.violations.push_back(violation_of(simulation, result));
  }
  return report;
}

/// Hands out batches of seeds in their order, and puts together what came of them.
class Batches {
public:
  Batches(CampaignReport report, const CampaignOptions& options)
    : report_(std::move(report)), before_(report_.elapsed), most_(options.most_violations),
      left_(report_.seeds.size() - report_.done), next_(report_.seeds.from + report_.done) {}

  /// Nothing if there is nothing more to do.
  std::optional<Seeds> next() {
    std::lock_guard guard{mutex_};
    if (left_ == 0 || stopped_ || report_.violations.size() >= most_)
      return std::nullopt;
    auto size = std::min(left_, batch_size);
    Seeds result{next_, next_ + (size - 1)};
    left_ -= size;
    next_ += size;
    return result;
  }

  void done(CampaignReport x) {
    std::lock_guard guard{mutex_};
    waiting_.emplace(x.seeds.from, std::move(x));
    while (!waiting_.empty() && waiting_.begin()->first == report_.seeds.from + report_.done &&
           report_.violations.size() < most_)
      report_.append(std::move(waiting_.extract(waiting_.begin()).mapped()));
    report_.elapsed = before_ + (Clock::now() - begin_);
  }

  void stop() {
    std::lock_guard guard{mutex_};
    stopped_ = true;
  }

  CampaignReport report() const {
    std::lock_guard guard{mutex_};
    return report_;
  }

private:
  mutable std::mutex mutex_;
  CampaignReport report_;
  const std::chrono::duration<double> before_;
  const Clock::time_point begin_ = Clock::now();
  const std::size_t most_;
  std::uint64_t left_;
  std::uint64_t next_;
  bool stopped_ = false;
  /// Batches that are done before an earlier one is, by their first seeds.
  std::map<std::uint64_t, CampaignReport> waiting_;
};

/// Threads that have come to their end, to be waited for.
class Countdown {
public:
  explicit Countdown(unsigned count) : left_(count) {}

  void count_down() {
    {
      std::lock_guard guard{mutex_};
      --left_;
    }
    changed_.notify_all();
  }

  bool wait_for(std::chrono::milliseconds x) {
    std::unique_lock lock{mutex_};
    return changed_.wait_for(lock, x, [&] { return left_ == 0; });
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned left_;
};

} // namespace

Violation violation_of(SystemSimulation& simulation, const SystemResult& result) {
  Violation x;
  x.seed = result.seed;
  x.text = to_string(result);
  x.faults = result.faults.statements.size();
  auto few = minimised(simulation, result.seed, result.faults);
  if (!few.statements.empty())
    x.plan = to_string(few);
  x.command = "castor simulate --seed " + std::to_string(result.seed);
  return x;
}

CampaignReport run_campaign(CampaignReport before, const CampaignOptions& options) {
  before.seeds = options.seeds;
  Batches batches{std::move(before), options};
  auto count = std::max(1u, options.threads);
  Countdown running{count};
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < count; ++i)
    threads.emplace_back([&] {
      SystemSimulation simulation;
      while (auto seeds = batches.next())
        batches.done(simulate(simulation, *seeds, options.most_violations));
      running.count_down();
    });
  while (!running.wait_for(std::chrono::milliseconds{100})) {
    options.progress(batches.report());
    if (options.interrupted())
      batches.stop();
  }
  threads.clear();
  return batches.report();
}

} // namespace castor::simulation
