#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/base/ontology_reader.hpp"
#include "castor/base/shared_text.hpp"
#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/binding/types.hpp"

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding {

namespace {

/// Adds to working memory what the ontology files of the configuration state.
class OntologySource final : public UnmanagedComponent {
  void configure() override {
    std::istringstream names{files_.get()};
    for (std::string name; names >> name;)
      texts_.push_back(read_or_shared("the ontology", name, base_.get(), shared_ontology_files()));
    auto read = read_ontology(texts_);
    if (!read.problems.empty())
      throw std::runtime_error("the ontology has errors\n" + render(read.problems));
    statements_ = std::move(read.statements);
  }

  void start() override {
    const auto address = here("ontology");
    const ConceptStatements stated{files_.get(), std::move(statements_)};
    // A predecessor may have added it, with what the files stated then.
    put(address, stated);
  }

  Option<std::string> files_{this, "files", "general.ontology tabletop.ontology",
                             "ontology files, those of others first"};
  Option<std::string> base_{this, "base", "",
                            "folder of the files; those that come with Castor need not be there"};

  std::vector<NamedText> texts_;
  std::vector<ConceptStatement> statements_;
};

CASTOR_COMPONENT(OntologySource, "reads ontology files, by which concepts are compared")

} // namespace

} // namespace castor::binding
