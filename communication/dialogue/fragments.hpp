#pragma once

#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <string_view>

/// What fragments make of what was said before.
namespace castor::communication {

/// A move with all that it leaves to what was said before.
struct CompleteMove {
  DialogueMove move;
  Antecedents antecedents;
};

/// Adds the nominals of another form, under names that the form does not have yet.
/// \returns the new name of the other form's root
std::string append(LogicalForm& form, const LogicalForm& other, Antecedents& antecedents,
                   const Antecedents& others);

/// What was meant, once somebody has said "the red one" to "which ball do you mean?": it is the
/// ball that was spoken of, and red.
/// \returns false if the fragment does not tell
bool clarify(CompleteMove& question, const std::string& nominal, const LogicalForm& said,
             const Antecedents& antecedents, const Vocabulary& vocabulary);

/// "And the disc?" after "what colour is the ball?": the disc in the place of the ball.
/// \returns false if nothing can be in its place
bool substitute(CompleteMove& question, const LogicalForm& said, const Antecedents& antecedents,
                const Vocabulary& vocabulary);

/// "There are two yellow cubes." "Sorry, only one."
/// \returns whether a number is put in the place of another
bool correct_number(CompleteMove& statement, const LogicalForm& said,
                    const Antecedents& antecedents);

/// Whether it asks for more, or less, of what was asked for before: "a bit more", "again", "too
/// far, bring it closer".
bool asks_for_more(const LogicalForm& said);

/// "A bit more", "closer", "again": what was asked for before, and further where it was to a side,
/// or with a narrower or wider gap where it was at a thing.
/// \param more as in the lexicon: small, more, closer, farther, half-back, again, or a number;
/// less-3
///     for as many centimetres back, in-all-3 for as many in place of those that were said
/// \param has_unit whether a number is said with "centimetres"
/// \returns nothing if the request has nothing that there could be more of
std::optional<LogicalForm> repeated(LogicalForm request, std::string_view more, bool has_unit);

} // namespace castor::communication
