#pragma once

#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <vector>

namespace castor::communication {

/// Replaces words that the lexicon does not know by the known word of which they are a letter off:
/// one is missing, doubled, or two are in the wrong order; in words of five letters and more, and
/// in short ones that are said very often, one may be another. A word is two known ones if these
/// are a phrase, such as "at least", or the first one is an article; the first word of an utterance
/// may lack its first letter. English words (see is_english_word) are only replaced by another form of
/// the same word ("puts", "put"). Words that are not like any known one stay as they are. Letters that
/// make a word long ("sooo") are left out, which is not among what was replaced.
///
/// \returns what was replaced
std::vector<SpellingCorrection> correct_spelling(std::vector<std::string>& words,
                                                 const Lexicon& lexicon);

} // namespace castor::communication
