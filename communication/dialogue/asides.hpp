#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::communication {

/// The form of an utterance without what is said beside the matter: "lol, my friends tell me that
/// the cube is yellow, if I may say so". Nothing if it is not understood without that either.
///
/// Left out are the lexicon's asides, wherever they stand, and frames: parts before a clause, or
/// after a comma at the end, that consist of the lexicon's frame words and of words that are not
/// known. A known word that is no frame word, such as one about things or "not", is never left out;
/// neither is a decisive one ("unless", "almost"). Frames with words that are not known are among
/// the corrections, so that they are said back.
///
/// \param words of the utterance, which is not understood as it stands
std::optional<PackedLogicalForm> parsed_without_asides(Parser& parser,
                                                       const std::vector<std::string>& words);

/// Whether the form says, asks or asks for something; a phrase may go on with the sentence before.
bool says_sentence(const PackedLogicalForm& form);

/// What a part that may be left out consists of.
struct Frame {
  /// Words that are not known.
  std::size_t unknown = 0;
  /// Whether one of these may be an adverb.
  bool has_adverb = false;
  /// Whether somebody speaks or is spoken to: "I", "your".
  bool has_person = false;
};

/// Nothing if the part says something that matters.
std::optional<Frame> frame_of(std::span<const std::string> words, const Lexicon& lexicon);

/// \param is_known_kept whether an aside that has a meaning of its own is kept: "thanks"
std::vector<std::string> without_asides(std::span<const std::string> words, const Lexicon& lexicon,
                                        bool is_known_kept = false);

} // namespace castor::communication
