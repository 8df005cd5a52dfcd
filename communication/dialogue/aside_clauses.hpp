#pragma once

#include "castor/communication/parsing/lexicon.hpp"

#include <span>
#include <string>

namespace castor::communication {

/// What the words stand beside that are not understood.
enum class Beside { request, question };

/// Whether words beside a request or question, which are not understood with it, are of clauses of
/// their own that say nothing about it, so that the robot may take it up without them:
///
/// - frames ("would you be a dear and") and how to be ("and be quick");
/// - statements with a subject and a finite verb ("my son was here yesterday", "they look lonely"),
///   but none that tells which thing is meant ("I mean the other one", "the one that glows");
/// - beside a request, other things to do ("and polish the cube");
/// - negated ones only if they are about what the speaker needs, perceives or knows ("I don't need
///   it any more"), or about how something is ("that isn't stable").
///
/// Never conditions, exceptions, orders in time and prohibitions: "unless", "until", "instead",
/// "only", "without", "don't let it fall". Nor parts that are no clauses, such as things and places
/// ("and the zorg", "up yonder"): they may belong to what is understood.
///
/// \param is_first whether nothing that is understood comes before
bool is_aside(const Lexicon& lexicon, std::span<const std::string> words, Beside beside,
              bool is_first);

/// "Mind the cylinder", but not "watch out".
bool begins_caution(std::span<const std::string> words);

/// Whether a word joins clauses, and is of none of them: "and", "so".
bool joins_clauses(const std::string& word);

} // namespace castor::communication
