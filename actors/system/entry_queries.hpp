#pragma once

#include "castor/actors/system/inspection_context.hpp"

#include <string>
#include <vector>

/// The requests of those who look into working memories.
namespace castor {

// Each answers the request of that purpose (docs/introspection.md): `wm` and `types`. They throw
// where a request makes no sense.
void show_entries(const InspectionContextPtr& context, const Json& request);
void show_types(const InspectionContextPtr& context, const Json& request);

/// The entry of that id, or those of that type; all if `what` is empty.
std::vector<EntryPtr> select_entries(std::vector<EntryPtr> entries, const std::string& what);

/// Why there is nothing of the name `what` among the entries of a subarchitecture, with what may
/// have been meant.
std::string nothing_found(const std::string& subarchitecture, const std::string& what,
                          const std::vector<EntryPtr>& entries, const TypeCatalogue& types);

} // namespace castor
