#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// A request that is understood without a part that only says why ("..., because it is mine", "so
/// that I can see it"), or without a word that only says how ("gingerly"). What is left out is
/// noted as a correction, to be said back. Nothing if it is no request, or if a pronoun of it might
/// stand for what is spoken of in the part before.
std::optional<PackedLogicalForm> parsed_request_alone(Parser& parser,
                                                      const std::vector<std::string>& words);

/// Several requests in one question, "can you take the cube and put it there", as if nobody had
/// asked whether: "can you put the balls here and the cubes there" is not about balls that are
/// here.
std::optional<PackedLogicalForm> parsed_without_asking(Parser& parser,
                                                       const std::vector<std::string>& words);

/// Without parts that only say why: "so that I can see it".
std::vector<std::string> without_reasons(const std::vector<std::string>& words,
                                         const Lexicon& lexicon);

/// What is not to be done is kept to whatever else is said: "note on my account: nobody moves the
/// cylinder". Nothing if the utterance has one part only, or none that forbids something.
std::optional<PackedLogicalForm> parsed_prohibition_alone(Parser& parser,
                                                          const std::vector<std::string>& words);

} // namespace castor::communication
