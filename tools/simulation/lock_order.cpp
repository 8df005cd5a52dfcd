#include "castor/tools/simulation/lock_order.hpp"

#include <algorithm>
#include <set>

namespace castor::linearizability {

namespace {

bool is_granted(const OperationRecord& x) {
  return !x.pending() && x.result.status == Status::ok;
}

} // namespace

std::vector<const LockOrder::Lock*> LockOrder::granted(std::uint32_t entry) const {
  std::vector<const Lock*> result;
  for (auto& x : locks_)
    if (x.record.entry == entry && is_granted(x.record))
      result.push_back(&x);
  // Of those that obtained the same lease, the one that obtained it first.
  std::ranges::stable_sort(result, {}, [](auto* x) { return x->record.result.token; });
  auto rest = std::ranges::unique(result, {}, [](auto* x) { return x->record.result.token; });
  result.erase(rest.begin(), rest.end());
  return result;
}

bool LockOrder::may_hide_grants(const Lock& x) const {
  return std::ranges::any_of(locks_, [&](auto& y) {
    return y.record.entry == x.record.entry && y.record.pending() &&
           y.record.invoked < x.record.returned;
  });
}

std::vector<std::string> LockOrder::violations() const {
  std::vector<std::string> result;
  std::set<std::uint32_t> entries;
  for (auto& x : locks_)
    entries.insert(x.record.entry);
  for (auto entry : entries) {
    auto grants = granted(entry);
    for (auto i = grants.begin(); i != grants.end(); ++i) {
      auto& lock = **i;
      // First of those that overtook it since a lock was granted that may have been before it.
      const Lock* first = nullptr;
      for (auto j = grants.begin(); j != i; ++j) {
        auto& other = **j;
        if (other.record.invoked < lock.arrived_by) {
          first = nullptr;
          continue;
        }
        auto report = [&](const std::string& what) {
          result.push_back(to_string(other.record) + " overtook " + to_string(lock.record) + what);
        };
        if (!first)
          first = &other;
        if (other.arrived_by != never)
          report(", although it waited itself");
        else if (other.record.client == lock.record.client)
          report(", which is of the same client");
        else if (overtaking_ == Timestamp{0})
          report("");
        else if (other.invoked - first->returned > overtaking_ && !may_hide_grants(lock))
          report(" too late");
      }
    }
  }
  return result;
}

} // namespace castor::linearizability
