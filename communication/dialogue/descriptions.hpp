#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// Translates noun phrases into binding's terms: the features of the thing described, and its
/// relations to other things.
namespace castor::communication {

/// What a noun phrase says of the first of the things described.
struct PhraseMeaning {
  binding::Description description;
  /// Words that say nothing in binding's terms, such as "old".
  std::vector<std::string> not_understood;
};

/// The phrase, and that what it describes is as `scope` says: a property, a region, a kind of thing
/// or several of them ("red", "left of the ball", "a cube").
///
/// \pre the phrase is a nominal of the form, of a thing
PhraseMeaning describe_as(const LogicalForm& form, const Nominal& phrase, const Nominal& scope,
                          const Vocabulary& words);

/// The features in `scope` alone.
std::vector<binding::Feature> features_of(const LogicalForm& form, const Nominal& scope,
                                          const Vocabulary& words);

/// Takes the concept of everything out of what is said of something of another kind: a kitchen is
/// no thing, also if it is called "this".
void leave_out_general_kind(std::vector<binding::Feature>& features, const Vocabulary& words);

/// Whether it refers to one thing known to both speakers: "it", "the ball".
bool is_definite(const Nominal& nominal);

/// Whether the phrase stands for one thing or several that both know: "the balls", "neither".
bool is_definite_phrase(const Nominal& nominal);

/// "It", "this", "they"...
bool is_pronoun(const Nominal& nominal);

/// "This", "that": things that are shown rather than spoken of.
bool is_deictic(const Nominal& nominal);

/// "I", "you", "we": who takes part in the dialogue.
bool is_participant(const Nominal& nominal);

/// The place of the word in its sentence that introduced a nominal, by its name: 3 for "w3".
std::size_t place_of_word(const Nominal& nominal);

/// "The others", "the other ball".
bool is_about_others(const LogicalForm& form, const Nominal& nominal);

/// "The two", "the three": as many things, which were spoken of.
bool is_counted_group(const LogicalForm& form, const Nominal& nominal);

/// "How many balls", "two balls": whether a number is said or asked for.
bool asks_for_number(const Nominal& nominal);

/// Whether parts of it are spoken of: "these" in "how many of these".
bool is_whole(const LogicalForm& form, const Nominal& nominal);

/// "That thing", "this red one": what it stands for may have been said before.
bool is_anaphoric(const Nominal& nominal, const Vocabulary& words);

/// All things that a form speaks of and that might be perceived, from its root on: those that are
/// told something about first, others after them. Without those that are only said to be something,
/// as in "this is a ball".
std::vector<const Nominal*> things_spoken_of(const LogicalForm& form, const Vocabulary& words);

} // namespace castor::communication
