#include "castor/tools/chaos/chaos_report.hpp"
#include "castor/tools/chaos/coverage.hpp"
#include "castor/tools/chaos/recovery_times.hpp"

#include <nlohmann/json.hpp>

namespace castor::faults {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(std::optional<Timestamp> x) {
  return x ? Json(x->count()) : Json(nullptr);
}

Json json_of(const FaultRecord& x) {
  return {{"at_us", json_of(x.at)},       {"happened_us", json_of(x.happened)},
          {"until_us", json_of(x.until)}, {"kind", x.kind},
          {"target", x.target},           {"fault", x.fault},
          {"state", to_string(x.state)},  {"outcome", x.outcome}};
}

Json json_of(const Outage& x) {
  return {{"target", x.target},
          {"kind", x.kind},
          {"down_us", json_of(x.down)},
          {"up_us", json_of(x.up)},
          {"first_callback_us", json_of(x.first_callback)},
          {"escalated_us", json_of(x.escalated)},
          {"recovery_us", json_of(x.recovery())},
          {"bound_us", json_of(x.bound)},
          {"reason", x.reason}};
}

std::string_view word_for(CheckRecord::Verdict x) {
  switch (x) {
    case CheckRecord::Verdict::held:
      return "held";
    case CheckRecord::Verdict::violated:
      return "violated";
    case CheckRecord::Verdict::undecided:
      return "undecided";
  }
  return {};
}

Json json_of(const CheckRecord& x) {
  return {{"check", x.name}, {"verdict", word_for(x.verdict)}, {"grounds", x.grounds}};
}

Json json_of(const Violation& x) {
  return {{"check", x.check},
          {"text", x.text},
          {"at_us", json_of(x.at)},
          {"seed", x.seed},
          {"replay", x.replay}};
}

Json json_of(const ProcessResources& x) {
  auto samples = Json::array();
  for (auto& y : x.samples)
    samples.push_back({{"at_us", json_of(y.at)},
                       {"memory_bytes", y.memory},
                       {"files", y.files},
                       {"threads", y.threads}});
  return {{"process", x.process}, {"id", x.id}, {"samples", std::move(samples)}};
}

Json json_of(const Activity& x) {
  return {{"duration_us", json_of(x.duration)},
          {"callbacks", x.callbacks},
          {"operations", x.operations},
          {"moments", x.moments},
          {"busy_moments", x.busy_moments}};
}

Json json_of(const WorkloadCounts& x) {
  return {{"due", x.due},           {"done", x.done},
          {"said", x.said},         {"said_again", x.said_again},
          {"answered", x.answered}, {"apologised", x.apologised},
          {"late", x.late},         {"unanswered", x.unanswered}};
}

Json json_of(const StatementRecord& x) {
  return {{"statement", x.statement}, {"counts", json_of(x.counts)}, {"problem", x.problem}};
}

template <class T>
Json json_list_of(const std::vector<T>& items) {
  auto result = Json::array();
  for (auto& x : items)
    result.push_back(json_of(x));
  return result;
}

Json json_of(const std::optional<WorkloadRecord>& x) {
  if (!x)
    return nullptr;
  return {{"file", x->file},
          {"took_us", json_of(x->took)},
          {"counts", json_of(x->total())},
          {"answer_p50_us", json_of(percentile(x->answer_times, 50))},
          {"answer_longest_us", json_of(percentile(x->answer_times, 100))},
          {"statements", json_list_of(x->statements)}};
}

Json recovery_of(const ChaosRun& run) {
  auto times = recovery_times(run.outages);
  return {{"count", times.size()},
          {"p50_us", json_of(percentile(times, 50))},
          {"p99_us", json_of(percentile(times, 99))},
          {"longest_us", json_of(percentile(times, 100))}};
}

} // namespace

std::string to_json(const ChaosRun& run) {
  auto coverage = Json::array();
  for (auto& table : coverage_of(run).tables())
    for (auto& [target, cells] : table.rows)
      for (std::size_t i = 0; i < cells.size(); ++i)
        coverage.push_back({{"kind", table.kinds[i]},
                            {"target", target},
                            {"hits", cells[i].hits},
                            {"misses", cells[i].misses}});
  auto facts = Json::object();
  for (auto& [name, value] : run.facts)
    facts[name] = value;
  Json result{{"system", run.system},
              {"command", run.command},
              {"seed", run.seed},
              {"duration_us", json_of(run.duration)},
              {"held", run.held()},
              {"vacuous", run.vacuous()},
              {"activity", run.activity ? json_of(*run.activity) : Json(nullptr)},
              {"workload", json_of(run.workload)},
              {"checks", json_list_of(run.checks)},
              {"violations", json_list_of(run.violations)},
              {"recovery", recovery_of(run)},
              {"faults", json_list_of(run.faults)},
              {"outages", json_list_of(run.outages)},
              {"coverage", std::move(coverage)},
              {"resources", json_list_of(run.resources)},
              {"facts", std::move(facts)},
              {"plan", run.plan}};
  // What a component said need not be UTF-8.
  return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace castor::faults
