#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// The form of an utterance of somebody who leaves out function words or puts them elsewhere, as
/// hurried people do, and those who are learning English: "is cube yellow", "how many ball on
/// table", "where ball", "the cube: what colour?". Nothing if that does not make a question, a
/// statement or a request of it.
///
/// Tried are, in this order: articles before nouns without a determiner, plurals after "how many"
/// and the like, and verbs that agree with their subject; then copulas, "do", and another order.
/// No word is left out but a surplus "do". If more than articles, plurals and agreement
/// was changed, the whole is among the corrections, so that it is said back.
///
/// \param words of the utterance, which is not understood as it stands
std::optional<PackedLogicalForm> parsed_with_function_words(Parser& parser,
                                                            const std::vector<std::string>& words);

} // namespace castor::communication
