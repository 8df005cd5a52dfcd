#include "castor/binding/ontology/shared_ontology.hpp"

#include "castor/base/ontology_reader.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::binding {

std::string_view general_ontology_text();
std::string_view tabletop_ontology_text();

const std::vector<NamedText>& shared_ontology_files() {
  static const std::vector<NamedText> files{
    {"general.ontology", std::string{general_ontology_text()}},
    {"tabletop.ontology", std::string{tabletop_ontology_text()}}};
  return files;
}

std::shared_ptr<const Ontology> shared_ontology() {
  static const auto ontology = [] {
    const auto read = read_ontology(shared_ontology_files());
    if (!read.problems.empty())
      throw std::logic_error(render(read.problems.front()));
    return std::make_shared<const Ontology>(read.statements);
  }();
  return ontology;
}

} // namespace castor::binding
