#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/words.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace castor::cast {

/// Collects the SUPERVISE and FAILOVER lines:
///
///     SUPERVISE vision one_for_all RESTARTS 5 IN 30s DELAY 100ms TO 2s
///     FAILOVER vision TO node2 node3
///
/// The names may belong to subarchitectures further down in the file, so they are checked in the
/// end.
class SupervisionRules {
public:
  /// @param words stands behind the keyword
  /// @param line must outlive this object
  void read_supervise(WordStream& words, const StructureLine& line, DiagnosticLog& log);
  /// @param use_host replaces `[Name]` and localhost
  void read_failover(WordStream& words, const StructureLine& line, DiagnosticLog& log,
                     const std::function<std::string(std::string_view)>& use_host);

  /// Checks the names and hands over the rules.
  void finish(const std::set<std::string, std::less<>>& subarchitectures,
              ArchitectureDescription& to, DiagnosticLog& log);

private:
  std::vector<SupervisionRule> rules_;
  std::vector<FailoverRule> failovers_;
  /// The line of each.
  std::vector<const StructureLine*> rule_lines_;
  std::vector<const StructureLine*> failover_lines_;
};

} // namespace castor::cast
