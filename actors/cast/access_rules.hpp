#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/diagnostic_log.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/words.hpp"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace castor::cast {

/// Collects lines of the form `ACCESS writer WRITES owner`. The names may belong to
/// subarchitectures further down in the file, so they are checked in the end.
class AccessRules {
public:
  /// @param words stands behind ACCESS
  /// @param line must outlive this object
  void read(WordStream& words, const StructureLine& line, DiagnosticLog& log);

  /// Checks the names, warns of rules without effect, and hands over the rules.
  std::vector<AccessRule> finish(const std::set<std::string, std::less<>>& subarchitectures,
                                 DiagnosticLog& log);

private:
  std::vector<AccessRule> rules_;
  /// The line of each rule.
  std::vector<const StructureLine*> lines_;
};

} // namespace castor::cast
