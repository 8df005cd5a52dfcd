#pragma once

#include "castor/communication/parsing/symbols.hpp"
#include "castor/communication/types.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// A nominal while parsing: encodes the word and variable that introduced it. When two nominals are
/// unified, the smaller number is kept: that of a word with a predicate for it, then the earlier
/// one.
using NominalId = std::uint32_t;

/// The nominal for variable `variable` of an entry for the word at `position`; `anchors` if it is
/// the subject of the word's predicate.
NominalId nominal_of_word(std::size_t position, std::size_t variable, bool anchors);

/// w3 for the nominal of the third word's predicate, x3a for another variable of that word.
std::string nominal_name(NominalId nominal);

/// One elementary predication of hybrid-logic dependency semantics.
struct Predication {
  enum class Kind : std::uint8_t { sort, proposition, feature, relation };

  NominalId nominal = 0;
  Kind kind = Kind::sort;
  /// Name of the feature or the relation.
  Symbol name = 0;
  /// The sort, the proposition, the feature's value; 0 for a relation.
  Symbol value = 0;
  /// For a relation only.
  NominalId dependent = 0;

  friend auto operator<=>(const Predication&, const Predication&) = default;
};

/// The lexicon entry used for words [begin, end).
struct LexicalChoice {
  std::uint16_t begin = 0;
  std::uint16_t end = 0;
  std::uint32_t entry = 0;
};

/// Meaning of a sequence of words in one derivation.
struct Meaning {
  /// Sorted, without duplicates.
  std::vector<Predication> predications;
  /// Nominals of the category's atoms, in its order; the first is the subject of the meaning.
  std::vector<NominalId> indices;
  /// The sum of the weights of the entries and rules that were used.
  double weight = 0;
  std::vector<LexicalChoice> choices;

  /// Words between all nominals and their dependents, together.
  std::size_t dependency_length() const;
};

/// Combines the meanings of function and argument by unifying the function's last indices with the
/// argument's first; nothing if they contradict each other, as two sorts of one nominal do.
/// @param result_atoms number of the function's indices that belong to its result
std::optional<Meaning> unite(const Meaning& function, const Meaning& argument,
                             std::size_t result_atoms);

/// The logical form with the first index as its root.
LogicalForm logical_form(const Meaning& meaning, const std::function<std::string(Symbol)>& text_of);

} // namespace castor::communication
