#pragma once

#include "castor/communication/parsing/chart.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/types.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

struct ParserOptions {
  ChartLimits chart;
  /// Of more readings of an utterance, the preferred ones are kept.
  std::size_t readings = 16;
};

class IncrementalParse;

/// A parser of the language that a lexicon describes: combinatory categorial grammar with
/// hybrid-logic dependency semantics. It becomes faster as it learns how categories combine, so one
/// parser should parse many utterances; not for several threads at once.
class Parser {
public:
  explicit Parser(std::shared_ptr<const Lexicon> lexicon, ParserOptions options = {});

  const Lexicon& lexicon() const { return *lexicon_; }
  const ParserOptions& options() const { return options_; }

  /// The packed readings of a whole utterance.
  PackedLogicalForm parse(std::string_view utterance);

  /// The readings of a whole utterance that is understood from beginning to end, the preferred
  /// first; empty if it is not.
  std::vector<LogicalForm> readings(std::string_view utterance);

  CombinatoryGrammar& grammar() { return grammar_; }

  /// Whether an utterance may be of this category.
  bool is_root(CategoryId category);

private:
  std::shared_ptr<const Lexicon> lexicon_;
  ParserOptions options_;
  CombinatoryGrammar grammar_;
  std::map<CategoryId, bool> roots_;
};

/// An utterance that is parsed while it is heard.
class IncrementalParse {
public:
  explicit IncrementalParse(Parser& parser);
  IncrementalParse(Parser& parser, const ChartLimits& limits);

  /// Hears another word; as words_of() makes them.
  void add(std::string word);

  /// Says that there are no more words.
  void finish() { is_finished_ = true; }

  /// What has been understood so far. Before the end, an analysis that lacks something is as good
  /// as a complete one. What no analysis spans is understood in fragments, as few as possible; at
  /// the end, `unparsable` tells where it broke. Nothing is guessed at.
  PackedLogicalForm form() const;

  const Chart& chart() const { return chart_; }

  /// The meanings of all words together, of root categories only once finished; the preferred
  /// first.
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
  std::vector<std::string> unheard_;
  bool is_finished_ = false;
};

} // namespace castor::communication
