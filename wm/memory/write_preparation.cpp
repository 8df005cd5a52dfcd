#include "castor/wm/memory/write_preparation.hpp"

#include <utility>

namespace castor {

Outcome<std::vector<EntryStore::Effect>> prepare_writes(const EntryStore& store,
                                                        const LeaseService& leases,
                                                        std::span<const WriteRequest> requests) {
  if (auto refused = store.check_atomic(requests))
    return *std::move(refused);
  std::vector<EntryStore::Effect> result;
  result.reserve(requests.size());
  for (auto& request : requests) {
    if (auto refused = leases.check(request))
      return *std::move(refused);
    auto effect = store.prepare(request);
    if (!effect)
      return effect.failure();
    result.push_back(*std::move(effect));
  }
  return result;
}

} // namespace castor
