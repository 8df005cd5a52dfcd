#pragma once

#include "castor/wm/memory/lease_service.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <span>
#include <vector>

namespace castor {

/// The effects of the writes of an atomic write, or the failure of the first one that is refused.
/// For each write the leases are checked before the rules of the store: a lost lease is reported
/// before any other error.
Outcome<std::vector<EntryStore::Effect>> prepare_writes(const EntryStore& store,
                                                        const LeaseService& leases,
                                                        std::span<const WriteRequest> requests);

} // namespace castor
