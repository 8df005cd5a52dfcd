#pragma once

#include "castor/communication/parsing/lexicon.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace castor::communication {

/// The entries of a lexicon by what they mean, to find those that may express a given meaning
/// without looking at all of them. Of the entries of a family that have the same category and mean
/// the same, it has the first only, and none that only makes a phrase longer.
class EntryIndex {
public:
  explicit EntryIndex(const Lexicon& lexicon);

  /// The entries that have no predication, or one that is among `said` but for its nominals, and
  /// those of quoted words; in the lexicon's order. An entry that has predications, all of them
  /// among `said`, is never missing.
  std::vector<std::uint32_t> candidates(std::span<const Predication> said) const;

private:
  using Key = std::tuple<Predication::Kind, Symbol, Symbol>;

  static Key key_of(const Predication& predication);

  /// Each entry by its rarest predication.
  std::map<Key, std::vector<std::uint32_t>> entries_;
  /// Those without predications and those of quoted words, whose predicate may be any.
  std::vector<std::uint32_t> always_;
};

} // namespace castor::communication
