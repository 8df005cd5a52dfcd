#pragma once

#include "castor/communication/parsing/category.hpp"
#include "castor/communication/parsing/examples.hpp"
#include "castor/communication/parsing/meaning.hpp"
#include "castor/communication/parsing/paraphrase.hpp"
#include "castor/communication/parsing/symbols.hpp"
#include "castor/communication/parsing/word_meanings.hpp"

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor::communication {

/// One use of a word or phrase: a category and a meaning.
struct LexicalEntry {
  /// As words, separated by blanks.
  std::string phrase;
  std::string family;
  std::string predicate;
  CategoryId category = 0;
  /// Nominals are numbered as the entry's variables; 0 is the subject of the predicate.
  std::vector<Predication> predications;
  /// The variables of the category's atoms, in its order.
  std::vector<std::uint8_t> indices;
  /// Whether variable 0 has a predicate.
  bool anchored = false;
  double weight = 0;

  friend bool operator==(const LexicalEntry&, const LexicalEntry&) = default;
};

/// A rule of type raising for a category.
struct RaisingRule {
  Category category;
  AtomicCategory result;
};

/// Readable name of a category: "a place" for pp[loc].
struct CategoryName {
  Category category;
  std::string name;
};

/// Words that matter where an utterance is not understood as it stands.
enum class WordClass {
  /// Words or phrases that may be left out wherever they stand: "lol", "for the record".
  aside,
  /// Words that frames are made of: "my friends tell me that ...".
  frame,
  /// Frame words for who speaks or is spoken to.
  person,
  /// Names of people, for whom no other word is taken.
  name,
  /// Frame words beside which stands who speaks or is spoken to: "Zorg says", "tell the zorgs".
  telling,
  /// Words that are never left out: "unless", "almost".
  decisive,
  /// Phrases that begin a part of a request that only says why: "because", "so that I".
  reason,
  /// Phrases that begin a remark beside a request, after a pause: "they look", "my son".
  comment,
  /// Whole utterances by which somebody agrees to what is proposed, or declines it: "please do",
  /// "better not".
  agreement,
  refusal
};

/// Words with their categories and meanings, and the root categories of utterances. Read from a
/// file by read_lexicon().
class Lexicon {
public:
  SymbolTable& symbols() { return symbols_; }
  const SymbolTable& symbols() const { return symbols_; }
  CategoryTable& categories() { return categories_; }
  const CategoryTable& categories() const { return categories_; }

  WordMeanings& meanings() { return meanings_; }
  const WordMeanings& meanings() const { return meanings_; }

  /// Nothing happens if there is an equal entry: several files may have a word.
  void add(LexicalEntry entry);
  void add_root(Category category) { roots_.push_back(std::move(category)); }
  void add_name(CategoryName name) { names_.push_back(std::move(name)); }
  void add_raising(RaisingRule rule) { raising_.push_back(std::move(rule)); }
  /// Adds a word or phrase that may stand anywhere and has no meaning.
  void add_filler(const std::string& phrase, double weight);
  void add_to(WordClass word_class, const std::string& phrase);
  /// Later ones are tried after earlier ones.
  /// \param is_always whether it is tried even if an utterance is understood without it
  void add_paraphrase(Paraphrase paraphrase, bool is_always);
  /// \throws std::invalid_argument what is wrong with them
  void add_example(std::string_view meaning, std::string_view sentence);

  const LexicalEntry& entry(std::uint32_t number) const { return entries_[number]; }
  std::span<const LexicalEntry> entries() const { return entries_; }

  /// The entries of a phrase; those of any quoted word for a word in quotes.
  std::span<const std::uint32_t> find(const std::string& phrase) const;

  /// The weight of a word as a filler; null if it is none.
  const double* filler(const std::string& phrase) const;

  bool is_in(WordClass word_class, const std::string& phrase) const;

  /// Ways to say something that is understood otherwise or not at all, and to say what is not
  /// understood.
  std::span<const Paraphrase> paraphrases(bool is_always) const {
    return is_always ? always_paraphrases_ : paraphrases_;
  }

  const Examples& examples() const { return examples_; }

  /// Whether the word is in a class, a paraphrase or several examples, at least as part of a
  /// phrase.
  bool is_in_a_class(const std::string& word) const;

  /// In words.
  std::size_t longest_aside() const { return longest_aside_; }

  /// Whether the word is known, at least as part of a phrase.
  bool knows(const std::string& word) const;

  /// Spelling suggestions for `word`, the nearest first; at most `most`. Of equally near words,
  /// those that contain more of its letters come first: a missing letter is more likely than a
  /// wrong one.
  std::vector<std::string> suggestions(std::string_view word, std::size_t most = 3) const;

  /// Readable name of a category; its text if it has no name.
  std::string name_of(const Category& category) const;

  /// Words of the longest phrase, filler or not, that ends with this word; at least 1.
  std::size_t longest_phrase_ending_in(const std::string& word) const;

  const std::vector<Category>& roots() const { return roots_; }
  const std::vector<RaisingRule>& raising() const { return raising_; }

private:
  void add_words_of(const std::string& phrase);

  SymbolTable symbols_;
  CategoryTable categories_;
  WordMeanings meanings_;
  std::vector<LexicalEntry> entries_;
  std::unordered_map<std::string, std::vector<std::uint32_t>> phrases_;
  std::unordered_map<std::string, double> fillers_;
  std::set<std::pair<WordClass, std::string>> classes_;
  std::set<std::string> class_words_;
  /// How often examples say a word.
  std::unordered_map<std::string, std::size_t> example_words_;
  std::vector<Paraphrase> paraphrases_;
  std::vector<Paraphrase> always_paraphrases_;
  Examples examples_;
  std::size_t longest_aside_ = 0;

  struct Word {
    /// Number of entries that it is part of.
    std::uint32_t entries = 0;
    /// Words of the longest phrase that it is the last word of.
    std::size_t longest_phrase = 1;
  };

  std::unordered_map<std::string, Word> words_;
  std::vector<Category> roots_;
  std::vector<RaisingRule> raising_;
  std::vector<CategoryName> names_;
};

/// Phrase under which all quoted words are found.
inline constexpr std::string_view quoted_word = "''";

bool is_quoted(std::string_view word);

} // namespace castor::communication
