#include "castor/tests/tools/linearizability/brute_force.hpp"

#include "castor/tools/linearizability/entry_model.hpp"

#include <algorithm>
#include <vector>

namespace castor::linearizability {

namespace {

class Orders {
public:
  explicit Orders(std::span<const OperationRecord> operations)
    : operations_(operations), model_(operations), placed_(operations.size()) {}

  /// Whether there is a way on from a state that was reached at `now`, the earliest moment there
  /// can be for the steps so far.
  bool lead_on(const EntryState& state, Tick now) {
    std::span waiting{state.queue.data(), state.waiting};
    bool over = std::ranges::all_of(waiting, [&](auto x) { return operations_[x].pending(); });
    for (OperationIndex x = 0; x < operations_.size(); ++x)
      over &= placed_[x] || operations_[x].may_be_left_out();
    if (over)
      return true;
    for (OperationIndex x = 0; x < operations_.size(); ++x)
      if (!placed_[x] && leads_on_by_arrival(state, now, x))
        return true;
    return std::ranges::any_of(waiting, [&](auto x) {
      auto& operation = operations_[x];
      if (!operation.pending() &&
          (operation.result.status != Status::timed_out || operation.returned < now))
        return false;
      auto next = state;
      model_.give_up(next, x);
      return lead_on(next, now);
    });
  }

private:
  bool leads_on_by_arrival(const EntryState& state, Tick now, OperationIndex x) {
    auto& operation = operations_[x];
    auto moment = std::max(now, operation.invoked);
    if (moment > operation.arrived_by())
      return false;
    if (operation.kind == OperationKind::lapse && operation.mandatory && operation.token != 0 &&
        operation.token > state.last_token)
      return false;
    auto next = state;
    std::vector<SettledWait> settled;
    if (auto answer = model_.arrive(next, x, settled))
      settled.push_back({x, *answer});
    bool agreed = std::ranges::all_of(settled, [&](auto& y) {
      auto& other = operations_[y.operation];
      return other.pending() || other.kind == OperationKind::lapse ||
             (other.result == y.result && moment <= other.returned);
    });
    if (!agreed)
      return false;
    placed_[x] = true;
    bool result = lead_on(next, moment);
    placed_[x] = false;
    return result;
  }

  std::span<const OperationRecord> operations_;
  EntryModel model_;
  std::vector<bool> placed_;
};

} // namespace

bool linearizable_by_brute_force(std::span<const OperationRecord> operations) {
  return Orders{operations}.lead_on({}, 0);
}

} // namespace castor::linearizability
