#pragma once

#include "castor/tools/chaos/recorded_operations.hpp"
#include "castor/wm/entries/address.hpp"

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

/// The actions that components have logged (castor/actors/runtime/operation_log.hpp), and a check
/// that none was executed twice.
namespace castor::faults {

/// A component has begun to execute an action.
struct ExecutedAction {
  Life executor;
  std::string type;
  linearizability::Tick at = 0;
  /// Entry of the action.
  Address action;
};

/// Reads the file of one process.
void read_actions(std::istream& in, std::vector<ExecutedAction>& to);

/// Reads all files of a folder. Incomplete lines of killed processes are left out.
std::vector<ExecutedAction> read_actions(const std::filesystem::path& folder);

/// Whether each action was begun once, by one component in one of its lives.
Judgement judge_actions(std::vector<ExecutedAction> actions);

} // namespace castor::faults
