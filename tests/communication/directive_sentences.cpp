#include "castor/tests/communication/directive_sentences.hpp"

#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace castor::communication::test {

std::vector<DirectiveSentences> directive_sentences(const std::string& file) {
  std::ifstream in{std::string{CASTOR_DIRECTIVES} + '/' + file};
  if (!in)
    throw std::runtime_error("there is no file " + file);
  std::vector<DirectiveSentences> result;
  for (std::string line; std::getline(in, line);) {
    const auto arrow = line.find(" => ");
    if (line.starts_with('#') || arrow == std::string::npos)
      continue;
    DirectiveSentences x{{}, line.substr(arrow + 4)};
    std::istringstream said{line.substr(0, arrow)};
    for (std::string sentence; std::getline(said, sentence, '/');)
      x.said.push_back(sentence);
    result.push_back(std::move(x));
  }
  return result;
}

const std::shared_ptr<const Vocabulary>& words_of_requests() {
  static const auto result = std::make_shared<const Vocabulary>(
    lexicon_of_files(
      "english.ccg actions.ccg paraphrases.words examples.words tabletop.words table-actions.words",
      CASTOR_LANGUAGE_FOLDER),
    binding::shared_ontology());
  return result;
}

} // namespace castor::communication::test
