#pragma once

#include "castor/benchmarks/semeval/corpus.hpp"

#include <span>
#include <string>

namespace castor::semeval {

/// Learns the words of the lexicon of robot commands: phrases with their annotations, weighted by
/// frequency, and fillers, which have no annotation.
std::string learn_words(std::span<const Command* const> commands);

} // namespace castor::semeval
