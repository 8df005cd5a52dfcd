#include "castor/tools/chaos/fault_schedule.hpp"

#include "castor/tools/chaos/moments.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace castor::faults {

FaultSchedule::FaultSchedule(const FaultPlan& plan, FaultTargets targets, std::uint64_t seed,
                             Timestamp duration)
  : plan_(plan), targets_(std::move(targets)), seed_(seed) {
  std::map<std::string, std::size_t> alike;
  for (std::size_t i = 0; i < plan_.statements.size(); ++i) {
    auto& statement = plan_.statements[i];
    auto text = to_string(statement);
    purposes_.push_back(text + "#" + std::to_string(alike[text]++));
    std::uint64_t number = 0;
    for (auto t : moments_of(statement.trigger, seed, purposes_.back(), duration))
      timed_.push_back({t, draw(i, number++), i});
    if (auto after = std::get_if<After>(&statement.trigger))
      watches_.push_back({i, *after});
  }
  std::ranges::stable_sort(timed_, {}, &DueFault::at);
}

std::optional<Timestamp> FaultSchedule::next_time() const {
  if (next_ == timed_.size())
    return std::nullopt;
  return timed_[next_].at;
}

std::optional<DueFault> FaultSchedule::next(Timestamp now) {
  if (next_ == timed_.size() || timed_[next_].at > now)
    return std::nullopt;
  return timed_[next_++];
}

std::optional<DueFault> FaultSchedule::on_change(std::size_t filter, Timestamp now) {
  auto& x = watches_.at(filter);
  if (x.over || ++x.seen < x.after.count)
    return std::nullopt;
  x.seen = 0;
  x.over = !x.after.repeated;
  return DueFault{now, draw(x.statement, x.drawn++), x.statement};
}

FaultPlan FaultSchedule::as_plan() const {
  FaultPlan result;
  result.file = plan_.file;
  result.seed = seed_;
  for (auto& x : timed_) {
    auto& origin = plan_.statements[x.statement];
    result.statements.push_back({At{x.at}, {x.fault}, origin.where, origin.line});
  }
  for (auto& x : watches_) {
    auto statement = plan_.statements[x.statement];
    if (!x.after.repeated)
      statement.faults = {draw(x.statement, 0)};
    result.statements.push_back(std::move(statement));
  }
  return result;
}

Fault FaultSchedule::draw(std::size_t statement, std::uint64_t number) const {
  SeededRandom random{seed_, purposes_[statement], number};
  return draw_targets(random.one_of(plan_.statements[statement].faults), targets_, random);
}

} // namespace castor::faults
