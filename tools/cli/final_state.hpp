#pragma once

#include <set>
#include <string>
#include <vector>

namespace castor {
class System;
}

namespace castor::cli {

/// Which entries of a system count, and which of their fields do not.
struct StateQuestion {
  /// Names of types.
  std::set<std::string> types;
  /// Names of fields, wherever they stand: what differs from run to run, such as times and ids.
  std::set<std::string> ignored;
};

/// One line for each entry that counts, sorted: its working memory, its type, and its content.
std::vector<std::string> state_of(System& system, const StateQuestion& question);

/// What one has and the other has not, as lines that begin with + or -; empty if they are the same.
std::string difference(const std::vector<std::string>& wanted, const std::vector<std::string>& got);

} // namespace castor::cli
