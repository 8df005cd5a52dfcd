#pragma once

#include <set>
#include <string>
#include <vector>

namespace castor {
class System;
}

namespace castor::cli {

/// Which entries of a system to compare, and which of their fields to ignore.
struct ComparedEntries {
  /// Names of types.
  std::set<std::string> types;
  /// Names of fields, at any depth, that differ from run to run, such as times and ids.
  std::set<std::string> ignored;
};

/// One line for each compared entry, sorted: its working memory, its type, and its content.
std::vector<std::string> state_of(System& system, const ComparedEntries& compared);

/// Lines only in `got`, marked with +, and only in `wanted`, marked with -; empty if they are
/// equal.
std::string difference(const std::vector<std::string>& wanted, const std::vector<std::string>& got);

} // namespace castor::cli
