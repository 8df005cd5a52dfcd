#pragma once

#include "castor/communication/parsing/chart.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace castor::communication {

struct RealiserLimits {
  /// Of partial sentences; after so many it gives up.
  std::size_t edges = 20000;
};

/// Says logical forms: chart realisation with the lexicon and the combinators that the parser
/// understands by. Of words that mean the same, the one that comes first in the lexicon is said; of
/// sentences, the shortest. Not for several threads at once.
class Realiser {
public:
  explicit Realiser(std::shared_ptr<const Lexicon> lexicon, RealiserLimits limits = {});

  /// A sentence that means just this, such as "The square is blue."; nothing if the lexicon has no
  /// words for it. Forms of more than 64 predications are not said.
  std::optional<std::string> realise(const LogicalForm& form);

private:
  std::shared_ptr<const Lexicon> lexicon_;
  RealiserLimits limits_;
  CombinatoryGrammar grammar_;
};

} // namespace castor::communication
