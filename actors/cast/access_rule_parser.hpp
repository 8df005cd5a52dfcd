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

/// Collects lines of the form `ACCESS writer WRITES owner`. The names may belong to
/// subarchitectures further down in the file, so they are checked in the end.
class AccessRuleParser {
public:
  /// @param words stands behind ACCESS
  /// @param line must outlive this object
  void read(WordStream& words, const StructureLine& line, DiagnosticLog& log);

  /// Checks the names, warns of rules without effect, and hands over the rules.
  /// @param joins whether the file is joined to a running system
  std::vector<AccessRule> finish(const std::set<std::string, std::less<>>& subarchitectures,
                                 bool joins, DiagnosticLog& log);

private:
  void check_operator_rule(std::size_t number, bool joins, DiagnosticLog& log);

  std::vector<AccessRule> rules_;
  /// The line of each rule.
  std::vector<const StructureLine*> lines_;
};

} // namespace castor::cast
