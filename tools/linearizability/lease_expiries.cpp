#include "castor/tools/linearizability/lease_expiries.hpp"

#include <algorithm>
#include <tuple>

namespace castor::linearizability {

History possible_lease_expiries(const History& operations, Tick lease_duration,
                                const std::map<Client, Tick>& ends, Tick end) {
  History result;
  auto add = [&](const OperationRecord& lock, Token token, Tick from) {
    if (from > end)
      return;
    OperationRecord x;
    x.client = lock.client;
    x.entry = lock.entry;
    x.kind = OperationKind::lapse;
    x.token = token;
    x.invoked = from;
    x.returned = end;
    result.push_back(x);
  };
  // A lease that was obtained several times lasts from the first.
  std::map<std::tuple<std::uint32_t, Client, Token>, const OperationRecord*> obtained;
  for (auto& x : operations) {
    if (!x.locks())
      continue;
    if (x.pending()) {
      add(x, 0, x.invoked);
    } else if (x.result.status == Status::ok) {
      auto& first = obtained.try_emplace({x.entry, x.client, x.result.token}, &x).first->second;
      if (x.invoked < first->invoked)
        first = &x;
    }
  }
  for (auto& [key, lock] : obtained) {
    auto from = lock->invoked + lease_duration;
    if (auto i = ends.find(lock->client); i != ends.end())
      from = std::min(from, i->second);
    add(*lock, lock->result.token, from);
  }
  return result;
}

} // namespace castor::linearizability
