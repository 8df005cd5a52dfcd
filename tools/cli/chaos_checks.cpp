#include "castor/tools/cli/chaos_checks.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/resource_growth.hpp"
#include "castor/tools/chaos/rounded.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/forbidden_changes.hpp"
#include "castor/tools/cli/history_watch.hpp"
#include "castor/tools/cli/workload_run.hpp"

#include <fmt/core.h>

namespace castor::cli {

const std::vector<faults::ForbiddenChange>& ChaosChecks::forbidden() const {
  static const std::vector<faults::ForbiddenChange> none;
  return setup_.workload ? setup_.workload->workload.never : none;
}

const std::vector<faults::ExpectedChange>& ChaosChecks::demanded() const {
  static const std::vector<faults::ExpectedChange> none;
  return setup_.workload ? setup_.workload->workload.each : none;
}

void ChaosChecks::survival(EndReason reason,
                           const std::optional<std::pair<int, std::string>>& ended) {
  std::string problem;
  if (reason == EndReason::all_failed)
    problem = "all components have failed";
  if (ended && ended->first != success)
    problem = "the system ended: " + ended->second;
  else if (ended)
    run_.facts.emplace_back("ended by", ended->second);
  check("survival", problem.empty(), faults::rounded(setup_.duration) + " of faults");
  if (!problem.empty())
    violation("survival", problem);
}

void ChaosChecks::state(const std::vector<std::string>& wanted,
                        const std::vector<std::string>& got) {
  if (setup_.compared.types.empty())
    return;
  auto text = difference(wanted, got);
  check("state as without faults", text.empty(),
        fmt::format("{} entries of the types {}", wanted.size(),
                    list_of(setup_.compared.types, setup_.compared.types.size())));
  if (!text.empty())
    violation("state as without faults", text);
}

faults::WorkloadRecord ChaosChecks::workload(WorkloadRun& work) {
  auto record = work.end();
  auto total = record.total();
  auto undone = faults::actions_missing(record);
  check("workload done", undone.empty(), fmt::format("{} of {} actions", total.done, total.due));
  if (!undone.empty())
    violation("workload done", undone);
  auto& within = setup_.workload->workload.answer_within;
  if (!within)
    return record;
  auto missing = faults::answers_missing(work.sentences(), within);
  check("sentences answered", missing.empty(),
        fmt::format("{} sentences, within {}", total.said, faults::rounded(*within)));
  if (!missing.empty())
    violation("sentences answered", missing);
  return record;
}

void ChaosChecks::forbidden_changes(const ForbiddenChanges& seen) {
  if (forbidden().empty())
    return;
  auto problems = seen.violations();
  check("no forbidden change", problems.empty(), fmt::format("{} filters", forbidden().size()));
  for (auto& x : problems)
    violation("no forbidden change", x);
}

void ChaosChecks::expected_changes(const faults::ExpectedChanges& expected) {
  if (demanded().empty())
    return;
  auto problems = expected.violations();
  check("expected changes", problems.empty(),
        faults::counted(expected.begun(), "entry", "entries") + ", within " +
          faults::rounded(expected.patience()));
  for (auto& x : problems)
    violation("expected changes", x);
}

void ChaosChecks::outages(const std::vector<faults::LifeNote>& notes, Timestamp end) {
  run_.outages =
    faults::outages_of(notes, [this](const std::string&) { return Timestamp{setup_.bound}; });
  for (auto& x : run_.outages)
    x.kind = faults::word_for(setup_.targets, x.target);
  auto late = faults::late_recoveries(run_.outages, end);
  check("back or given up in time", late.empty(),
        fmt::format("{} outages, bound {}", run_.outages.size(), faults::rounded(setup_.bound)));
  for (auto& x : late)
    violation("back or given up in time", x);
}

void ChaosChecks::components(const SystemSummary& summary) {
  std::string down;
  for (auto& x : summary.components)
    if (x.state == ComponentState::failed)
      down += x.identity.full_name() + " is down: " + x.failure + '\n';
  check("all components run in the end", down.empty(),
        fmt::format("{} components", summary.components.size()));
  if (!down.empty())
    violation("all components run in the end", down);
}

void ChaosChecks::histories(const HistoryWatch& histories,
                            const std::function<void(const std::string& name)>& begin) {
  using Verdict = faults::CheckRecord::Verdict;
  using Kind = linearizability::Verdict::Kind;
  for (auto& [name, x] : histories.judge(begin)) {
    auto verdict = x.verdict == Kind::ok          ? Verdict::held
                   : x.verdict == Kind::violation ? Verdict::violated
                                                  : Verdict::undecided;
    run_.checks.push_back({name, verdict, x.grounds});
    if (verdict == Verdict::violated)
      violation(name, x.report);
  }
}

void ChaosChecks::resources(std::vector<faults::ProcessResources> resources) {
  run_.resources = std::move(resources);
  faults::ResourceTolerance tolerance;
  if (setup_.workload && setup_.workload->workload.growth_within)
    tolerance.memory = static_cast<double>(*setup_.workload->workload.growth_within);
  bool good = true;
  for (auto& process : run_.resources)
    for (auto& leak : faults::leaks(process, tolerance)) {
      violation("memory, files and threads", leak);
      good = false;
    }
  check("memory, files and threads", good, fmt::format("{} processes", run_.resources.size()));
}

void ChaosChecks::check(const std::string& name, bool held, const std::string& grounds) {
  using Verdict = faults::CheckRecord::Verdict;
  if (when_.empty())
    run_.checks.push_back({name, held ? Verdict::held : Verdict::violated, grounds});
}

void ChaosChecks::violation(const std::string& name, const std::string& text) {
  run_.violations.push_back({name + when_, text, {}, run_.seed, run_.command});
}

} // namespace castor::cli
