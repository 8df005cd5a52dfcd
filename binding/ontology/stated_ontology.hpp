#pragma once

#include "castor/base/ontology.hpp"
#include "castor/binding/types.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::binding {

/// The ontology that several entries state together, whatever the order in which they came.
struct StatedOntology {
  std::shared_ptr<const Ontology> ontology;
  std::vector<ConceptStatement> statements;
  /// Differs if the statements do; not 0.
  std::uint64_t version = 0;
  /// Statements that are left out, in words: by whom, why, and what to do.
  std::vector<std::string> problems;
};

/// The shared ontology if there are no statements.
/// \param entries by their ids
StatedOntology stated_ontology(const std::map<std::string, ConceptStatements>& entries);

} // namespace castor::binding
