#pragma once

#include "castor/actors/system/inspection_context.hpp"

#include <string>
#include <vector>

/// Requests that read working memories.
namespace castor {

// Each answers the request of that purpose (docs/introspection.md): `wm` and `types`. They throw
// for invalid requests.
void show_entries(const InspectionContextPtr& context, const Json& request);
void show_types(const InspectionContextPtr& context, const Json& request);

/// The entry of that id, or those of that type; all if `what` is empty.
std::vector<EntryPtr> select_entries(std::vector<EntryPtr> entries, const std::string& what);

/// Error for a name `what` that is not among the entries of a subarchitecture, with the nearest
/// known names.
std::string nothing_found(const std::string& subarchitecture, const std::string& what,
                          const std::vector<EntryPtr>& entries, const TypeCatalogue& types);

} // namespace castor
