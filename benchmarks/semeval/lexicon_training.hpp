#pragma once

#include "castor/benchmarks/semeval/corpus.hpp"

#include <span>
#include <string>

namespace castor::semeval {

/// The words of these commands as the lexicon of robot commands has them: phrases by what they were
/// annotated with, weighted by how often, and fillers, which were not.
std::string learn_words(std::span<const Command* const> commands);

} // namespace castor::semeval
