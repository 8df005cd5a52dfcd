#include "castor/actors/faults/fault_schedule.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace castor::faults {

namespace {

constexpr Timestamp millisecond{1000};

/// Of one statement.
constexpr std::size_t most_moments = 1'000'000;

/// When a statement's faults come, by time.
class Moments {
public:
  Moments(std::uint64_t seed, std::string_view purpose, Timestamp duration)
    : random_(seed, purpose), duration_(duration) {}

  std::vector<Timestamp> take() { return std::move(moments_); }

  void operator()(const At& x) { add(x.time); }

  void operator()(const Every& x) {
    for (auto t = x.period; t < duration_; t += x.period)
      add(t);
  }

  /// Each millisecond has the same chance, exactly the same on every machine, as would not be with
  /// logarithms.
  void operator()(const AtRandom& x) {
    constexpr std::uint64_t milliseconds_per_thousand_seconds = 1'000'000;
    for (Timestamp t{0}; t < duration_; t += millisecond)
      if (random_.below(milliseconds_per_thousand_seconds) < x.rate.per_thousand_seconds)
        add(t);
  }

  void operator()(const After&) {}

private:
  void add(Timestamp x) {
    if (moments_.size() == most_moments)
      throw std::length_error{"a fault would happen more than " + std::to_string(most_moments) +
                              " times"};
    if (x < duration_)
      moments_.push_back(x);
  }

  SeededRandom random_;
  Timestamp duration_;
  std::vector<Timestamp> moments_;
};

} // namespace

FaultSchedule::FaultSchedule(const FaultPlan& plan, FaultTargets targets, std::uint64_t seed,
                             Timestamp duration)
  : plan_(plan), targets_(std::move(targets)), seed_(seed) {
  std::map<std::string, std::size_t> alike;
  for (std::size_t i = 0; i < plan_.statements.size(); ++i) {
    auto& statement = plan_.statements[i];
    auto text = to_string(statement);
    purposes_.push_back(text + "#" + std::to_string(alike[text]++));
    Moments moments{seed, "moments of " + purposes_.back(), duration};
    std::visit(moments, statement.trigger);
    std::uint64_t number = 0;
    for (auto t : moments.take())
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
