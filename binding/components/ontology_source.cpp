#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/base/input_file.hpp"
#include "castor/base/ontology_reader.hpp"
#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/binding/types.hpp"

#include <algorithm>
#include <filesystem>
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
      texts_.push_back(text_of(name));
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

  NamedText text_of(const std::string& name) const {
    const auto& shared = shared_ontology_files();
    const auto file = std::filesystem::path{base_.get()} / name;
    try {
      return {name, read_input_file(file)};
    } catch (const InputFileError& e) {
      const auto known = std::ranges::find(shared, name, &NamedText::name);
      if (known != shared.end() && e.reason() == InputFileError::Reason::missing)
        return *known;
      throw std::runtime_error("the ontology " + file.string() + " cannot be read: " + e.what() +
                               ". Name a file, or one that comes with Castor: " + names_of(shared));
    }
  }

  static std::string names_of(const std::vector<NamedText>& files) {
    std::string result;
    for (auto& x : files)
      result += (result.empty() ? "" : ", ") + x.name;
    return result;
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
