#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// The words of an utterance as the lexicon knows them: in lower case and without punctuation;
/// "what's" is two words, "what" and "'s", "don't" is "do" and "n't"; what stands in quotes is one
/// word that keeps them: 'zorg'. Numbers and lengths are as with_numerals() says. Bytes outside of
/// ASCII count as letters.
std::vector<std::string> words_of(std::string_view utterance);

/// Splits a text into sentences, which end with ".", "!" or "?" before a blank or at the end.
std::vector<std::string> sentences_of(std::string_view text);

} // namespace castor::communication
