#pragma once

#include "castor/communication/dialogue/truth.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Constructors of logical forms for frequent utterances of robots. Forms are composed of forms:
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

/// The region in a relation to an anchor: @r:region(left ^ <Anchor>(...)).
LogicalForm region(const std::string& relation, const LogicalForm& anchor);

/// A region without an anchor: "here".
LogicalForm region(const std::string& place);

/// In several places at once, "on the left at the front".
/// \pre there is one at least
LogicalForm region(const std::vector<std::string>& places);

/// "The ball".
LogicalForm definite(const std::string& noun);

/// "A ball".
LogicalForm indefinite(const std::string& noun);

/// "Balls".
LogicalForm plural(const std::string& noun);

/// "Two" for 2; "many" for what there is no word for.
std::string number_word(std::size_t number);

/// 2 for "two"; nothing for what is no such word.
std::optional<std::size_t> number_of_word(std::string_view word);

/// "Third" for 3; empty for what there is no word for.
std::string rank_word(std::size_t rank);

/// 3 for "third"; nothing for what is no such word.
std::optional<std::size_t> rank_of_word(std::string_view word);

/// "Two balls"; "no balls" for 0.
LogicalForm counted(std::size_t count, LogicalForm thing);

/// "Two balls"; "at least two balls" if there may be more.
LogicalForm counted(const Count& count, LogicalForm thing);

/// "No ball".
LogicalForm none_of(LogicalForm thing);

/// Adds a property or a region to a thing: definite("ball") <Colour> red.
LogicalForm with(LogicalForm thing, const std::string& mode, const LogicalForm& dependent);

/// "`what` is `scope`", or "is not".
LogicalForm ascribe(const LogicalForm& what, const LogicalForm& scope, bool is_so = true);

/// "`what` has `scope`."
LogicalForm possess(const LogicalForm& what, const LogicalForm& scope);

/// "There is `what`."
LogicalForm exists(const LogicalForm& what);

/// "A ball, a cube and a disc".
/// \pre there is one thing at least
LogicalForm listed(std::vector<LogicalForm> things);

/// Both, for two; else all of them: what was spoken of.
LogicalForm all_of_them(std::size_t number);

/// "No, ...".
LogicalForm with_marker(const std::string& word, LogicalForm form);

/// "I think ..."
LogicalForm unsure(LogicalForm form);

/// "Which `what` do you mean?"
LogicalForm which(LogicalForm what);

/// The part of a form about one of its nominals: that nominal and all that it leads to.
LogicalForm part_of(const LogicalForm& form, const std::string& nominal);

/// "I do not see a ball."
LogicalForm i_do_not_see(const LogicalForm& what);

/// "I do not know."
LogicalForm i_do_not_know();

/// "I know nothing of rooms."
LogicalForm i_know_nothing_of(const std::string& noun);

/// "I", the robot.
LogicalForm myself();

/// What a phrase for who takes part in the dialogue becomes in the answer: "I" for "you", "you" for
/// "I", "we" for "we".
LogicalForm participant(const Nominal& phrase);

/// "I cannot do that."
LogicalForm i_cannot_do_that();

/// "Hello", "bye".
LogicalForm greeting(const std::string& word);
LogicalForm closing(const std::string& word);

/// "I do not know the word ...".
LogicalForm unknown_word(const std::string& word);

} // namespace castor::communication
