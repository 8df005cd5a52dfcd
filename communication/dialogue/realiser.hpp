#pragma once

#include "castor/communication/dialogue/entry_index.hpp"
#include "castor/communication/parsing/chart.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace castor::communication {

struct RealiserLimits {
  /// Limit of partial sentences, after which the realiser gives up.
  std::size_t edges = 20000;
};

/// Converts logical forms to sentences: chart realisation with the parser's lexicon and
/// combinators. Of synonyms the first one in the lexicon is chosen, of sentences the shortest. Not
/// thread-safe.
class Realiser {
public:
  explicit Realiser(std::shared_ptr<const Lexicon> lexicon, RealiserLimits limits = {});

  /// A sentence with exactly this meaning, such as "The square is blue."; nothing if the lexicon
  /// has no words for it or the form, or an item of a list of things that are there, has more than
  /// 64 predications.
  std::optional<std::string> realise(const LogicalForm& form);

private:
  std::optional<std::string> realise_whole(const LogicalForm& form);

  std::shared_ptr<const Lexicon> lexicon_;
  RealiserLimits limits_;
  CombinatoryGrammar grammar_;
  EntryIndex entries_;
};

} // namespace castor::communication
