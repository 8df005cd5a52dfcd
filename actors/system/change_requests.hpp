#pragma once

#include "castor/actors/system/inspection_context.hpp"

/// Requests that change the components of a system.
namespace castor {

// Each answers the request of that name (docs/introspection.md). They throw for invalid requests.
void add_components(const InspectionContextPtr& context, const Json& request);
void remove_component(const InspectionContextPtr& context, const Json& request);

} // namespace castor
