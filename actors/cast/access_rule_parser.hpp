#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/words.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace castor::cast {

/// Collects lines of the forms `ACCESS writer WRITES owner` and `ACCESS reader READS owner`. The
/// names may belong to subarchitectures further down in the file, so they are checked in the end.
class AccessRuleParser {
public:
  /// @param words stands behind ACCESS
  /// @param line must outlive this object
  void read(WordStream& words, const StructureLine& line, DiagnosticLog& log);

  /// Checks the names, warns of rules without effect, and puts the rules into `into`.
  /// @param joins whether the file is joined to a running system
  void finish(const std::set<std::string, std::less<>>& subarchitectures, bool joins,
              ArchitectureDescription& into, DiagnosticLog& log);

private:
  using Names = std::set<std::string, std::less<>>;

  void check_write_rules(const Names& subarchitectures, bool joins, DiagnosticLog& log);
  void check_read_rules(const Names& subarchitectures, bool joins, DiagnosticLog& log);
  /// Warns of writers that cannot overwrite, since they may not read.
  void check_writers_read(const ArchitectureDescription& architecture, DiagnosticLog& log);
  void check_operator_rule(std::size_t number, bool joins, DiagnosticLog& log);

  std::vector<AccessRule> rules_;
  /// The line of each rule.
  std::vector<const StructureLine*> lines_;
  std::vector<ReadRule> read_rules_;
  std::vector<const StructureLine*> read_lines_;
};

} // namespace castor::cast
