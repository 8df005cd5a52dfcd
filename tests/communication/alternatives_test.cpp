#include "castor/communication/dialogue/understanding.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/tests/communication/directive_sentences.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::communication::test {

namespace {

Parser& parser() {
  static Parser result{words_of_requests()->lexicon()};
  return result;
}

/// What is said if the request cannot be done; "none" if nothing is, "no request" if it is none.
std::string otherwise(const std::string& said) {
  const auto form = understood(parser(), words_of(said));
  if (!asks_for_handling(form, parser().lexicon()))
    return "no request";
  return form.sequel && form.sequel->is_conditional && form.sequel->words.empty()
           ? form.sequel->otherwise
           : "none";
}

} // namespace

TEST(Alternatives, AreSaidIfARequestCannotBeDone) {
  EXPECT_EQ(otherwise("Put the ball behind the box, or in front of it if there is no room."),
            "put the ball in front of it");
  EXPECT_EQ(otherwise("Put the ball behind the box. If that is not possible, put it on the left."),
            "put it on the left");
  EXPECT_EQ(otherwise("If you can, put the ball behind the box, otherwise give it to me."),
            "give it to me");
  EXPECT_EQ(otherwise("Put the ball on the box; failing that, put it next to the box."),
            "put it next to the box");
}

TEST(Alternatives, AreNoneWhereNothingElseIsToBeDone) {
  EXPECT_EQ(otherwise("Put the ball in the back left corner if possible."), "none");
  EXPECT_EQ(otherwise("If there is room behind the box for the ball, put it there. "
                      "If there is not, leave it where it is."),
            "none");
}

TEST(Alternatives, ARoomIsAPlaceForWhatIsPutThere) {
  const auto form = understood(
    parser(), words_of("If there is enough room behind the box for the ball, put it there."));
  const auto same = understood(parser(), words_of("Put the ball behind the box."));
  EXPECT_EQ(form.readings.size(), same.readings.size());
  EXPECT_EQ(move_of(form, parser().lexicon()).type, move_of(same, parser().lexicon()).type);
}

} // namespace castor::communication::test
