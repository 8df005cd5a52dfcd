#pragma once

#include "castor/actors/system/inspection_context.hpp"

#include <string>

/// What people and programs outside of a system do to its working memories. They need the
/// permission that ACCESS lines about operators give or take.
namespace castor {

// Each answers the request of that name (docs/introspection.md). They throw where a request makes
// no sense.
void add_entry(const InspectionContextPtr& context, const Json& request);
void overwrite_entry(const InspectionContextPtr& context, const Json& request);
void delete_entry(const InspectionContextPtr& context, const Json& request);
void call_component(const InspectionContextPtr& context, const Json& request);

} // namespace castor
