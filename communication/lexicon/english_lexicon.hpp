#pragma once

#include "castor/base/named_text.hpp"
#include "castor/communication/parsing/lexicon.hpp"

#include <memory>
#include <string>
#include <vector>

namespace castor::communication {

/// The lexicon files that are part of the library: english.ccg, actions.ccg,
/// paraphrases.words, examples.words, tabletop.words.
const std::vector<NamedText>& shared_lexicon_files();

/// The English lexicon of robots that talk about a table: all of these files; read once.
std::shared_ptr<const Lexicon> english_lexicon();

/// The lexicon of several files, for all components that ask for the same.
/// \param names separated by blanks; later files may use what earlier ones have
/// \param folder of the files; those that are part of the library need not be there
/// \throws std::runtime_error with all findings if a file cannot be read or has errors
std::shared_ptr<const Lexicon> lexicon_of_files(const std::string& names,
                                                const std::string& folder);

/// The names of the shared files, as an argument of that.
inline constexpr const char* shared_lexicon_names = "english.ccg actions.ccg paraphrases.words examples.words tabletop.words";

} // namespace castor::communication
