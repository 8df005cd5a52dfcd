#pragma once

#include "castor/wm/entries/entry.hpp"

#include <chrono>

namespace castor {

class ComponentContext;
class ComponentOperations;
class ComponentRuntime;
class Inbox;
class OperationsClient;

/// The parts of a component's runtime that actions are made of.
struct ActionParts {
  ComponentRuntime& runtime;
  ComponentContext& context;
  OperationsClient& client;
  ComponentOperations& operations;
  Inbox& inbox;
};

/// Life of an `Action` that is not over: its executor is a component of another subarchitecture.
inline constexpr EntryLife life_of_action{.writable_by_all = true};

/// Life of an `Action` that is over, unless its requester deletes it before.
inline constexpr EntryLife life_of_outcome{.time_to_live = std::chrono::minutes{10},
                                           .writable_by_all = true};

} // namespace castor
