#pragma once

#include "castor/communication/types.hpp"

#include <string>

/// Logical forms of what robots often say, for the realiser. Forms are made of forms:
///
///     with_marker("no", ascribe(pronoun("it"), colour))              "No, it is red."
///     ascribe(square, colour)                                        "The square is blue."
///     exists(two_red_things)                                         "There are two red things."
///     which(ball)                                                    "Which ball do you mean?"
///     unknown_word("zorg")                                           "I do not know the word
///     'zorg'."
namespace castor::communication {

/// "Yes", "no", "ok".
LogicalForm marker(const std::string& word);

/// "It", "this", "they".
LogicalForm pronoun(const std::string& word);

/// "Red": @p:colour(red).
LogicalForm property(const std::string& sort, const std::string& value);

/// What is in a relation to something, as said of it: @r:region(left ^ <Anchor>(...)).
LogicalForm region(const std::string& relation, const LogicalForm& anchor);

/// A thing of a kind, such as the ball, with its definite article.
LogicalForm definite(const std::string& noun);

/// The same thing, with a property or a region: definite("ball") <Colour> red.
LogicalForm with(LogicalForm thing, const std::string& mode, const LogicalForm& dependent);

/// `what` is `scope`, or is not.
LogicalForm ascribe(const LogicalForm& what, const LogicalForm& scope, bool is_so = true);

/// There is `what`.
LogicalForm exists(const LogicalForm& what);

/// "No, ...".
LogicalForm with_marker(const std::string& word, LogicalForm form);

/// Which of the things that `what` describes does the other mean?
LogicalForm which(LogicalForm what);

/// "I do not know the word ...".
LogicalForm unknown_word(const std::string& word);

} // namespace castor::communication
