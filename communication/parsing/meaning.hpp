#pragma once

#include "castor/communication/parsing/symbols.hpp"
#include "castor/communication/types.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// A nominal while parsing: which variable of which word it was first. Of two nominals that turn
/// out to be one, the smaller number stays: that of a word that says what it is, then the earlier
/// one.
using NominalId = std::uint32_t;

/// The nominal that stands for variable `variable` of an entry for the word at `position`;
/// `anchors` if it is the one that the word's predicate is said of.
NominalId nominal_of_word(std::size_t position, std::size_t variable, bool anchors);

/// w3 for what the third word says, x3a for something that it only needs.
std::string nominal_name(NominalId nominal);

/// One elementary predication of hybrid-logic dependency semantics.
struct Predication {
  enum class Kind : std::uint8_t { sort, proposition, feature, relation };

  NominalId nominal = 0;
  Kind kind = Kind::sort;
  /// Of the feature or the relation.
  Symbol name = 0;
  /// The sort, the proposition, the feature's value; 0 for a relation.
  Symbol value = 0;
  /// Only of a relation.
  NominalId dependent = 0;

  friend auto operator<=>(const Predication&, const Predication&) = default;
};

/// Which entry of the lexicon was used for words [begin, end).
struct LexicalChoice {
  std::uint16_t begin = 0;
  std::uint16_t end = 0;
  std::uint32_t entry = 0;
};

/// What a sequence of words says, in one derivation.
struct Meaning {
  /// Sorted, without duplicates.
  std::vector<Predication> predications;
  /// Of the atoms of the category, in its order; the first is what the meaning is about.
  std::vector<NominalId> indices;
  /// The sum of the weights of the entries and rules that were used.
  double weight = 0;
  std::vector<LexicalChoice> choices;
};

/// The meaning of function and argument, of which the function's last indices are the argument's
/// first; nothing if they contradict each other, as two sorts of one nominal do.
/// @param result_atoms so many of the function's indices are those of its result
std::optional<Meaning> unite(const Meaning& function, const Meaning& argument,
                             std::size_t result_atoms);

/// The form about the first index.
LogicalForm logical_form(const Meaning& meaning, const std::function<std::string(Symbol)>& text_of);

} // namespace castor::communication
