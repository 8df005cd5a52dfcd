#pragma once

#include "castor/actors/system/inspection_context.hpp"

#include <string>

/// Requests of people and programs outside of a system: to write to its working memories, as far as
/// ACCESS lines about operators permit it, to call its components, and to command its effectors.
namespace castor {

// Each answers the request of that name (docs/introspection.md). They throw for invalid requests.
void add_entry(const InspectionContextPtr& context, const Json& request);
void overwrite_entry(const InspectionContextPtr& context, const Json& request);
void delete_entry(const InspectionContextPtr& context, const Json& request);
void call_component(const InspectionContextPtr& context, const Json& request);
void command_effector(const InspectionContextPtr& context, const Json& request);

} // namespace castor
