#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/planning/symbolic/lifted_task.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// Reader of PDDL: of version 1.2 (Ghallab et al. 1998) the parts STRIPS, typing, equality,
/// negative and disjunctive preconditions, quantifiers and conditional effects; of version 2.2
/// (Edelkamp and Hoffmann 2004) derived predicates; of version 3.1 action costs.
namespace castor::planning {

struct PddlResult {
  /// Of meaning only if the problems are no errors.
  LiftedTask task;
  /// All of them, in the order of the files' lines; at most a hundred.
  std::vector<Diagnostic> problems;
};

/// @param domain_file name for messages
PddlResult parse_pddl(const std::string& domain_file, std::string domain_text,
                      const std::string& problem_file, std::string problem_text);

/// The same of two files. What cannot be read is a problem, too.
PddlResult read_pddl(const std::filesystem::path& domain, const std::filesystem::path& problem);

} // namespace castor::planning
