#pragma once

#include "castor/actors/system/inspection_context.hpp"

/// The requests of those who change what a system consists of.
namespace castor {

// Each answers the request of that name (docs/introspection.md). They throw where a request makes
// no sense.
void add_components(const InspectionContextPtr& context, const Json& request);
void remove_component(const InspectionContextPtr& context, const Json& request);

} // namespace castor
