// Feeds arbitrary text to the readers of lexica and of ontologies.

#include "castor/base/ontology_reader.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using castor::test::require;
  const castor::NamedText file{"fuzz", {reinterpret_cast<const char*>(data), size}};
  auto check = [](const std::vector<castor::Diagnostic>& problems) {
    for (auto& x : problems)
      require(!x.message.empty() && !x.remedy.empty() &&
              render(x).find('\x1b') == std::string::npos);
  };
  auto read = castor::communication::read_lexicon({&file, 1});
  require((read.lexicon != nullptr) == read.problems.empty());
  check(read.problems);
  auto stated = castor::read_ontology({&file, 1});
  check(stated.problems);
  std::vector<castor::OntologyProblem> problems;
  const castor::Ontology ontology{stated.statements, &problems};
  require(problems.empty());
  for (auto a : ontology.names())
    for (auto& b : ontology.parents(a))
      require(ontology.is_kind_of(a, b) && !ontology.is_kind_of(b, a) && !ontology.excludes(a, b));
  return 0;
}
