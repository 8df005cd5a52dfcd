#pragma once

#include "castor/communication/parsing/chart.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/types.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

struct ParserOptions {
  ChartLimits chart;
  /// Maximum number of readings; the preferred ones are kept.
  std::size_t readings = 16;
};

class IncrementalParse;

/// A parser of the language that a lexicon describes: combinatory categorial grammar with
/// hybrid-logic dependency semantics. It caches combinations of categories, so reuse one parser for
/// many utterances. Not thread-safe.
class Parser {
public:
  explicit Parser(std::shared_ptr<const Lexicon> lexicon, ParserOptions options = {});

  const Lexicon& lexicon() const { return *lexicon_; }
  const ParserOptions& options() const { return options_; }

  /// The packed readings of a whole utterance.
  PackedLogicalForm parse(std::string_view utterance);

  /// The packed readings of words; nothing if they are not understood together.
  /// @param words in the form returned by words_of()
  std::optional<PackedLogicalForm> parse_whole(std::vector<std::string> words);

  /// The complete readings of a whole utterance, without fragments, the preferred first; empty if
  /// there are none.
  std::vector<LogicalForm> readings(std::string_view utterance);

  CombinatoryGrammar& grammar() { return grammar_; }

private:
  IncrementalParse parse_of(std::vector<std::string> words);

  std::shared_ptr<const Lexicon> lexicon_;
  ParserOptions options_;
  CombinatoryGrammar grammar_;
};

/// Incremental parse of an utterance, word by word.
class IncrementalParse {
public:
  explicit IncrementalParse(Parser& parser);
  IncrementalParse(Parser& parser, const ChartLimits& limits);

  /// Adds the next word, in the form returned by words_of().
  void add(std::string word);

  /// Marks the end of the utterance.
  void finish() { is_finished_ = true; }

  /// The readings so far. Before the end, incomplete analyses count as much as complete ones. If no
  /// analysis spans all words, the form consists of fragments, as few as possible; at the end,
  /// `unparsable` has the places between them. Nothing is guessed.
  PackedLogicalForm form() const;

  /// Whether one analysis spans all words. Costs less than form().
  bool is_understood() const;

  const Chart& chart() const { return chart_; }

  /// The meanings of all words together, the preferred first; once finished, only those of root
  /// categories.
  std::vector<const Meaning*> meanings() const;

private:
  struct Fragment {
    std::size_t begin = 0;
    std::size_t end = 0;
    /// Null for a word that is not known.
    const Edge* edge = nullptr;
  };

  std::vector<Fragment> fragments() const;
  const Edge* best_edge(std::size_t begin, std::size_t end) const;
  std::vector<ReadingForms> readings_of(const std::vector<Fragment>& fragments) const;
  std::vector<Unparsable> diagnose(const std::vector<Fragment>& fragments) const;
  Unparsable unknown_word(std::size_t position) const;
  Unparsable incomplete(const Edge& edge) const;
  std::string text(std::size_t begin, std::size_t end) const;
  LogicalForm form_of(const Meaning& meaning) const;

  Parser& parser_;
  Chart chart_;
  /// Words beyond the limit.
  std::vector<std::string> ignored_words_;
  bool is_finished_ = false;
};

} // namespace castor::communication
