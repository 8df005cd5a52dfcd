#include "castor/actors/system/status_collector.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace castor {

std::vector<WorkingMemoryStatus> StatusCollector::working_memories() {
  auto ask = [&](const WorkingMemoryActor& wm) {
    return self_->request(wm, options_.answer_patience, StatusQuery{});
  };
  std::vector<decltype(ask(WorkingMemoryActor{}))> answers;
  auto known = roster_.newest();
  for (auto& x : architecture_.subarchitectures)
    if (auto i = known->working_memories.find(x.name);
        i != known->working_memories.end() &&
        processes_.is_up(process_of(known->placement, x.working_memory.name)))
      answers.push_back(ask(i->second));
  std::vector<WorkingMemoryStatus> result;
  for (auto& answer : answers)
    answer.receive([&](const WorkingMemoryStatus& x) { result.push_back(x); },
                   [](const caf::error&) {});
  return result;
}

std::uint64_t StatusCollector::sum_of(std::uint64_t WorkingMemoryStatus::*counter) {
  std::uint64_t result = 0;
  for (auto& x : working_memories())
    result += x.*counter;
  return result;
}

PartStatuses StatusCollector::parts() {
  auto ask = [&](ProcessNumber i) {
    return self_->request(processes_.agent(i), options_.answer_patience, PartStatusQuery{});
  };
  PartStatuses result(processes_.size());
  std::vector<std::pair<std::size_t, decltype(ask(0))>> answers;
  for (std::size_t i = 0; i < result.size(); ++i)
    if (processes_.is_up(static_cast<ProcessNumber>(i)))
      answers.emplace_back(i, ask(static_cast<ProcessNumber>(i)));
  for (auto& [i, answer] : answers)
    answer.receive([&, &to = result[i]](const PartStatus& x) { to = x; }, [](const caf::error&) {});
  return result;
}

std::vector<ComponentStatus> StatusCollector::components() {
  return component_statuses(*roster_.newest(), parts());
}

bool StatusCollector::is_nobody_left() const {
  return std::ranges::none_of(roster_.newest()->components,
                              [](auto& x) { return !x.is_task_manager && x.will_restart; });
}

SystemSummary StatusCollector::summary(const std::vector<std::string>& stuck) {
  SystemSummary result;
  auto answers = parts();
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i])
      result.processes.push_back({processes_.state(static_cast<ProcessNumber>(i)).description,
                                  answers[i]->usage, answers[i]->links});
  result.working_memories = working_memories();
  auto known = roster_.newest();
  result.components = component_statuses(*known, answers);
  result.unstopped = stuck;
  for (auto& name : stuck)
    if (process_of(known->placement, name) == 0)
      result.stuck.push_back(name);
  return result;
}

std::vector<EntryPtr> StatusCollector::entries(const std::string& subarchitecture) {
  std::vector<EntryPtr> result;
  self_
    ->request(roster_.newest()->working_memories.at(subarchitecture), options_.answer_patience,
              QueryRequest{{subarchitecture, {}, 0, false}, {}})
    .receive(
      [&](const Outcome<std::vector<EntryPtr>>& x) {
        if (x)
          result = *x;
      },
      [](const caf::error&) {});
  return result;
}

} // namespace castor
