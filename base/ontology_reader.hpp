#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/base/named_text.hpp"
#include "castor/base/ontology.hpp"

#include <span>
#include <vector>

/// The language of ontology files. `#` begins a comment; the first word of a line says what it
/// states.
///
///     concept thing place                      # there are such concepts
///     concept kitchen office: room             # these are kinds of that; of several: room, place
///     concept ball: thing with shape sphere    # whatever is a thing and has this shape is a ball
///     disjoint thing place                     # nothing is two of these
///     partition thing                          # nor two kinds of it, such as a cup and a plate
///     alike cube square rectangle              # the first may look like any of the others
namespace castor {

struct OntologyText {
  /// What all files state, in their order; empty if there are problems.
  std::vector<ConceptStatement> statements;
  /// All are errors, in the order of the files and lines; each has a remedy.
  std::vector<Diagnostic> problems;
};

/// Reads ontology files, which may refer to each other's concepts, and reports all of their
/// problems at once.
OntologyText read_ontology(std::span<const NamedText> files);

} // namespace castor
