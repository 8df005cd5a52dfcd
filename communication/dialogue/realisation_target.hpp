#pragma once

#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/types.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::communication {

/// An index of a word in realisation: a nominal of the target, counted from 0, or, if negative, a
/// free variable.
using TargetIndex = int;

/// One possible use of a lexical entry for a part of the target.
struct EntryUse {
  /// Bit set of the target's predications that it covers.
  std::uint64_t coverage = 0;
  std::vector<TargetIndex> indices;
  /// The words to say.
  std::string text;
};

/// A logical form as predications that words have to cover.
class RealisationTarget {
public:
  RealisationTarget(const LogicalForm& form, const Lexicon& lexicon);

  /// False if the form has a symbol that no word expresses, or too many predications.
  bool is_sayable() const { return is_sayable_; }

  std::uint64_t all() const;

  /// Bit set of the predications that a nominal occurs in.
  std::uint64_t about(TargetIndex nominal) const {
    return about_[static_cast<std::size_t>(nominal)];
  }

  TargetIndex root() const { return root_; }

  const std::vector<Predication>& predications() const { return predications_; }

  /// All uses of an entry for a part of the target; for words without meaning one use of no
  /// coverage.
  std::vector<EntryUse> uses(const LexicalEntry& entry) const;

private:
  void match(const LexicalEntry& entry, std::size_t next, std::vector<TargetIndex>& variables,
             const EntryUse& use, std::vector<EntryUse>& found) const;
  bool is_same(const Predication& pattern, const Predication& target,
               const LexicalEntry& entry) const;
  Symbol symbol(const std::string& text, bool may_be_quoted);

  const Lexicon& lexicon_;
  bool is_sayable_ = true;
  TargetIndex root_ = -1;
  std::vector<Predication> predications_;
  /// By nominal.
  std::vector<std::uint64_t> about_;
  std::vector<std::string> quotations_;
};

} // namespace castor::communication
