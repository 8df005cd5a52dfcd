#pragma once

#include "castor/communication/types.hpp"

#include <cstddef>
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

/// A ball.
LogicalForm indefinite(const std::string& noun);

/// So many balls; "no balls" for 0.
LogicalForm counted(std::size_t count, LogicalForm thing);

/// "No ball".
LogicalForm none_of(LogicalForm thing);

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

/// What a form says of one of its nominals: that and all it leads to.
LogicalForm part_of(const LogicalForm& form, const std::string& nominal);

/// "I do not see a ball."
LogicalForm i_do_not_see(const LogicalForm& what);

/// "I do not know."
LogicalForm i_do_not_know();

/// "I cannot do that."
LogicalForm i_cannot_do_that();

/// "Hello", "bye".
LogicalForm greeting(const std::string& word);
LogicalForm closing(const std::string& word);

/// "I do not know the word ...".
LogicalForm unknown_word(const std::string& word);

} // namespace castor::communication
