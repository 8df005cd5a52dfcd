#pragma once

#include "castor/communication/dialogue/vocabulary.hpp"

#include <memory>
#include <string>
#include <vector>

/// Sentences that ask a robot with an arm at a table to do something.
namespace castor::communication::test {

/// What is said, sentence after sentence, and what the last one asks for; or after a question mark,
/// what the reply to it has to say.
struct DirectiveSentences {
  std::vector<std::string> said;
  std::string expected;
};

/// \param file of the folder tests/communication/directives
std::vector<DirectiveSentences> directive_sentences(const std::string& file);

/// The words of a robot that may be asked for that.
const std::shared_ptr<const Vocabulary>& words_of_requests();

} // namespace castor::communication::test
