#pragma once

#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/types.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::communication {

/// An index of a word that is to be said: a nominal of the target, counted from 0, or, if negative,
/// one that is still free.
using TargetIndex = int;

/// A way to use a lexical entry for a part of the target.
struct EntryUse {
  /// Which of the target's predications it says, by bit.
  std::uint64_t coverage = 0;
  std::vector<TargetIndex> indices;
  /// The words to say.
  std::string text;
};

/// A logical form as predications that words have to cover.
class RealisationTarget {
public:
  RealisationTarget(const LogicalForm& form, const Lexicon& lexicon);

  /// False if the form says something that no word says, or too much.
  bool is_sayable() const { return is_sayable_; }

  std::uint64_t all() const;

  /// The predications that a nominal takes part in.
  std::uint64_t about(TargetIndex nominal) const {
    return about_[static_cast<std::size_t>(nominal)];
  }

  TargetIndex root() const { return root_; }

  /// All ways in which an entry says a part of the target; one, of no coverage, for words that say
  /// nothing.
  std::vector<EntryUse> uses(const LexicalEntry& entry) const;

private:
  void match(const LexicalEntry& entry, std::size_t next, std::vector<TargetIndex>& variables,
             EntryUse& use, std::vector<EntryUse>& found) const;
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
