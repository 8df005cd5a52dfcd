#include "castor/binding/ontology/stated_ontology.hpp"

#include "castor/base/ontology_reader.hpp"
#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/wm/values/encoding.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <string_view>

namespace castor::binding {

namespace {

std::uint64_t version_of(const std::vector<ConceptStatement>& statements) {
  Bytes bytes;
  Encoder{bytes}.put_fields(ConceptStatements{{}, statements});
  const std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  return std::max<std::uint64_t>(1, std::hash<std::string_view>{}(text));
}

} // namespace

StatedOntology stated_ontology(const std::map<std::string, ConceptStatements>& entries) {
  StatedOntology result;
  std::vector<const std::string*> sources;
  for (auto& [id, x] : entries)
    for (auto& statement : x.statements) {
      result.statements.push_back(statement);
      sources.push_back(x.source.empty() ? &id : &x.source);
    }
  if (result.statements.empty()) {
    result.statements = read_ontology(shared_ontology_files()).statements;
    result.ontology = shared_ontology();
  } else {
    std::vector<OntologyProblem> problems;
    result.ontology = std::make_shared<const Ontology>(result.statements, &problems);
    for (auto& x : problems)
      result.problems.push_back(
        fmt::format("{} states of \"{}\" what is left out: {} ({})", *sources[x.statement],
                    result.statements[x.statement].name, x.message, x.remedy));
  }
  result.version = version_of(result.statements);
  return result;
}

} // namespace castor::binding
