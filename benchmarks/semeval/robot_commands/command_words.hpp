#pragma once

#include "castor/communication/parsing/lexicon.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace castor::semeval {

/// The tokens of a command as its annotations count them: words in lower case, and every
/// punctuation mark and hyphen by itself.
std::vector<std::string> command_tokens(std::string_view command);

/// The same words, those that the lexicon does not know replaced by the nearest that it does, where
/// one is near. Words that none comes near stay.
std::vector<std::string> corrected(std::vector<std::string> words,
                                   const communication::Lexicon& lexicon);

} // namespace castor::semeval
