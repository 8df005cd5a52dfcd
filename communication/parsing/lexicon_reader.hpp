#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/base/named_text.hpp"
#include "castor/communication/parsing/lexicon.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The language of lexicon files. `#` begins a comment. The first word of a line determines its
/// kind; lines that belong to it are indented.
///
///     feature number sg pl          # a feature of categories, and its values
///     root s[dcl] np                # what an utterance may be
///     raise np over s[dcl]          # np may also be s[dcl]/(s[dcl]\np)
///     call n[sg] a noun             # how to speak of what is missing
///     filler please at_all          # words that may stand anywhere and say nothing
///     aside lol for_the_record      # words left out of what is not understood with them
///     frame tell believe that       # words of parts that are left out of it, with those of
///     person i my you               # who speaks or is spoken to
///     name mia                      # names of people: frame words that no typing error is taken
///     telling says ask              # who is named beside them speaks or is spoken to
///     decisive unless almost        # words that are never left out
///     reason because so_that_i      # what begins a part of a request that only says why
///     comment they_look my_son      # what begins a remark beside a request, after a pause
///     agreement please_do go_on     # whole utterances that agree to what is proposed
///     refusal better_not            # or decline it
///
///     list side left|right          # what "@side" in a paraphrase stands for
///     paraphrases                   # what says the same as something that is understood, which is
///       give X a push|shove = push X       # tried for what is not (paraphrase.hpp)
///     replacements                  # the same, tried first: what is understood without them is
///       kindly keep = please put    # something else
///     examples put X left of Y      # what utterances that are not understood are compared with
///       X belongs on Y's left       # (examples.hpp)
///
///     family Noun                   # what a group of words may be: categories and meanings
///       n[?number]<x> : @x:thing(* ^ <Number>?number)
///     family Adjective
///       n[?number]<x>/n[?number]<x> : @x(<Property>(p:property ^ *))
///       adj<x> : @x:property(*) {-1}
///
///     nouns Noun                    # singular and plural: box and boxes, man and men
///       ball box man/men
///     words Adjective               # as they are; "grey" is what "gray" says
///       red gray=grey dark_blue=blue
///     words Noun[pl]                # with a feature's value
///       things
///
/// What words stand for, in the terms of the robot's other subarchitectures (WordMeanings):
///
///     general thing object          # nouns that say nothing but that there is something
///     concept desk=table            # a noun whose concept has another name; others are theirs
///     quality colour shape          # kinds of features; QUALITY=KIND if they have other names
///     value shape square cubical=cube    # adjectives of a quality, if not all words are values
///     look flat shape circle ?round      # what looks so by its shape; of ? it is not known
///     relation near next_to=near    # words of places, and binding's labels of relations
///     surroundings table on at      # where everything is, and how that is said
///     addressee self                # the concept of who is spoken to
///     action put=PickAndPlace       # the actions that verbs ask for
///     handling put take             # verbs for what is done to things that are seen
///     reply thanks You are welcome.      # what is said when the robot is spoken to about itself
///     content item                  # nouns for what is in things that contain others
///     side wall left right top bottom    # nouns for sides of these, and corners
///
/// Categories have slashes `/` and `\`, of which `/*` allows application only and `/+` also crossed
/// composition; the letters in <> tie them to the meaning, which is hybrid logic as in
/// hybrid_logic.hpp. `*` stands for the word's predicate and `?number` for the value of a feature.
/// A meaning may go on in further lines that begin with `:`, `^` or `&`. A number in braces is a
/// weight: entries with a higher weight are preferred. A blank within a word is written `_`; the
/// word '' stands for any text in quotes.
namespace castor::communication {

/// Result of reading a lexicon.
struct LexiconText {
  /// Null if there are problems.
  std::shared_ptr<const Lexicon> lexicon;
  /// All are errors, by file and line; each has a column and a remedy.
  std::vector<Diagnostic> problems;
};

/// Reads the files of a lexicon, of which later ones may use the families of earlier ones, and
/// reports all of their problems at once.
LexiconText read_lexicon(std::span<const NamedText> files);

/// The same for one file.
/// @param text contents of the file
/// @param file_name used in problems
LexiconText read_lexicon(std::string_view text, const std::string& file_name);

} // namespace castor::communication
