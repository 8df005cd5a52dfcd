#pragma once

#include "castor/base/named_text.hpp"
#include "castor/base/ontology.hpp"

#include <memory>
#include <vector>

namespace castor::binding {

/// The ontology files that are part of the library: general.ontology, tabletop.ontology.
const std::vector<NamedText>& shared_ontology_files();

/// The ontology of all of them, which counts where there are no statements on working memory.
std::shared_ptr<const Ontology> shared_ontology();

} // namespace castor::binding
