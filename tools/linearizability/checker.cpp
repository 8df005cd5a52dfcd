#include "castor/tools/linearizability/checker.hpp"

#include "castor/tools/linearizability/report.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace castor::linearizability {

namespace {

void check_times(const OperationRecord& x) {
  if (x.returned < x.invoked || x.queued_by < x.invoked)
    throw std::invalid_argument{"an operation ends before it begins: " + to_string(x)};
}

std::string heading(const OperationRecord& x) {
  return "entry " + std::to_string(x.entry) + ": ";
}

} // namespace

Verdict Checker::check(std::span<const OperationRecord> history) {
  std::ranges::for_each(history, check_times);
  sorted_.assign(history.begin(), history.end());
  std::ranges::stable_sort(sorted_, {}, [](auto& x) { return std::tuple{x.entry, x.invoked}; });
  states_ = 0;
  Verdict result;
  for (auto begin = sorted_.begin(); begin != sorted_.end();) {
    auto end = std::find_if(begin, sorted_.end(), [&](auto& x) { return x.entry != begin->entry; });
    auto verdict = check_entry({begin, end});
    states_ += search_.states();
    if (verdict.kind == Verdict::Kind::violation)
      return verdict;
    if (!verdict.ok())
      result = std::move(verdict);
    begin = end;
  }
  return result;
}

Verdict Checker::check_entry(std::span<const OperationRecord> operations) {
  try {
    switch (search_.run(operations, options_.max_states)) {
      case EntrySearch::Outcome::found:
        return {};
      case EntrySearch::Outcome::exhausted:
        return {Verdict::Kind::violation, heading(operations.front()) +
                                            "no order of its operations explains their results\n" +
                                            report(operations, search_.longest())};
      case EntrySearch::Outcome::gave_up:
        break;
    }
  } catch (const std::length_error& error) {
    return {Verdict::Kind::undecided, heading(operations.front()) + error.what()};
  }
  return {Verdict::Kind::undecided, heading(operations.front()) + "no order found in " +
                                      std::to_string(search_.states()) +
                                      " states; raise max_states or cut the history shorter"};
}

} // namespace castor::linearizability
