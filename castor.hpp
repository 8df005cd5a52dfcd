#pragma once

/// What components are written against: the base classes and CASTOR_COMPONENT, entry types, change
/// filters and predicates, and what operations throw. `castor/tools/testing/test_system.hpp` is for
/// tests of systems, `castor/actors/system/system.hpp` for programs that run them.
#include "castor/actors/component/call_types.hpp"
#include "castor/actors/component/callback_component.hpp"
#include "castor/actors/component/component.hpp"
#include "castor/actors/component/entry_pointer.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/component/task_manager.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/predicate_builder.hpp"
#include "castor/wm/values/reflect.hpp"
