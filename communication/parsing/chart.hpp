#pragma once

#include "castor/communication/parsing/combinators.hpp"
#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/parsing/meaning.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor::communication {

/// Limits of the cost of parsing: an utterance of n words makes at most n (n + 1) / 2 *
/// edges_per_span edges, of meanings_per_edge meanings each.
struct ChartLimits {
  /// Further words of an utterance are ignored.
  std::size_t words = 48;
  /// Of more edges over the same words, the preferred ones are kept.
  std::size_t edges_per_span = 40;
  /// Of more meanings of one category over the same words, the preferred ones are kept.
  std::size_t meanings_per_edge = 16;
  /// Weight of skipping a word; if there is none, only fillers can be skipped.
  std::optional<double> skipping_weight;
};

/// A category derived from adjacent words, with all its meanings.
struct Edge {
  CategoryId category = 0;
  Combinator combinator = Combinator::lexical;
  /// The preferred one first; never empty.
  std::vector<Meaning> meanings;
};

/// A parser's knowledge of categories, which grows while it parses.
struct CombinatoryGrammar {
  explicit CombinatoryGrammar(const Lexicon& words);
  CombinatoryGrammar(const CombinatoryGrammar&) = delete;
  CombinatoryGrammar& operator=(const CombinatoryGrammar&) = delete;

  /// Whether an utterance may be of this category.
  bool is_root(CategoryId category);

  /// The categories that this one may be raised to, one for each rule of the lexicon.
  const std::vector<CategoryId>& raised(CategoryId category);

  const Lexicon& lexicon;
  CategoryTable categories;
  Combinators combinators;

private:
  std::unordered_map<CategoryId, bool> roots_;
  std::unordered_map<CategoryId, std::vector<CategoryId>> raised_;
};

/// All derivations of the words of an utterance, packed: derivations that differ only in their
/// meaning share an edge. Words are added one by one, so that there is a chart of each beginning of
/// the utterance. Of derivations that mean the same for sure, only the normal form is made (Eisner
/// 1996; Hockenmaier and Bisk 2010).
class Chart {
public:
  Chart(CombinatoryGrammar& grammar, const ChartLimits& limits);

  /// \returns false if there are too many words already
  bool add(std::string word);

  const std::vector<std::string>& words() const { return words_; }

  /// Edges over the words [begin, end), the preferred first.
  const std::vector<Edge>& edges(std::size_t begin, std::size_t end) const;

  /// Number of edges.
  std::size_t size() const;

  /// Text of a symbol of the lexicon, of a quoted word or of a numeral.
  std::string text(Symbol symbol) const;

private:
  using Cell = std::vector<Edge>;

  Cell& cell(std::size_t begin, std::size_t end);
  void look_up_phrases();
  void fill(std::size_t begin, std::size_t end);
  std::optional<double> filler_weight(std::size_t position) const;
  void add_phrases(std::size_t begin, std::size_t end, Cell& found);
  void add_combinations(const Cell& left, const Cell& right, Cell& found);
  void combine(const Edge& left, const Edge& right, const Combination& how, Cell& found);
  void add_raised(std::size_t begin, Cell& found);
  static Edge* find(CategoryId category, Combinator combinator, Cell& found);
  bool is_too_light(const Edge& edge, double weight) const;
  void insert(CategoryId category, Combinator combinator, Meaning meaning, Cell& found);
  void prune(Cell& found) const;
  /// \param said a quotation or a numeral for that of the entry
  Meaning meaning_of(std::uint32_t entry, std::size_t begin, std::size_t end,
                     const std::optional<std::string>& said);
  /// The first one among the words [begin, end).
  std::string numeral_in(std::size_t begin, std::size_t end) const;
  Symbol literal(std::string text);

  CombinatoryGrammar& grammar_;
  ChartLimits limits_;
  /// A word that says nothing, by itself or as a part of such a phrase.
  struct Filler {
    /// Of the phrase, in words; 0 if it is no filler.
    std::size_t length = 0;
    double weight = 0;
  };

  /// Entries of a phrase.
  struct Found {
    std::span<const std::uint32_t> as_said;
    std::span<const std::uint32_t> with_any_numeral;
  };

  std::vector<std::string> words_;
  /// By last word, then by length less 1.
  std::vector<std::vector<Found>> phrases_;
  /// By position; the shortest phrase of each.
  std::vector<Filler> fillers_;
  /// By end, then by begin.
  std::vector<std::vector<Cell>> cells_;
  /// Quoted words and numerals; their symbols follow those of the lexicon.
  std::vector<std::string> literals_;
};

} // namespace castor::communication
