#pragma once

#include <string>

namespace castor::communication {

/// Whether a word, in small letters, is among the 50,000 commonest of English by Debian's
/// wamerican-small; false where that is not installed. The list is read when a word is looked up
/// first.
bool is_english_word(const std::string& word);

/// Whether "an" stands before a word, by its first letter.
bool begins_with_vowel(const std::string& word);

} // namespace castor::communication
