#pragma once

#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Parts of an utterance, as they are said, and what they are.
namespace castor::communication {

std::vector<std::string> words_between(const std::vector<std::string>& words, std::size_t begin,
                                       std::size_t end);

/// As it is written: "I can't", in one text.
std::string written(const std::vector<std::string>& words);

DialogueMove move_of(const PackedLogicalForm& form, const Lexicon& lexicon);

/// Whether it asks to do something that the robot handles.
bool asks_for_handling(const PackedLogicalForm& form, const Lexicon& lexicon);

/// Whether the word says what is to be done with things.
bool is_handling_verb(const std::string& word, const Lexicon& lexicon);

/// Whether words begin with a verb that says what is to be done with things: "set the cube there".
bool begins_with_handling(const std::vector<std::string>& words, const Lexicon& lexicon);

/// Whether it asks not to do something, which harms nobody if it is misunderstood.
bool is_prohibition(const PackedLogicalForm& form, const Lexicon& lexicon);

/// What is said of a thing, and by no pronoun: "the red ball"; nothing if something else is said.
std::optional<LogicalForm> thing_said(const PackedLogicalForm& form);

} // namespace castor::communication
