#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// The form of what is understood by itself in an utterance that is not understood as a whole, if
/// the rest says nothing about it (`is_aside`). Nothing if there is no such part, or several that
/// are not said as one sentence.
///
/// - Requests about things, whole and as long as possible, from one boundary of clauses to another:
///   the form is `partial`, so that they are only done if the speaker agrees. "It" stands for the
///   one thing that is spoken of in the part before.
/// - A whole question: what is left out is a correction, to be said back.
/// - A request to put something where is not understood ("put the cube up yonder"): the form is
///   `partial` and lacks the place.
/// - What agrees to a proposal or declines it, by the lexicon's phrases: yes and no.
std::optional<PackedLogicalForm> partly_understood(Parser& parser,
                                                   const std::vector<std::string>& words);

/// The same of words in which others were taken for typing errors: as they were said, or else as
/// corrected, with the corrections.
std::optional<PackedLogicalForm>
partly_understood(Parser& parser, const std::vector<std::string>& said,
                  const std::vector<std::string>& corrected,
                  const std::vector<SpellingCorrection>& corrections);

} // namespace castor::communication
