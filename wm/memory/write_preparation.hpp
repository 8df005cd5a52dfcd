#pragma once

#include "castor/wm/memory/lease_service.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <span>
#include <vector>

namespace castor {

/// The effects of writes that happen together, or the failure of the first that may not be. Of each
/// write the leases are checked before the rules of the store: a client whose lease is lost has to
/// know that, whatever else is wrong.
Outcome<std::vector<EntryStore::Effect>> prepare_writes(const EntryStore& store,
                                                        const LeaseService& leases,
                                                        std::span<const WriteRequest> requests);

} // namespace castor
