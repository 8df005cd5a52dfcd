#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::communication {

/// What people say, and what says the same in words of the grammar: "give X a push" is "push X".
/// What only is left out has no words that say the same.
///
/// A pattern is made of words, which are separated by blanks:
///
///     nudge|shove      one of several
///     little|tiny?     may be missing, too
///     of_course        several words
///     0.0              any number in digits
///     @side            one of a list that has this name, the same in the paraphrase
///     X Y Z            one to sixteen words without a pause, the same in the paraphrase
///     ,                a pause
///     < at the begin   only where an utterance or a part of it after a pause begins
///     > at the end     only where one ends
///
/// What follows words such as "please" and "could you" begins there, too, and what comes before
/// "please" or "thanks" ends there.
///
/// A slot that begins or ends a pattern goes to where the utterance or its part begins or ends.
class Paraphrase {
public:
  /// What a name stands for: "left|right".
  using Lists = std::map<std::string, std::string, std::less<>>;

  /// \param text PATTERN = WORDS
  /// \throws std::invalid_argument what is wrong with it
  explicit Paraphrase(std::string_view text, const Lists& lists = {});

  /// Puts what is said in the place of the first match; false if there is none.
  bool apply(std::vector<std::string>& words) const;

  /// Those of the pattern.
  const std::set<std::string>& words() const { return words_; }

private:
  using Words = std::vector<std::string>;

  struct Element {
    /// Empty for a slot.
    std::vector<Words> alternatives;
    /// By which the paraphrase has what matches; empty if it does not.
    std::string name;
    bool is_optional = false;

    bool is_slot() const { return alternatives.empty(); }
  };

  /// Words of an utterance, from one position to another.
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  /// What matches the elements that have names.
  using Matches = std::vector<std::pair<std::string_view, Range>>;

  void read_pattern(std::string_view text, const Lists& lists);
  void read_replacement(std::string_view text);
  bool has_element(std::string_view name) const;
  std::optional<std::size_t> match(const Words& said, std::size_t at, std::size_t element,
                                   Matches& matches) const;
  std::optional<std::size_t> match_word(const Words& said, std::size_t at, std::size_t element,
                                        Matches& matches) const;
  std::optional<std::size_t> match_slot(const Words& said, std::size_t at, std::size_t element,
                                        Matches& matches) const;

  std::vector<Element> pattern_;
  Words replacement_;
  std::set<std::string> words_;
  bool is_at_begin_ = false;
  bool is_at_end_ = false;
};

} // namespace castor::communication
