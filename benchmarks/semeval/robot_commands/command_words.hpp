#pragma once

#include "castor/communication/parsing/lexicon.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace castor::semeval {

/// The tokens of a command as its annotations count them: words in lower case, and every
/// punctuation mark and hyphen by itself.
std::vector<std::string> command_tokens(std::string_view command);

/// Spelling correction: replaces words that are not in the lexicon by the nearest that is, if there
/// is one.
std::vector<std::string> corrected(std::vector<std::string> words,
                                   const communication::Lexicon& lexicon);

} // namespace castor::semeval
