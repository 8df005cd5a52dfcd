#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/parser.hpp"
#include "castor/base/diagnostic.hpp"

#include "castor/actors/node/placement.hpp"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Names that options may refer to.
struct SystemNames {
  SystemNames() = default;
  explicit SystemNames(const ArchitectureDescription& architecture) { add(architecture); }
  void add(const ArchitectureDescription& architecture);

  std::set<std::string, std::less<>> standalone;
  /// Those of subarchitectures, working memories and task managers left out.
  std::set<std::string, std::less<>> in_subarchitectures;
  std::set<std::string, std::less<>> subarchitectures;
  /// Names that may exist although they are missing in the other sets.
  std::set<std::string, std::less<>> doubtful;
  /// Whether any name may be missing.
  bool is_incomplete = false;
};

/// Adds the problems of running a component in this process: an unknown class or one of another
/// kind, unknown options, invalid values, and names that the system does not have. Loads the
/// library that the class is in. Makes such a component in this thread: its constructor and
/// destructor must return.
void check_class(const ComponentDescription& x, const SystemNames& names,
                 std::vector<Diagnostic>& problems);

/// The same for all components of a system, and whether their hosts are addresses. Here, as below,
/// a constructor or destructor that takes more than 5 s is one of the findings; its thread is left.
std::vector<Diagnostic> check_architecture(const ArchitectureDescription& architecture);

/// The findings of the parser, and those of further checks of what it could understand of a file
/// with errors, in the order of lines.
/// @param classes whether those of components on other machines are checked, too, whose libraries
/// may be there only
/// @param names further names, of a system that the file is to be joined to
enum class Classes { all, on_this_machine };
std::vector<Diagnostic> all_findings(cast::ParseResult& result, Classes classes,
                                     SystemNames names = {});

/// The problems of the placement, if there are any, and those of the components on this machine.
std::vector<Diagnostic> problems_of(const Placement& placement,
                                    const ArchitectureDescription& architecture);

} // namespace castor
